// Free flight: whether nothing can be touched any more, and the rest of the motion in closed form.

#include "libdyn/flow/free_flight.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/scenes.hpp"

namespace whirl::free_flight_test {

using test::MassInRing;
using test::RotorStator;

MotionState apart(Vec y) {
  MotionState state = test::state_of(std::move(y));
  state.contacts = {ContactState{}};
  return state;
}
bool is_certain(const Scene& scene, const MotionState& state) {
  return FreeFlight(scene.contacts).is_certain(state);
}

// A mass without loads, with slight damping: its largest displacement is known.
TEST(FreeFlight, IsCertainOfWhatStaysWithinTheClearance) {
  const MassInRing p{.k = 1e4, .c = 2.0, .clearance = 1e-3};
  const Scene scene = p.scene();
  EXPECT_TRUE(is_certain(scene, apart(Vec::Zero(4))));
  EXPECT_TRUE(is_certain(scene, apart((Vec(4) << 9e-4, 0.0, 0.0, 0.0).finished())));
  // 1.1 clearances on the way: v / w = 1.1e-3 m
  EXPECT_FALSE(is_certain(scene, apart((Vec(4) << 0.0, 0.0, 0.11, 0.0).finished())));
}

// A mass that whirls about the center of its ring within the clearance never touches it, however
// slowly it decays: its mode's radius bounds it.
TEST(FreeFlight, IsCertainOfAWhirlThatFillsItsRing) {
  const MassInRing p{.k = 1e4, .c = 0.01, .clearance = 1e-3};
  const Scene scene = p.scene();
  const double w = 100.0;
  for (const double share : {0.9, 0.999, 1.001}) {
    const double r = share * p.clearance;
    const MotionState whirl = apart((Vec(4) << r, 0.0, 0.0, w * r).finished());
    EXPECT_EQ(is_certain(scene, whirl), share < 1.0) << share;
  }
}

// Where it ends is the response in closed form, X = U Omega^2 / (k - m Omega^2 + i c Omega).
TEST(FreeFlight, KnowsItsSteadyState) {
  const MassInRing p{.Omega = 130.0, .c = 0.05, .U = 1e-5, .clearance = 1e-3};
  const Scene scene = p.scene();
  FreeFlight flight(scene.contacts);
  ASSERT_TRUE(flight.decays());
  const Complex X = p.U * p.Omega * p.Omega / Complex(p.k - p.m * p.Omega * p.Omega, p.c * p.Omega);
  const Complex turned = X * std::polar(1.0, 0.7);
  EXPECT_NEAR(flight.steady_state(0.7)(0), turned.real(), 1e-15);
  EXPECT_NEAR(flight.steady_state(0.7)(1), turned.imag(), 1e-15);
  const Scene undamped = MassInRing{.c = 0.0}.scene();
  EXPECT_FALSE(FreeFlight(undamped.contacts).decays());
}

// The circle of unbalance leaves a thousandth of its ring, or reaches a thousandth beyond. What 256
// places along a circle may miss is taken as 1.5e-4 of its radius.
TEST(FreeFlight, IsCertainOfACircleOfUnbalanceThatFillsItsRing) {
  MassInRing p{.Omega = 130.0, .c = 20.0, .U = 1e-5, .clearance = 1e-3};
  const double r =
      p.U * p.Omega * p.Omega / std::abs(Complex(p.k - p.m * p.Omega * p.Omega, p.c * p.Omega));
  for (const double share : {0.9, 0.999, 1.001}) {
    p.clearance = r / share;
    const Scene scene = p.scene();
    FreeFlight flight(scene.contacts);
    ASSERT_TRUE(flight.decays());
    EXPECT_EQ(flight.is_certain(apart(flight.steady_state(0.0))), share < 1.0) << share;
  }
}

TEST(FreeFlight, IsNotCertainWithoutDecay) {
  const Vec y = (Vec(4) << 1e-5, 0.0, 0.0, 0.0).finished();
  EXPECT_FALSE(is_certain(MassInRing{.c = 0.0}.scene(), apart(y)));
  EXPECT_FALSE(is_certain(MassInRing{.k = 0.0, .c = 0.0}.scene(), apart(y)));
  EXPECT_TRUE(is_certain(MassInRing{.c = 1.0}.scene(), apart(y)));
}

TEST(FreeFlight, IsNotCertainInTouchOrOutOfReachOfTheLoads) {
  MassInRing p{.c = 20.0, .clearance = 1e-3};
  MotionState state = apart(Vec::Zero(4));
  state.contacts[0].touch = Touch::receding;
  EXPECT_FALSE(is_certain(p.scene(), state));
  p.gravity = 9.81;  // sags by g m / k = 0.981 mm
  EXPECT_TRUE(is_certain(p.scene(), apart((Vec(4) << 0.0, -9.81e-4, 0.0, 0.0).finished())));
  p.gravity = 10.1;
  EXPECT_FALSE(is_certain(p.scene(), apart((Vec(4) << 0.0, -1.0e-3, 0.0, 0.0).finished())));
}

// What is called certain is: no event in the next revolutions from 200 random states, of which the
// larger ones are not certain.
TEST(FreeFlight, IsRight) {
  const RotorStator p{.Omega = 100.0};
  const Scene scene = p.scene();
  FreeFlight flight(scene.contacts);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  int certain = 0;
  const MotionState rest = test::start_of(p.model(), scene);
  for (int i = 0; i < 200; ++i) {
    MotionState state = rest;
    for (Eigen::Index k = 0; k < 8; ++k) {
      state.y(k) += 0.02 * scene.contacts.state_scale()(k) * (i % 20) * normal(random);
    }
    state.contacts = scene.contacts.classify(0.0, state.y.data());
    if (!flight.is_certain(state)) continue;
    ++certain;
    EXPECT_EQ(test::run(scene, state, 20, {.tolerance = 1e-6}).cost.events, 0) << i;
  }
  EXPECT_GT(certain, 20);
  EXPECT_LT(certain, 180);
}

/// Rotor and stator apart after a push.
MotionState pushed(const RotorStator& p, const Scene& scene) {
  MotionState state = test::start_of(p.model(), scene);
  state.y(0) += 2e-4;
  state.y(5) += 0.05;
  return state;
}

// The same motion with and without a certificate: a wider clearance gives one. Steps with a search
// for contacts on one side, a jump on the other.
TEST(FreeFlight, JumpsToWhereStepsLead) {
  constexpr double roundings = 1e-12;
  RotorStator narrow{.Omega = 100.0, .gap = 2.2e-3}, wide{.Omega = 100.0, .gap = 1.0};
  const Scene a = narrow.scene(), b = wide.scene();
  MotionState x = pushed(narrow, a), y = pushed(wide, b);
  x.phase = y.phase = 1.0;
  x.contacts = y.contacts = {ContactState{}};
  ASSERT_FALSE(is_certain(a, x));
  ASSERT_TRUE(is_certain(b, y));
  const Integration steps = test::run(a, x, 3, {.method = Collocation{}});
  const Integration jump = test::run(b, y, 3, {.method = Collocation{}});
  EXPECT_EQ(steps.cost.events, 0);
  EXPECT_GT(steps.cost.steps, 3);
  EXPECT_EQ(jump.cost.steps, 1);
  EXPECT_LT(distance(a.contacts, x.y, y.y), roundings);
}

// One step for a million revolutions, and no error: what is left is the steady motion,
// x = Re(X e^(i Omega t)), X = U Omega^2 / (k - m Omega^2 + i c Omega), at phase 0.
TEST(FreeFlight, TakesAMillionRevolutionsInOneStep) {
  const MassInRing p{.Omega = 130.0, .c = 0.05, .U = 1e-5, .clearance = 1e-3};
  const Scene scene = p.scene();
  MotionState state = test::state_of(Vec2(1e-4, 0.0), Vec2(0.0, 0.0));
  const Integration result = test::run(scene, state, 1'000'000, {.method = Collocation{}});
  EXPECT_EQ(result.cost.steps, 1);
  EXPECT_EQ(state.revolution, 1'000'000);
  EXPECT_EQ(state.phase, 0.0);
  const Complex X = p.U * p.Omega * p.Omega / Complex(p.k - p.m * p.Omega * p.Omega, p.c * p.Omega);
  EXPECT_NEAR(state.y(0), X.real(), 1e-13 * p.clearance);
  EXPECT_NEAR(state.y(1), X.imag(), 1e-13 * p.clearance);  // y lags by a quarter: -i X
}

// While the start still rings: x = e^(-a t) (cos w t + a / w sin w t) x0 after 1000 revolutions,
// 6283 rad of its own. Rounding of one revolution a thousand times.
TEST(FreeFlight, KeepsThePhaseOfWhatStillRings) {
  const MassInRing p{.Omega = 100.0, .c = 0.01, .clearance = 1e-3};
  const Scene scene = p.scene();
  const double x0 = 1e-4, a = p.c / 2.0, w = std::sqrt(p.k - a * a);
  MotionState state = test::state_of(Vec2(x0, 0.0), Vec2(0.0, 0.0));
  test::run(scene, state, 1000, {.method = Collocation{}});
  const double t = 1000.0 * scene.contacts.period();
  const double x = std::exp(-a * t) * (std::cos(w * t) + a / w * std::sin(w * t)) * x0;
  EXPECT_NEAR(state.y(0), x, 1e-12 * x0 * 10.0);
}

// An observer sees every revolution of a certified run, and the end is the same.
TEST(FreeFlight, GivesStepsToAnObserver) {
  constexpr double roundings = 1e-12;
  const MassInRing p{.Omega = 130.0, .c = 5.0, .U = 1e-5, .clearance = 1e-3};
  const Scene scene = p.scene();
  MotionState jump = test::state_of(Vec2(1e-4, 0.0), Vec2(0.0, 0.01)), seen = jump;
  test::run(scene, jump, 50, {.method = Collocation{}});
  long last = -1;
  double phase = 0.0;
  test::run(scene, seen, 50, {.method = Collocation{}}, [&](const Step& step) {
    EXPECT_TRUE(step.revolution == last || step.revolution == last + 1);
    EXPECT_NEAR(step.phase, step.revolution == last ? phase : 0.0, 1e-12);
    last = step.revolution;
    phase = step.angle(1.0);
    return true;
  });
  EXPECT_EQ(last, 49);
  EXPECT_LT(distance(scene.contacts, jump.y, seen.y), roundings);
}

}  // namespace whirl::free_flight_test
