// Where rotors lie at rest: closed forms, and no acceleration.

#include "libdyn/motions/equilibrium.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "libbase/error.hpp"
#include "libbase/numerics/random.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libfe/analyses/static.hpp"
#include "tests/support/oil_films.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::equilibrium_test {

using test::MassInRing;

constexpr double weight = 9.81;  // of a mass of 1 kg [N]

double sag(const MassInRing& p) {
  const Vec eta = equilibrium(p.scene().contacts);
  EXPECT_NEAR(eta(0), 0.0, 1e-15);
  return -eta(1);
}

TEST(Equilibrium, IsTheLinearSagWithinTheClearance) {
  EXPECT_NEAR(sag({.k = 1e4, .clearance = 1e-3, .gravity = 9.81}), weight / 1e4, 1e-15);
}

// k y + k_C (y - c) = m g
TEST(Equilibrium, SharesTheWeightBetweenSpringAndRing) {
  for (const double kC : {1e4, 1e7, 1e11}) {
    const double found = sag({.k = 1e4, .kC = kC, .clearance = 0.5e-3, .gravity = 9.81});
    EXPECT_NEAR(found, (weight + kC * 0.5e-3) / (1e4 + kC), 1e-12 * found) << kC;
  }
}

// k y + k_H (y - c)^1.5 = m g
TEST(Equilibrium, OnAHertzContact) {
  const double y = sag({.k = 1e4, .kH = 1e8, .clearance = 0.5e-3, .gravity = 9.81});
  EXPECT_NEAR(1e4 * y + 1e8 * std::pow(y - 0.5e-3, 1.5), weight, 1e-9 * weight);
}

// A ring off center pushes sideways, too; a shaft of eight modes lies on its ring. Nothing moves.
TEST(Equilibrium, LeavesNoAcceleration) {
  MassInRing p{.k = 1e4, .clearance = 0.5e-3, .gravity = 9.81};
  p.offset = {3e-4, 1e-4};
  test::TwoDiskRub rotor{.mu = 0.0, .gravity = 9.81 * 200.0};
  Model model = rotor.model();
  model.structure.unbalances.clear();
  for (const Scene& scene : {p.scene(), make_scene(model)}) {
    const ContactSystem& system = scene.contacts;
    const int n = system.coordinates();
    Vec y = Vec::Zero(2 * n), a(n);
    y.head(n) = equilibrium(system);
    ASSERT_GT(kinematics(system.contacts()[0], y.data(), n).depth, 0.0);
    system.acceleration(0.0, y.data(), a.data());
    EXPECT_LT(a.norm(), 1e-10 * system.constant_load().norm());
  }
}

// It is where a simulation starts, so that nothing happens without unbalance.
TEST(Equilibrium, IsTheStartOfASimulation) {
  const MassInRing p{.k = 1e4, .c = 1.0, .clearance = 0.5e-3, .gravity = 9.81};
  const Scene scene = p.scene();
  MotionState state = test::start_of(p.model(), scene);
  const Vec start = state.y;
  test::run(scene, state, 20, {.tolerance = 1e-13});
  EXPECT_LT(distance(scene.contacts, state.y, start), 1e-10);
}

TEST(Equilibrium, NeedsARotorThatIsHeld) {
  const MassInRing p{.k = 0.0, .c = 1.0, .gravity = 9.81};
  EXPECT_THROW(equilibrium(p.scene().contacts), NumericalError);
}

/// A shaft with a disk on two oil films, with every one of its coordinates; number: which one.
Model on_films(int number, double Omega) {
  std::mt19937_64 random(static_cast<std::uint64_t>(number));
  const auto between = [&](double low, double high) {
    return low + (high - low) * random_share(random);
  };
  Model model;
  model.speed = Omega;
  model.has_speed = true;
  Structure& s = model.structure;
  const double length = between(0.5, 1.0), diameter = between(0.04, 0.08);
  s.shaft = {test::cylinder(length, diameter, 4 + 4 * (number % 3))};
  s.shaft[0].material = test::steel(7850.0);
  const int last = s.shaft[0].elements + 1;
  const double m = between(10.0, 60.0), radius = between(0.1, 0.2);
  s.disks = {{.at = test::node(last - 1),
              .m = m,
              .Id = 0.25 * m * radius * radius,
              .Ip = 0.5 * m * radius * radius}};
  s.gravity = 9.81;
  for (const int node : {1, last}) {
    const double R = between(0.02, 0.03);
    model.films.push_back({.name = "film",
                           .at = test::node(node),
                           .bearing = {.radius = R,
                                       .length = between(0.3, 0.9) * R,
                                       .clearance = between(2e-3, 4e-3) * R,
                                       .viscosity = between(0.01, 0.03)},
                           .offset = {between(-1e-5, 1e-5), between(-1e-5, 1e-5)}});
  }
  model.reduction.method = ReductionMethod::none;
  return model;
}

// Motions begin where linear verbs find the journals, whatever the coordinates: in all of them the
// stiffness of the shaft must not drown the balance of the journals.
TEST(Equilibrium, OfUnreducedRotorsOnFilmsIsThatOfLinearVerbs) {
  constexpr double alike = 1e-6;  // of a clearance: what M^-1 K is right to over stiff coordinates
  for (int number = 1; number <= 12; ++number) {
    for (const double Omega : {100.0, 300.0, 1000.0}) {
      SCOPED_TRACE(testing::Message() << number << " at " << Omega);
      const Model model = on_films(number, Omega);
      const Scene scene = make_scene(model);
      const Vec eta = equilibrium(scene.contacts);
      const Vec q = FilmEquilibrium(model).at(Omega)->q;
      ASSERT_EQ(eta.size(), q.size());
      for (std::size_t i = 0; i < model.films.size(); ++i) {
        const ReducedFilm& film = scene.contacts.films()[i];
        EXPECT_LT((film.U * (eta - q)).norm(), alike * film.clearance);
      }
    }
  }
}

// Two films at one journal carry half of it each, in linear verbs and in motions.
TEST(Equilibrium, OnTwoFilmsAtOneJournal) {
  test::MassOnFilm rotor;
  const double e = FilmEquilibrium(rotor.model()).at(rotor.Omega)->films[0].eccentricity;
  rotor.m *= 2.0;
  Model model = rotor.model();
  model.films.push_back(model.films[0]);
  const auto at_rest = FilmEquilibrium(model).at(rotor.Omega);
  for (const RunningFilm& film : at_rest->films) EXPECT_NEAR(film.eccentricity, e, 1e-9);
  const Scene scene = make_scene(model);
  Vec y = Vec::Zero(4);
  y.head(2) = equilibrium(scene.contacts);
  for (const ReducedFilm& film : scene.contacts.films()) {
    EXPECT_NEAR(eccentricity(film, y.data(), 2), e, 1e-9);
  }
}

// A shaft on two springs, of all its coordinates, lies on a ring at its disk: half a weight that is
// known must be in the ring, the rest in the springs.
TEST(Equilibrium, OfAnUnreducedShaftOnItsRing) {
  for (const int elements : {4, 12, 40}) {
    SCOPED_TRACE(elements);
    Model model = on_films(1, 300.0);
    Structure& s = model.structure;
    s.shaft[0].elements = elements;
    const int middle = elements / 2 + 1;
    s.disks[0].at = test::node(middle);
    model.films.clear();
    for (const int node : {1, elements + 1}) {
      s.bearings.push_back(test::bearing(test::node(node), test::isotropic(1e5, 10.0)));
    }
    model.contacts = {
        {.name = "ring", .at = test::node(middle), .clearance = 5e-4, .law = Radial<>{.k = 1e8}}};
    const Scene scene = make_scene(model);
    const int n = scene.contacts.coordinates();
    Vec y = Vec::Zero(2 * n);
    y.head(n) = equilibrium(scene.contacts);
    const ContactForces ring = kinematics(scene.contacts.contacts()[0], y.data(), n);
    const StaticEquilibrium apart = static_equilibrium(scene.assembler, model.speed);
    const double carried = -(apart.bearings[0].fy() + apart.bearings[1].fy());
    double springs = 0.0;
    for (const int node : {1, elements + 1}) {
      const Point p = scene.assembler.point(test::node(node));
      springs -= 1e5 * scene.system.dofs.row(p, Y).dot(scene.reduced.Phi * y.head(n));
    }
    EXPECT_GT(ring.depth, 0.0);
    EXPECT_NEAR(ring.normal + springs, carried, 1e-6 * carried);
  }
}

}  // namespace whirl::equilibrium_test
