// Two shafts whose speeds have a constant ratio: what rubs and what is dragged between them, and
// how their unbalance moves them.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "libdyn/motions/equilibrium.hpp"
#include "libdyn/motions/start.hpp"
#include "libdyn/system/film.hpp"
#include "libfe/analyses/unbalance.hpp"
#include "libfe/assembly/excitations.hpp"
#include "tests/support/trajectories.hpp"

namespace whirl::two_shafts_test {

using namespace test;

Station outer(double z) {
  return {.kind = Station::Kind::position, .z = z, .rotor = "outer"};
}

/// A shaft of 0.6 m in a tube from 0.1 to 0.5 m that turns at another speed, and may rub in it
/// amid.
struct Spools {
  double Omega = 400.0;
  double ratio = 1.5;
  bool has_own_speed = false;  ///< that which the ratio makes
  double clearance = 2e-4;
  double mu = 0.2;
  double unbalance = 2e-5;  ///< of each shaft [kg.m]
  double damping = 0.0;     ///< in proportion to mass [1/s]

  Model model() const {
    Model all;
    all.speed = Omega;
    all.has_speed = true;
    Structure& s = all.structure;
    s.shaft = {cylinder(0.6, 0.03, 6)};
    Segment tube = cylinder(0.4, 0.07, 4);
    tube.left.inner = tube.right.inner = 0.05;
    s.rotors = {{.name = "outer", .ratio = ratio, .z = 0.1, .shaft = {tube}}};
    if (has_own_speed) s.rotors[0].lead = {0.0}, s.rotors[0].own = {ratio * Omega};
    s.disks = {{.name = "inner", .at = at(0.3), .m = 4.0, .Id = 0.01, .Ip = 0.02},
               {.name = "outer", .at = outer(0.4), .m = 3.0, .Id = 0.02, .Ip = 0.035}};
    s.bearings = {bearing(at(0.0), orthotropic(2e6, 3e6, 400.0, 500.0)),
                  bearing(at(0.6), orthotropic(3e6, 2e6, 500.0, 400.0)),
                  bearing(outer(0.1), isotropic(4e6, 600.0)),
                  connect(at(0.5), outer(0.5), isotropic(5e6, 300.0))};
    s.unbalances = {{.at = at(0.3), .moment = unbalance, .phase = 0.4},
                    {.at = outer(0.4), .moment = unbalance}};
    s.gravity = 9.81;
    s.damping.mass = damping;
    s.stations = {at(0.3), outer(0.3)};
    all.contacts = {{.name = "sleeve",
                     .at = at(0.3),
                     .against = outer(0.3),
                     .clearance = clearance,
                     .friction = {.mu = mu, .radius = 0.025},
                     .law = Radial<>{.k = 5e6}}};
    all.reduction.modes = 8;
    return all;
  }
  Scene scene() const { return make_scene(model()); }
};

// A shaft of a speed of its own rubs, drags and whirls as one of the same ratio.
TEST(TwoShafts, MoveAtSpeedsOfTheirOwn) {
  for (const double ratio : {1.5, -0.5}) {
    const Spools following{.ratio = ratio, .clearance = 3e-5, .unbalance = 4e-4};
    Spools own = following;
    own.has_own_speed = true;
    const Scene a = following.scene(), b = own.scene();
    EXPECT_DOUBLE_EQ(b.contacts.contacts()[0].rim_speed, a.contacts.contacts()[0].rim_speed);
    MotionState of_a = start_of(following.model(), a), of_b = start_of(own.model(), b);
    const Integration run_a = run(a, of_a, 6, {.tolerance = 1e-12});
    const Integration run_b = run(b, of_b, 6, {.tolerance = 1e-12});
    EXPECT_EQ(run_a.cost.events, run_b.cost.events);
    EXPECT_GE(run_a.cost.events, 2);
    const Vec moved_a = full_state(a, of_a).displacement,
              moved_b = full_state(b, of_b).displacement;
    EXPECT_LT((moved_a - moved_b).norm(), 1e-7 * moved_a.norm());
  }
}

// acceptance: without damping and friction the energy stays, whatever the shafts give each other
// where they touch
TEST(TwoShafts, KeepTheirEnergyOverAThousandImpacts) {
  const Spools spools{.clearance = 1e-4, .mu = 0.0, .unbalance = 0.0};
  Model model = spools.model();
  model.structure.gravity = 0.0;
  model.structure.bearings = {bearing(at(0.0), orthotropic(2e6, 3e6, 0.0, 0.0)),
                              bearing(at(0.6), orthotropic(3e6, 2e6, 0.0, 0.0)),
                              bearing(outer(0.1), isotropic(4e6)),
                              connect(at(0.5), outer(0.5), isotropic(5e6))};
  const Scene scene = make_scene(model);
  const ReducedContact& contact = scene.contacts.contacts()[0];
  const Mat stiffness = scene.reduced.stiffness();
  const StateLayout layout = scene.contacts.layout();
  const auto energy = [&](const Vec& y) {
    const Vec x = layout.eta(y), v = layout.rate(y);
    const double depth = std::max((contact.U * x).norm() - contact.clearance, 0.0);
    return 0.5 * v.dot(scene.reduced.M * v) + 0.5 * x.dot(stiffness * x) +
           0.5 * 5e6 * depth * depth;
  };
  MotionState state{.y = Vec::Zero(layout.size())};
  layout.rate(state.y) = contact.U.transpose() * Vec2(0.5, 0.2);
  const double before = energy(state.y);
  ASSERT_GT(before, 0.0);
  double worst = 0.0;
  long events = 0;
  for (int k = 0; k < 40 && events < 2000; ++k) {
    const Integration part = run(scene, state, 10, {.tolerance = 1e-14});
    ASSERT_EQ(part.outcome, Outcome::reached_end) << part.failure;
    events += part.cost.events;
    worst = std::max(worst, std::abs(energy(state.y) / before - 1.0));
  }
  EXPECT_GE(events, 2000);  // a touch and a release each
  EXPECT_LT(worst, 1e-10);
}

// Slip is the difference of the speeds of both rims, whatever turns against what.
TEST(TwoShafts, SlipByTheDifferenceOfTheirSpeeds) {
  for (const double ratio : {1.5, 1.0, 0.0, -1.0, -1.5}) {
    const Spools spools{.ratio = ratio};
    const Scene scene = spools.scene();
    ASSERT_EQ(scene.contacts.contacts().size(), 1u);
    EXPECT_DOUBLE_EQ(scene.contacts.contacts()[0].rim_speed, (1.0 - ratio) * 400.0 * 0.025);
  }
}

// Oil between them is dragged by the sum: by both walls, by none where they turn against each
// other.
TEST(TwoShafts, DragOilByTheSumOfTheirSpeeds) {
  for (const double ratio : {1.0, 0.5, 0.0, -1.0}) {
    const Spools spools{.ratio = ratio};
    const Assembler assembler(spools.model().structure);
    const OilFilm film{.at = at(0.3), .against = outer(0.3)};
    EXPECT_DOUBLE_EQ(drag_speed(film, assembler, 400.0), 400.0 + ratio * 400.0);
    const OilFilm to_ground{.at = outer(0.3)};
    EXPECT_DOUBLE_EQ(drag_speed(to_ground, assembler, 400.0), ratio * 400.0);
    const FilmAtSpeed at = at_speed(film, 400.0, drag_speed(film, assembler, 400.0));
    EXPECT_DOUBLE_EQ(at.spin, 1.0 + ratio);
  }
}

// Blades turn with the shaft that they are on, and slip past what they touch.
TEST(TwoShafts, CarryBladesOnEither) {
  for (const double ratio : {1.5, -0.5}) {
    for (const bool is_outer : {true, false}) {
      const Spools spools{.ratio = ratio};
      Model model = spools.model();
      model.contacts[0] = {.name = "tips",
                           .at = is_outer ? outer(0.3) : at(0.3),
                           .against = is_outer ? at(0.3) : outer(0.3),
                           .clearance = 1e-3,
                           .friction = {.mu = 0.1, .slip = Slip::actual, .tolerance = 1.0},
                           .law = BladeTip<>{.blades = 3,
                                             .tip_radius = 0.1,
                                             .blade_length = 0.04,
                                             .bending_stiffness = 20.0,
                                             .k = 1e9}};
      const Scene scene = make_scene(model);
      const ReducedContact& first = scene.contacts.contacts()[0];
      const double own = 400.0 * (is_outer ? ratio : 1.0), other = 400.0 * (is_outer ? 1.0 : ratio);
      const Vec at_rest = Vec::Zero(scene.contacts.size());
      const ContactForces f = kinematics(first, {0.3, 7}, at_rest.data(), scene.contacts.layout());
      EXPECT_NEAR(f.slip, (own - other) * 0.1, 1e-9);
      const double turned = (0.3 + 7.0 * 2.0 * std::numbers::pi) * own / 400.0;
      EXPECT_NEAR(f.n(0), std::cos(turned), 1e-12);
      EXPECT_NEAR(f.n(1), std::sin(turned), 1e-12);
    }
  }
}

// Loads of both orders repeat after the denominator of the ratio, and never without one.
TEST(TwoShafts, RepeatAfterTheDenominatorOfTheirRatio) {
  const auto repeats = [](double ratio) {
    return Spools{.ratio = ratio}.scene().contacts.repeats_after();
  };
  EXPECT_EQ(repeats(1.5), 2);
  EXPECT_EQ(repeats(-1.4), 5);
  EXPECT_EQ(repeats(2.0), 1);
  EXPECT_EQ(repeats(-1.0), 1);
  EXPECT_EQ(repeats(std::sqrt(2.0)), 0);
}

// Without a touch a simulation settles on the sum of the responses to the weight and to the
// unbalance of each shaft, which libfe solves for each by itself.
TEST(TwoShafts, SimulationsSettleOnTheResponsesToBothUnbalances) {
  for (const double ratio : {1.5, -1.0}) {
    const Spools spools{.ratio = ratio, .clearance = 1.0, .damping = 100.0};
    Model model = spools.model();
    model.reduction.method = ReductionMethod::none;
    const Scene scene = make_scene(model);
    MotionState state = start_of(model, scene);
    run(scene, state, 60, {.tolerance = 1e-12});
    const Assembler& assembler = scene.assembler;
    const auto points = assembler.dofs().points();
    const System rest = assembler.uncondensed(spools.Omega);
    const Vec sag = Mat(rest.K).partialPivLu().solve(
        Vec(rest.dofs.T.transpose() * static_load(assembler, spools.Omega)));
    Vec expected = assembler.dofs().T * sag;
    const double t = static_cast<double>(state.revolution) * scene.contacts.period();
    const auto add = [&](double w, const UnbalanceResponse& of) {
      for (std::size_t i = 0; i < points.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        for (int c = X; c <= THETA_Y; ++c) {
          expected(assembler.dofs().full_index(points[i], c)) +=
              (of.at(c)(row, 0) * std::polar(1.0, w * t)).real();
        }
      }
    };
    add(spools.Omega, unbalance_response(assembler, {spools.Omega}, points));
    for (const Excitation& load : other_excitations(assembler)) {
      add(load.frequency_at(spools.Omega),
          oscillating_response(assembler, load, {spools.Omega}, points));
    }
    const Vec found = full_state(scene, state).displacement;
    EXPECT_LT((found - expected).norm(), 1e-8 * expected.norm()) << ratio;
  }
}

/// A rotor in a body that is a stator, or the body of a shaft that stands still.
Model in_a_ring(bool is_shaft_at_rest) {
  Model all;
  all.speed = 60.0;
  all.has_speed = true;
  Structure& s = all.structure;
  s.bodies = {{.name = "rotor", .m = 3.0, .spins = true}, {.name = "ring", .m = 4.0}};
  if (is_shaft_at_rest) {
    s.rotors = {{.name = "still", .ratio = 0.0}};
    s.bodies[1].spins = true;
    s.bodies[1].rotor = "still";
  }
  s.bearings = {bearing(body("rotor"), isotropic(2e4, 30.0)),
                bearing(body("ring"), isotropic(9e4, 100.0))};
  s.unbalances = {{.at = body("rotor"), .moment = 3e-3}};
  all.contacts = {{.name = "ring",
                   .at = body("rotor"),
                   .against = body("ring"),
                   .clearance = 5e-4,
                   .friction = {.mu = 0.2, .radius = 0.05},
                   .law = Radial<>{.k = 1e6}}};
  return all;
}

// A shaft at rest is a stator: the same motion, to the bit.
TEST(TwoShafts, AShaftAtRestIsAStator) {
  std::vector<Vec> ends;
  for (const bool is_shaft_at_rest : {false, true}) {
    const Model model = in_a_ring(is_shaft_at_rest);
    const Scene scene = make_scene(model);
    MotionState state = start_of(model, scene);
    run(scene, state, 20, {});
    ends.push_back(state.y);
  }
  EXPECT_EQ(ends[0], ends[1]);
}

// What one shaft pushes the other pushes back: the contact changes no momentum, with friction.
TEST(TwoShafts, ActionIsReaction) {
  Spools spools;
  Model model = spools.model();
  model.reduction.method = ReductionMethod::none;
  const Scene with = make_scene(model);
  model.contacts.clear();
  const Scene without = make_scene(model);
  const StateLayout layout = with.contacts.layout();
  ASSERT_EQ(layout.size(), without.contacts.layout().size());
  Vec y = Vec::Zero(layout.size());
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (Eigen::Index i = 0; i < y.size(); ++i) y(i) = 1e-2 * normal(random);
  Vec a(layout.coordinates()), b(layout.coordinates());
  with.contacts.acceleration(0.0, y.data(), a.data());
  without.contacts.acceleration(0.0, y.data(), b.data());
  const System system = with.assembler.at(model.speed);
  const Vec force = system.M * (with.reduced.Phi * (a - b));
  double x = 0.0, f = 0.0;
  for (const Point& p : with.assembler.dofs().points()) {
    const int i = with.assembler.dofs().full_index(p, X);
    x += force(i);
    f = std::max(f, std::abs(force(i)));
  }
  EXPECT_GT(f, 1.0);
  EXPECT_LT(std::abs(x), 1e-10 * f);
}

}  // namespace whirl::two_shafts_test
