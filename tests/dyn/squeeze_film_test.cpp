// Squeeze film dampers in motion: centered circles in closed form, methods against each other, and
// linear verbs.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "libdyn/system/film_equilibrium.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libdyn/taylor/mixed.hpp"
#include "libfe/analyses/modes.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::squeeze_film_test {

using std::numbers::pi;

constexpr JournalBearing damper{
    .radius = 0.065, .length = 0.02, .clearance = 1e-4, .viscosity = 0.02};

/// A mass on a spring in a damper.
struct Damped {
  Squeeze law{};
  double m = 5.0, k = 3e6, Omega = 1000.0;
  double U = 0.0, phase = 0.0;  ///< unbalance [kg.m], [rad]
  double gravity = 0.0;

  Model model() const {
    Model s;
    s.speed = Omega;
    s.has_speed = true;
    s.structure.bodies = {{.name = "ring", .m = m}};
    s.structure.bearings = {test::bearing(test::body("ring"), test::isotropic(k, 0.0))};
    if (U != 0.0) {
      s.structure.unbalances = {{.at = test::body("ring"), .moment = U, .phase = phase}};
    }
    s.structure.gravity = gravity;
    s.films = {{.name = "damper", .at = test::body("ring"), .bearing = damper, .law = law}};
    return s;
  }
};

std::vector<Squeeze> laws() {
  std::vector<Squeeze> all;
  for (const FilmTheory theory : {FilmTheory::short_bearing, FilmTheory::long_bearing}) {
    for (const FilmExtent extent : {FilmExtent::half, FilmExtent::full}) {
      all.push_back({.theory = theory, .extent = extent});
    }
  }
  return all;
}

/// K + i Omega C on a centered circle, force = -K r - C r' [N/m].
Complex on_circle(const Squeeze& law, double e, double Omega) {
  const double Q = 1.0 - e * e;
  const auto& [R, L, c, viscosity] = damper;
  const double s = viscosity * R * std::pow(L / c, 3),
               l = 12.0 * viscosity * L * std::pow(R / c, 3);
  const bool is_long = law.theory == FilmTheory::long_bearing;
  const Complex full(
      0.0, is_long ? 2.0 * pi * l / ((2.0 + e * e) * std::sqrt(Q)) : pi * s / std::pow(Q, 1.5));
  const double K = is_long ? 2.0 * l * e / ((2.0 + e * e) * Q) : 2.0 * s * e / (Q * Q);
  return Omega * (law.extent == FilmExtent::full ? full : 0.5 * full + K);
}

// (k + K - m Omega^2 + i Omega C) r = U Omega^2 e^(i phase): the circle of which this is true comes
// back after a revolution, by every method that knows films.
TEST(SqueezeFilmMotion, KeepsTheCircleOfItsCoefficients) {
  constexpr double e = 0.5;
  for (const Squeeze& law : laws()) {
    Damped rotor{.law = law};
    const double Omega = rotor.Omega, r = e * damper.clearance;
    const Complex U =
        (rotor.k - rotor.m * Omega * Omega + on_circle(law, e, Omega)) * r / (Omega * Omega);
    rotor.U = std::abs(U);
    rotor.phase = std::arg(U);
    const Scene scene = make_scene(rotor.model());
    const MotionState start = test::state_of({r, 0.0}, {0.0, r * Omega});
    for (const char* method : {"taylor", "dop853", "cvode-bdf"}) {
      MotionState state = start;
      const Integration run =
          test::run(scene, state, 1, {.tolerance = 1e-12, .method = method_named(method)});
      EXPECT_EQ(run.outcome, Outcome::reached_end) << run.failure;
      EXPECT_LT(distance(scene.contacts, state.y, start.y), 1e-7) << law.formula() << " " << method;
    }
    Trajectory exact{.system = &scene.contacts, .state = start, .revolutions = 1};
    integrate_quad(exact, {.tolerance = 1e-20, .order = 22});
    EXPECT_EQ(exact.outcome, Outcome::reached_end) << exact.failure;
    EXPECT_LT(distance(scene.contacts, exact.state.y, start.y), 1e-12) << law.formula();
  }
}

// Films of several formulas in one batch are integrated as each is alone.
TEST(SqueezeFilmMotion, KeepsFormulasApartInABatch) {
  std::vector<Scene> scenes;
  for (const Squeeze& law : laws()) {
    for (int i = 0; i < 3; ++i) {
      scenes.push_back(make_scene(Damped{.law = law, .m = 5.0 + i, .U = 1e-4}.model()));
    }
  }
  std::vector<Trajectory> all;
  for (const Scene& scene : scenes) {
    all.push_back({.system = &scene.contacts,
                   .state = test::state_of({1e-5, 0.0}, {0.0, 0.02}),
                   .revolutions = 3});
  }
  std::vector<Trajectory> mixed = all;
  integrate_mixed(mixed, {.tolerance = 1e-10});
  for (std::size_t i = 0; i < all.size(); ++i) {
    integrate_single(all[i], {.tolerance = 1e-10});
    EXPECT_EQ(all[i].outcome, Outcome::reached_end) << all[i].failure;
    EXPECT_EQ(mixed[i].state.y, all[i].state.y) << i;
  }
}

// In its middle a damper is one of C = pi viscosity R (L/c)^3 (half: of that), as K + i Omega C
// with e = 0: (k - m w^2 + i w C) = 0.
TEST(SqueezeFilmMotion, DampsModesFromTheMiddle) {
  for (const Squeeze& law : laws()) {
    const Damped rotor{.law = law, .m = 500.0};
    const double C = on_circle(law, 0.0, 1.0).imag();
    const Modes modes = complex_modes(Assembler(linear_structure(rotor.model())).at(1000.0), 4);
    const Complex root = std::sqrt(Complex(C * C - 4.0 * rotor.k * rotor.m));
    const Complex lambda = (-C + root) / (2.0 * rotor.m);
    if (lambda.imag() > std::abs(lambda.real())) {
      ASSERT_FALSE(modes.oscillatory.empty());
      EXPECT_LT(std::abs(modes.oscillatory[0].lambda - lambda), 1e-8 * std::abs(lambda));
    } else {
      ASSERT_FALSE(modes.overdamped.empty());
    }
  }
}

// Off its middle, at rest, a half film damps as the mean of both directions: half of the full one.
TEST(SqueezeFilmMotion, DampsByTheMeanOfBothDirectionsOffTheMiddle) {
  Damped half{.gravity = 9.81}, full{.law = {.extent = FilmExtent::full}, .gravity = 9.81};
  half.m = full.m = 15.0;  // sags by 0.5 of the clearance
  const RunningFilm a = FilmEquilibrium(half.model()).at(1000.0)->films.at(0);
  const RunningFilm b = FilmEquilibrium(full.model()).at(1000.0)->films.at(0);
  EXPECT_NEAR(a.eccentricity, 15.0 * 9.81 / 3e6 / 1e-4, 1e-9);
  EXPECT_EQ(a.load.norm(), 0.0);
  EXPECT_EQ(a.stiffness.norm(), 0.0);
  EXPECT_LT((2.0 * a.damping - b.damping).norm(), 1e-6 * b.damping.norm());
}

}  // namespace whirl::squeeze_film_test
