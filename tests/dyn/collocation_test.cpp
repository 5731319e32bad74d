// Collocation: closed forms without contact, orders over events, agreement with DOP853 for every
// kind of contact, and a cost that does not follow the fastest mode.

#include "libdyn/methods/collocation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libdyn/flow/free_flight.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::collocation_test {

using test::MassInRing;
using test::order_of;
using test::pi;
using test::RotorStator;

const AnyMethod collocation = Collocation{};

// ---- free motion --------------------------------------------------------------------------------

/// x of m x'' + c x' + k x = U Omega^2 cos(Omega t), in closed form: particular solution and
///
///   e^(-a t) (x0 C + (v0 + a x0) S),   C = cos w t, S = sin(w t) / w,   w^2 = k / m - a^2
///
/// with cosh and sinh for w^2 < 0 and 1 and t for w^2 = 0. Free (k = c = 0): x = U (1 - cos) / m +
/// v t.
struct FreeMotion {
  MassInRing p;
  double x0 = 2e-4, v0 = 0.03;

  Vec2 at(double t) const {
    const double a = p.c / (2.0 * p.m), w2 = p.k / p.m - a * a, W = p.Omega;
    const Complex X = p.U * W * W / Complex(p.k - p.m * W * W, p.c * W);
    const double xp = X.real(), vp = -W * X.imag();  // at t = 0
    const double w = std::sqrt(std::abs(w2));
    const double C = w2 > 0.0 ? std::cos(w * t) : w2 < 0.0 ? std::cosh(w * t) : 1.0;
    const double S = w2 > 0.0 ? std::sin(w * t) / w : w2 < 0.0 ? std::sinh(w * t) / w : t;
    const double e = std::exp(-a * t), x = x0 - xp, v = v0 - vp;
    const Complex now = X * std::polar(1.0, W * t);
    return {e * (x * C + (v + a * x) * S) + now.real(),
            e * (v * C - (a * v + p.k / p.m * x) * S) - W * now.imag()};
  }
};
std::vector<std::pair<std::string, FreeMotion>> free_motions() {
  const MassInRing mass{.m = 2.0, .k = 2e4, .U = 1e-4, .clearance = 2e-3};
  const auto damped = [&](double zeta) {
    MassInRing p = mass;
    p.c = 2.0 * zeta * p.m * 100.0;
    p.Omega = 130.0;
    return FreeMotion{p};
  };
  MassInRing loose = mass;
  loose.k = 0.0;
  loose.clearance = 0.1;
  return {{"undamped", damped(0.0)},    {"damped", damped(0.05)},
          {"critical", damped(1.0)},    {"nearly", damped(1.0 + 1e-9)},
          {"overdamped", damped(15.0)}, {"free", FreeMotion{loose}}};
}

// Exact whatever the damping: underdamped, critical (a defective pair), overdamped and rigid-body
// motion, at the end and within steps. In clearances and clearances times Omega.
TEST(Collocation, IsExactWithoutContact) {
  constexpr double roundings = 1e-13;
  for (const auto& named : free_motions()) {
    const std::string& name = named.first;
    const FreeMotion& motion = named.second;
    SCOPED_TRACE(name);
    const Scene scene = motion.p.scene();
    const double period = scene.contacts.period(), c = motion.p.clearance;
    MotionState state = test::state_of(Vec2(motion.x0, 0.0), Vec2(motion.v0, 0.0));
    MotionState seen = state;
    test::run(scene, state, 3, {.method = collocation});
    const Vec2 end = motion.at(3.0 * period);
    EXPECT_NEAR(state.y(0), end(0), roundings * c);
    EXPECT_NEAR(state.y(2), end(1), roundings * c * motion.p.Omega);

    constexpr double dense = 1e-11;  // tolerance 1e-12 of the pieces
    double worst = 0.0;
    Vec y(4);
    test::run(scene, seen, 3, {.tolerance = 1e-12, .method = collocation}, [&](const Step& step) {
      for (double s = 0.0; s <= 1.0; s += 0.125) {
        step.at(s, y.data());
        const Vec2 x =
            motion.at((static_cast<double>(step.revolution) + step.angle(s) / (2.0 * pi)) * period);
        worst = std::max(
            {worst, std::abs(y(0) - x(0)) / c, std::abs(y(2) - x(1)) / (c * motion.p.Omega)});
      }
      return true;
    });
    EXPECT_LT(worst, dense);
    EXPECT_LT(distance(scene.contacts, seen.y, state.y), roundings);
  }
}

// ---- orders -------------------------------------------------------------------------------------

/// Order after some revolutions, against controlled steps of DOP853.
double order_over(const Scene& scene, const MotionState& start, long revolutions,
                  const std::vector<double>& steps) {
  MotionState reference = start;
  const long events = test::run(scene, reference, revolutions, {.tolerance = 1e-15}).cost.events;
  std::vector<double> error;
  for (const double n : steps) {
    MotionState state = start;
    const Integration result =
        test::run(scene, state, revolutions,
                  {.fixed_step = scene.contacts.period() / n, .method = collocation});
    EXPECT_EQ(result.cost.events, events) << n;
    error.push_back(distance(scene.contacts, state.y, reference.y));
    EXPECT_GT(error.back(), 2e-13) << n;  // else rounding is measured
  }
  return order_of(steps, error);
}
MotionState settled(const RotorStator& p, const Scene& scene) {
  MotionState state = test::start_of(p.model(), scene);
  test::run(scene, state, 400, {.method = collocation});
  return state;
}

// Eight Gauss points give order 16; here w_c h is 5.9 to 3.9, before rounding, and 14.7 is
// measured.
TEST(Collocation, HasAlmostTwiceTheOrderOfItsPointsInPermanentContact) {
  const Scene scene = test::P3.scene();
  MotionState start = settled(test::P3, scene);
  start.y.tail(4) *= 1.05;  // not only the circle
  EXPECT_NEAR(order_over(scene, start, 1, {12.0, 13.0, 14.0, 15.0, 16.0, 17.0, 18.0}), 14.7, 0.5);
}

// Steps that events cut short use their force polynomial in part, which leaves h^9 of the velocity.
// Single errors scatter with the places of the cuts.
TEST(Collocation, KeepsItsOrderOverEvents) {
  const Scene two = test::P2.scene(), five = test::P1.scene();
  EXPECT_NEAR(order_over(two, settled(test::P2, two), 5,
                         {10.0, 12.0, 14.0, 16.0, 18.0, 20.0, 22.0, 24.0, 26.0, 28.0, 30.0, 32.0,
                          34.0, 36.0, 38.0, 40.0, 44.0}),
              9.0, 0.5);
  EXPECT_NEAR(order_over(five, settled(test::P1, five), 2,
                         {32.0, 36.0, 40.0, 44.0, 48.0, 52.0, 56.0, 60.0, 64.0, 70.0, 76.0, 84.0}),
              9.5, 0.5);
}

// ---- agreement ----------------------------------------------------------------------------------

struct Case {
  std::string name;
  Model model;
  long settle;
};
/// Every kind of contact: continuous, damped; friction exact with and without reversals, rolling,
/// smoothed, forward; several contacts, against bodies and the ground.
std::vector<Case> cases() {
  const auto with = [](RotorStator p, auto change) {
    change(p);
    return p.model();
  };
  std::vector<Case> all{
      {"P1", test::P1.model(), 50},
      {"P2", test::P2.model(), 50},
      {"P3", test::P3.model(), 50},
      {"damped", with(test::P1, [](auto& p) { p.cC = 2e4; }), 50},
      {"smoothed", with(test::P2, [](auto& p) { p.R = 0.01, p.mu = 0.3, p.slip_tolerance = 2.0; }),
       5},
      {"forward", with(test::P2, [](auto& p) { p.slip = Slip::forward; }), 50},
      {"offset",
       with(test::P1,
            [](auto& p) {
              p.offset = {1e-3, -5e-4};
            }),
       50},
      {"reversals", with(test::P2, [](auto& p) { p.R = 0.01, p.mu = 0.3; }), 5},
      {"starts rolling", with(RotorStator{}, [](auto& p) { p.kC = 3e6, p.mu = 0.4, p.R = 0.05; }),
       0},
      {"rolls", with(RotorStator{}, [](auto& p) { p.kC = 3e6, p.mu = 0.4, p.R = 0.05; }), 100},
  };
  Model two = test::P1.model();  // and a soft ring around the stator, damped, that stands still
  two.contacts.push_back({.name = "outer",
                          .at = test::body("stator"),
                          .clearance = 1.5e-4,
                          .friction = {.mu = 0.2, .radius = 0.0},
                          .law = Radial<>{.k = 2e7, .c = 5e3}});
  two.contacts.push_back({.name = "snubber",
                          .at = test::body("rotor"),
                          .clearance = 5.9e-3,
                          .friction = {.mu = 0.1, .radius = 0.1},
                          .law = Radial<>{.k = 1e7}});
  all.push_back({"three contacts", two, 20});
  return all;
}

// Within 5 revolutions, from a motion that has settled or not.
TEST(Collocation, AgreesWithDop853InEveryKindOfContact) {
  constexpr double tolerance = 1e-11;
  constexpr double allowed = 10.0;  // times the tolerance: four times the largest ratio met
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Scene scene = make_scene(c.model);
    MotionState a = test::start_of(c.model, scene);
    test::run(scene, a, c.settle, {.method = collocation});
    MotionState b = a;
    const Integration expected = test::run(scene, a, 5, {.tolerance = 1e-13});
    const Integration result =
        test::run(scene, b, 5, {.tolerance = tolerance, .method = collocation});
    EXPECT_EQ(result.outcome, Outcome::reached_end) << result.failure;
    EXPECT_EQ(result.cost.events, expected.cost.events);
    EXPECT_EQ(a.contacts, b.contacts);
    EXPECT_LT(distance(scene.contacts, a.y, b.y), allowed * tolerance);
  }
}

// Rolling: no slip at the ends of steps and between, friction below its limit.
TEST(Collocation, RollsWithoutSlip) {
  const RotorStator p{.kC = 3e6, .mu = 0.4, .R = 0.05};
  const Scene scene = p.scene();
  MotionState state = test::start_of(p.model(), scene);
  test::run(scene, state, 100, {.method = collocation});
  ASSERT_EQ(state.contacts[0].touch, Touch::sticking);
  const double rim = p.Omega * p.R;
  double worst = 0.0;
  Vec y(8);
  test::run(scene, state, 5, {.method = collocation}, [&](const Step& step) {
    EXPECT_EQ(step.contacts[0].touch, Touch::sticking);
    for (double s = 0.0; s <= 1.0; s += 0.25) {
      step.at(s, y.data());
      worst = std::max(worst, std::abs(kinematics(scene.contacts.contacts()[0], y.data(), 4).slip));
    }
    return true;
  });
  EXPECT_LT(worst, 1e-9 * rim);
}

// ---- stiff models -------------------------------------------------------------------------------

/// The two-disk rotor of models/two_disk_mac.toml: 12 elements, 52 dofs.
Model two_disk_rotor(Reduction reduction) {
  Model m;
  m.speed = 4430.0 * test::rpm;
  m.has_speed = true;
  Structure& s = m.structure;
  s.shaft = {test::cylinder(0.6, 0.02, 12)};
  const double mass = 7800.0 * pi / 4.0 * (0.3 * 0.3 - 0.02 * 0.02) * 0.01;
  const double Ip = mass * (0.3 * 0.3 + 0.02 * 0.02) / 8.0;
  const double Id = 0.5 * Ip + mass * 0.01 * 0.01 / 12.0;
  s.disks = {{.at = test::node(4), .m = mass, .Id = Id, .Ip = Ip},
             {.at = test::node(9), .m = mass, .Id = Id, .Ip = Ip}};
  s.unbalances = {{.at = test::node(4), .moment = mass * 5e-4}};
  s.bearings = {test::bearing(test::node(1), test::isotropic(8e6, 5e3)),
                test::bearing(test::node(13), test::isotropic(8e6, 5e3))};
  m.contacts = {{.name = "ring",
                 .at = test::node(7),
                 .clearance = 5e-3,
                 .friction = {.radius = 0.01},
                 .law = Radial<>{.k = 4e6}}};
  m.reduction = reduction;
  m.start.whirl = {{.mode = 1, .amplitude = 4e-3}, {.mode = 2, .amplitude = 3e-3}};
  return m;
}

/// P1 with a small mass on its rotor that adds a pair of modes: frequency w [rad/s], damping zeta.
Model with_chip(double w, double zeta) {
  constexpr double m = 0.05;  // a thousandth of the rotor
  Model model = test::P1.model();
  model.structure.bodies.push_back({.name = "chip", .m = m, .spins = true});
  model.structure.bearings.push_back(test::connect(test::body("chip"), test::body("rotor"),
                                                   test::isotropic(m * w * w, 2.0 * zeta * m * w)));
  return model;
}

/// Steps per revolution of settled motion, and its error after one.
struct Effort {
  double steps, error;
};
Effort effort(const Model& model, double tolerance) {
  const Scene scene = make_scene(model);
  MotionState start = test::start_of(model, scene);
  test::run(scene, start, 100, {.method = collocation});
  MotionState a = start, b = start;
  test::run(scene, a, 1, {.tolerance = tolerance, .method = collocation});
  test::run(scene, b, 1, {.tolerance = 1e-11});
  const double error = distance(scene.contacts, a.y, b.y);
  const Integration result =
      test::run(scene, a, 10, {.tolerance = tolerance, .method = collocation});
  return {static_cast<double>(result.cost.steps) / 10.0, error};
}

// As many steps with a mode at 1e5 rad/s, 34 times the contact frequency, and with one of a damping
// ratio of 15 as without. (DOP853 takes 25 times as many.)
TEST(Collocation, CostsNoMoreStepsWithFasterModes) {
  constexpr double tolerance = 1e-8;
  const Effort plain = effort(test::P1.model(), tolerance);
  for (const auto& [w, zeta] : {std::pair{1e5, 0.01}, std::pair{1e3, 15.0}}) {
    const Effort stiff = effort(with_chip(w, zeta), tolerance);
    EXPECT_LT(stiff.steps, 1.2 * plain.steps) << w;
    EXPECT_LT(stiff.error, 20.0 * tolerance) << w;
  }
}

TEST(Collocation, IsPreferredForModesFasterThanTheContacts) {
  EXPECT_FALSE(prefers_collocation(test::P1.scene().contacts));
  EXPECT_TRUE(prefers_collocation(make_scene(with_chip(1e5, 0.01)).contacts));
  EXPECT_TRUE(prefers_collocation(make_scene(with_chip(1e3, 15.0)).contacts));
}

TEST(Collocation, AgreesWithDop853OnTheTwoDiskRotor) {
  const Model model = two_disk_rotor({.method = ReductionMethod::modal, .modes = 8});
  const Scene scene = make_scene(model);
  MotionState a = test::start_of(model, scene);
  test::run(scene, a, 50, {.method = collocation});
  MotionState b = a;
  test::run(scene, a, 5, {.tolerance = 1e-13});
  test::run(scene, b, 5, {.tolerance = 1e-9, .method = collocation});
  EXPECT_LT(distance(scene.contacts, a.y, b.y), 1e-8);
}

// 104 states, the fastest at 4.5e5 rad/s and hardly damped: forces follow all of them, which takes
// more steps than 8 modes do, and fewer than DOP853.
TEST(Collocation, TakesAnUnreducedModel) {
  const Model model = two_disk_rotor({.method = ReductionMethod::none});
  const Scene scene = make_scene(model);
  ASSERT_EQ(scene.contacts.coordinates(), 52);
  EXPECT_TRUE(prefers_collocation(scene.contacts));
  MotionState a = test::start_of(model, scene), b = a;
  const Integration result = test::run(scene, a, 1, {.tolerance = 1e-8, .method = collocation});
  EXPECT_EQ(result.outcome, Outcome::reached_end) << result.failure;
  const Integration expected = test::run(scene, b, 1, {.tolerance = 1e-8, .method = Dop853{}});
  EXPECT_EQ(result.cost.events, expected.cost.events);
  EXPECT_LT(result.cost.steps, expected.cost.steps);
  // displacement at the contact, in clearances: DOP853's own error at this tolerance is 1.8e-10
  // there and 7.5e-5 in velocities of the fastest modes, collocation's 4e-10 in all of them
  const ReducedContact& ring = scene.contacts.contacts()[0];
  EXPECT_LT((ring.U * (a.y - b.y).head(52)).norm(), 1e-9 * ring.clearance);
}

// ---- what has no end ----------------------------------------------------------------------------

/// A rotor that cross-coupled stiffness drives out, in a soft guard: it grows without bound.
Model growing() {
  MassInRing p{
      .Omega = 314.16, .m = 10.0, .U = 2e-5, .kC = 1e4, .mu = 0.05, .R = 0.03, .clearance = 5e-4};
  Model model = p.model();
  BearingCoefficients b;
  b.K << 1e6, 1.5e5, -1.5e5, 1e6;
  b.C << 200.0, 0.0, 0.0, 200.0;
  model.structure.bearings = {test::bearing(test::body("mass"), b)};
  return model;
}

// A motion that grows by e^14 in a second passes 1e10 clearances within 105 revolutions. Pieces of
// the dense output have an error relative to it: absolute ones would be halved to no end.
TEST(Collocation, ShowsAMotionThatGrowsInAsManyPiecesAsItTakes) {
  constexpr long too_many = 20'000;  // pieces; some ten a revolution are enough
  const Model model = growing();
  const Scene scene = make_scene(model);
  ASSERT_TRUE(prefers_collocation(scene.contacts));
  MotionState state = test::start_of(model, scene), other = state;
  long pieces = 0;
  const Integration run = test::run(scene, state, 105, {.method = collocation},
                                    [&](const Step&) { return ++pieces < too_many; });
  ASSERT_EQ(run.outcome, Outcome::reached_end) << pieces << " " << run.failure;
  EXPECT_GT(state.y.head(2).norm(), 1e10 * 5e-4);
  test::run(scene, other, 105, {.method = AnyMethod(Taylor{})});
  EXPECT_LT((state.y - other.y).norm(), 1e-6 * other.y.norm());
}

// Beyond its tables of step sizes a revolution cannot be computed: it says so.
TEST(Collocation, RefusesARevolutionOfTooManyPeriods) {
  for (const MassInRing& p : {MassInRing{.Omega = 1e-18, .k = 1e6, .c = 10.0},
                              MassInRing{.Omega = 100.0, .k = 1e6, .c = 1e21}}) {
    const Scene scene = p.scene();
    MotionState state = test::state_of({1e-4, 0.0}, {0.0, 0.0});
    EXPECT_THROW(test::run(scene, state, 1, {.method = collocation}), NumericalError) << p.Omega;
  }
}

// Without an end that is certain, Taylor series go on step by step until they are stopped.
TEST(FreeFlight, IsNotCertainWhereARevolutionIsOfTooManyPeriods) {
  const Scene scene = MassInRing{.Omega = 1e-18, .k = 1e6, .c = 10.0}.scene();
  FreeFlight flight(scene.contacts);
  MotionState state = test::state_of({1e-4, 0.0}, {0.0, 0.0});
  state.contacts = scene.contacts.classify(0.0, state.y.data());
  EXPECT_FALSE(flight.is_certain(state));
  EXPECT_FALSE(flight.decays());  // or a motion that has not settled would be finished
}

// Contacts far stiffer than any step can follow end in a message, whatever the tables hold.
TEST(Collocation, FailsAtAContactBeyondItsShortestStep) {
  const Scene scene = MassInRing{.Omega = 1.0, .kC = 1e40}.scene();
  MotionState state = test::state_of({0.0, 0.0}, {1.0, 0.0});
  const Integration run = test::run(scene, state, 1, {.method = collocation});
  EXPECT_NE(run.outcome, Outcome::reached_end);
  EXPECT_TRUE(run.failure);
}

}  // namespace whirl::collocation_test
