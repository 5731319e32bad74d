// What all integrators share: a step is the polynomials that it has, at any place of it, and what
// motions cost adds up.

#include <gtest/gtest.h>

#include <numbers>

#include "libdyn/system/trajectory.hpp"

namespace whirl::step_test {

constexpr double rounding = 1e-15;

/// Two coordinates, displacements of degree 2 and velocities of degree 3: powers by columns.
Step example() {
  Step step;
  step.set(Clock(-120.0), {0.5, 7}, 0.01);
  step.q = Mat{{1.0, -2.0, 3.0}, {0.5, 0.25, -1.0}};
  step.v = Mat{{4.0, 0.0, -1.0, 2.0}, {-3.0, 1.0, 0.5, 0.125}};
  return step;
}

TEST(Step, IsItsPolynomialsAtAnyPlace) {
  const Step step = example();
  for (const double s : {0.0, 0.25, 0.5, 0.9, 1.0}) {
    Vec y(4);
    step.at(s, y.data());
    EXPECT_NEAR(y(0), 1.0 - 2.0 * s + 3.0 * s * s, 8.0 * rounding);
    EXPECT_NEAR(y(1), 0.5 + 0.25 * s - s * s, 8.0 * rounding);
    EXPECT_NEAR(y(2), 4.0 - s * s + 2.0 * s * s * s, 8.0 * rounding);
    EXPECT_NEAR(y(3), -3.0 + s + 0.5 * s * s + 0.125 * s * s * s, 8.0 * rounding);
  }
}

// At both ends it is exact: what follows a step begins there.
TEST(Step, IsItsFirstCoefficientsAtItsStart) {
  const Step step = example();
  Vec y(4);
  step.at(0.0, y.data());
  EXPECT_EQ(y, (Vec{{1.0, 0.5, 4.0, -3.0}}));
  step.at(1.0, y.data());
  EXPECT_EQ(y, (Vec{{2.0, -0.25, 5.0, -1.375}}));
}

TEST(Step, MayRest) {
  Step step;
  step.q = Mat::Constant(1, 1, 1.5);
  step.v = Mat::Constant(1, 1, -0.5);
  for (const double s : {0.0, 0.7, 1.0}) {
    Vec y(2);
    step.at(s, y.data());
    EXPECT_EQ(y, (Vec{{1.5, -0.5}}));
  }
}

TEST(Step, HasAPhaseThatPassesEvenlyWithinItsRevolution) {
  const Step step = example();
  for (const double s : {0.0, 0.5, 1.0}) {
    EXPECT_NEAR(step.instant(s).phase, 0.5 + 1.2 * s, rounding);
    EXPECT_NEAR(step.after_turn(1.2 * s), s, rounding);
    EXPECT_EQ(step.instant(s).revolution, 7);
  }
  EXPECT_EQ(step.after_turn(-0.1), 0.0);
  EXPECT_EQ(step.after_turn(1.3), 1.0);
  MotionState state;
  state.revolution = 3'000'000'000L;
  state.phase = 1.5;
  EXPECT_EQ(state.instant().revolution, 3'000'000'000L);
  EXPECT_EQ(state.instant().phase, 1.5);
}

TEST(Cost, AddsUpNumberByNumber) {
  Cost sum{.steps = 1, .rejected = 20, .evaluations = 300, .events = 4000};
  const Cost other{.steps = 5, .rejected = 60, .evaluations = 700, .events = 8000};
  (sum += other) += other;
  EXPECT_EQ(sum.steps, 11);
  EXPECT_EQ(sum.rejected, 140);
  EXPECT_EQ(sum.evaluations, 1700);
  EXPECT_EQ(sum.events, 20000);
}

// An integration that says nothing has gone well.
TEST(Step, BelongsToAnIntegrationThatHasNotFailed) {
  const Integration run;
  EXPECT_EQ(run.outcome, Outcome::reached_end);
  EXPECT_FALSE(run.failure);
  EXPECT_GT(IntegrationOptions{}.tolerance, 0.0);
  EXPECT_EQ(IntegrationOptions{}.fixed_step, 0.0);
}

}  // namespace whirl::step_test
