// How many equal steps there are: whole numbers, none longer than asked for, a thousand a
// revolution at the usual tolerance.

#include "libdyn/system/equal_steps.hpp"

#include <gtest/gtest.h>

namespace whirl::equal_steps_test {

constexpr double period = 0.045;  ///< [s]

TEST(EqualSteps, AreAsLongAsTheFixedStepAtMost) {
  const IntegrationOptions options{.tolerance = 1e-6, .fixed_step = 3e-3};
  EXPECT_EQ(equal_steps(period, period, options), 15.0);
  EXPECT_EQ(equal_steps(period, 0.5 * period, options), 8.0);  // 7.5
  EXPECT_EQ(equal_steps(period, 3.1e-3, options), 2.0);
  EXPECT_EQ(equal_steps(period, 2.9e-3, options), 1.0);
}

// A sum of steps that rounding makes a little longer is no further step.
TEST(EqualSteps, AreNotOneMoreByRounding) {
  for (int n = 1; n <= 1000; ++n) {
    const double step = 0.1 / 3.0;
    double sum = 0.0;
    for (int i = 0; i < n; ++i) sum += step;
    EXPECT_EQ(equal_steps(1.0, sum, {.fixed_step = step}), n);
  }
}

TEST(EqualSteps, GoByTheFourthRootOfTheTolerance) {
  EXPECT_EQ(equal_steps(period, period, {.tolerance = 1e-10}), 1000.0);
  EXPECT_EQ(equal_steps(period, period, {.tolerance = 1e-6}), 100.0);
  EXPECT_EQ(equal_steps(period, period, {.tolerance = 1e-14}), 10000.0);
  EXPECT_EQ(equal_steps(period, 0.25 * period, {.tolerance = 1e-10}), 250.0);
  EXPECT_EQ(equal_steps(period, 0.0101 * period, {.tolerance = 1e-6}), 2.0);  // 1.01
}

// However little is left, it takes a step.
TEST(EqualSteps, AreOneAtLeast) {
  EXPECT_EQ(equal_steps(period, 1e-15 * period, {}), 1.0);
  EXPECT_EQ(equal_steps(period, 0.0, {.fixed_step = 1.0}), 1.0);
}

}  // namespace whirl::equal_steps_test
