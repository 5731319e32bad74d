// The engine in quadruple precision: consistent with itself far below double, the double engine
// consistent with it.

#include <gtest/gtest.h>

#include "libdyn/taylor/batch.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::quad_test {

using test::RotorStator;

constexpr long settled = 400, revolutions = 20;

/// A motion after its transient.
struct Motion {
  Scene scene;
  MotionState start;

  explicit Motion(const RotorStator& p, long transient = settled) : scene(p.scene()) {
    start = test::start_of(p.model(), scene);
    test::run(scene, start, transient, {.tolerance = 1e-12});
  }
  Trajectory quad(const BatchOptions& options, long count = revolutions) const {
    Trajectory t{.system = &scene.contacts, .state = start, .revolutions = count};
    integrate_quad(t, options);
    EXPECT_EQ(t.outcome, Outcome::reached_end) << t.failure;
    EXPECT_EQ(t.state.revolution, start.revolution + count);
    return t;
  }
};

/// Largest difference of the ends in all their digits; as distance.
double distance(const Trajectory& a, const Trajectory& b) {
  const Vec apart = (a.state.y - b.state.y) + (a.lower_digits - b.lower_digits);
  return (apart.array() / a.system->state_scale().array()).abs().maxCoeff();
}

const BatchOptions tight{.tolerance = 1e-28};               // order 30
const BatchOptions other{.tolerance = 1e-24, .order = 26};  // other steps, other truncation

constexpr double far_below_double = 1e-20;  // some 1000 steps of 1e-24, and what may grow

/// Two orders agree to the error of the coarser one, and double to its own.
void expect_consistent(const RotorStator& p, double of_double, long count = revolutions) {
  const Motion motion(p);
  const Trajectory a = motion.quad(tight, count), b = motion.quad(other, count);
  EXPECT_LT(distance(a, b), far_below_double);
  EXPECT_GT(distance(a, b), 0.0);
  EXPECT_EQ(a.cost.events, b.cost.events);
  MotionState state = motion.start;
  const Integration result = test::run(motion.scene, state, count, {.tolerance = 1e-15});
  EXPECT_EQ(result.cost.events, a.cost.events);
  EXPECT_LT(distance(motion.scene.contacts, state.y, a.state.y), of_double);
}

// Rounding of double is some 1e-15 in each of 1000 steps. P4 lets deviations grow.
constexpr double rounding = 1e-13, rounding_of_chaos = 1e-11;

TEST(Quad, IsConsistentFarBelowDoubleWithImpacts) {
  expect_consistent(test::P1, rounding);
}
TEST(Quad, IsConsistentFarBelowDoubleWithLongContacts) {
  expect_consistent(test::P2, rounding);
}
TEST(Quad, IsConsistentFarBelowDoubleInPermanentContact) {
  expect_consistent(test::P3, rounding);
}
TEST(Quad, IsConsistentFarBelowDoubleInWeakChaos) {
  expect_consistent(test::P4, rounding_of_chaos);
}

constexpr long some = 3;  // revolutions, of what has all its events in one

// Damped contacts let go where their force vanishes, smooth friction is a tanh of the slip.
TEST(Quad, IsConsistentWithDampedContacts) {
  RotorStator p = test::P1;
  p.cC = 1e3;
  expect_consistent(p, rounding, some);
}
TEST(Quad, IsConsistentWithSmoothFriction) {
  RotorStator p = test::P1;
  p.slip_tolerance = 1.0;
  expect_consistent(p, rounding, some);
}

// A ring with much friction: the rotor bounces, slides back and forth, and in the 16th revolution
// begins to roll. Double only decides that it sticks.
TEST(Quad, IsConsistentWithSticking) {
  RotorStator p = test::P4;
  p.kC = 20e6;
  p.mu = 0.5;
  const Motion motion(p, 13);
  BatchOptions measured = tight;
  measured.measures = true;
  const Trajectory a = motion.quad(measured, some), b = motion.quad(other, some);
  EXPECT_LT(distance(a, b), far_below_double);
  EXPECT_EQ(a.cost.events, 6);
  EXPECT_GT(a.contacts[0].sticking, 0.8 * motion.scene.contacts.period());
}

// Friction that sticks and slides anew several times in a revolution. Where sticking ends, the
// force is at its limit: what happens there can only be told from all digits.
TEST(Quad, IsConsistentWithStickingThatEnds) {
  const RotorStator p{.Omega = 120.0, .kC = 3e6, .mu = 0.3, .gap = 1e-3, .R = 1e-3};
  const Motion motion(p, 100);
  BatchOptions measured = tight;
  measured.measures = true;
  const Trajectory a = motion.quad(measured, some), b = motion.quad(other, some);
  EXPECT_LT(distance(a, b), far_below_double);
  EXPECT_GT(a.contacts[0].sticking, 0.1 * motion.scene.contacts.period());
  EXPECT_LT(a.contacts[0].sticking, motion.scene.contacts.period());
  MotionState state = motion.start;
  test::run(motion.scene, state, some, {.tolerance = 1e-15});
  EXPECT_LT(distance(motion.scene.contacts, state.y, a.state.y), rounding_of_chaos);
}

// A mass on a spring of m Omega^2 swings once in a revolution: it comes back to where it
// was, to rounding of 113 bits (2e-34) in some 500 steps. A revolution short of 2 pi by rounding of
// double would miss by 1e-14.
TEST(Quad, KnowsARevolutionToTheLastDigit) {
  const Scene scene =
      test::MassInRing{.Omega = 100.0, .m = 1.0, .k = 1e4, .clearance = 1e-2}.scene();
  Trajectory t{.system = &scene.contacts,
               .state = test::state_of(Vec2(1e-3, 2e-3), Vec2(0.1, -0.3)),
               .revolutions = revolutions};
  const Vec start = t.state.y;
  integrate_quad(t, {.tolerance = 1e-31});
  const Vec missed = (t.state.y - start) + t.lower_digits;
  EXPECT_LT((missed.array() / scene.contacts.state_scale().array()).abs().maxCoeff(), 1e-28);
}

// The digits below double are the state's: with them a run goes on as if it had not been cut.
TEST(Quad, GoesOnWithAllDigits) {
  const Motion motion(test::P1);
  const Trajectory whole = motion.quad(other, 2);
  Trajectory parts = motion.quad(other, 1);
  EXPECT_GT(parts.lower_digits.cwiseAbs().maxCoeff(), 0.0);
  integrate_quad(parts, other);
  EXPECT_LT(distance(parts, whole), 1e-28);
}

// The tangent comes from the same template: it agrees with that of double, whose state is rounded
// to 1e-14 of the length scale, which turns the tangent by a thousand times as much.
TEST(Quad, CarriesTangents) {
  const Motion motion(test::P1);
  const BatchOptions options{.tolerance = 1e-16, .order = 12, .tangent = true};
  const Trajectory quad = motion.quad(options, 1);
  Trajectory t{.system = &motion.scene.contacts, .state = motion.start, .revolutions = 1};
  integrate_single(t, options);
  EXPECT_LT((quad.tangent - t.tangent).norm(), 1e-11 * t.tangent.norm());
}

}  // namespace whirl::quad_test
