#include "libdyn/system/clock.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace whirl::clock_test {

constexpr double turn = 2.0 * std::numbers::pi, rounding = 1e-15;

// The phase goes forward in whatever sense the rotor turns.
TEST(Clock, TurnsOnceInAPeriodInEitherSense) {
  for (const double Omega : {314.0, -314.0}) {
    const Clock clock(Omega);
    EXPECT_EQ(clock.speed(), Omega);
    EXPECT_EQ(clock.rate(), 314.0);
    EXPECT_NEAR(clock.turn(clock.period()), turn, rounding * turn);
    EXPECT_NEAR(clock.time_after(2.5), 2.5 * turn / 314.0, rounding);
  }
}

// A rotor that stands has revolutions of one second, so that its motions have a section.
TEST(Clock, TakesASecondForARevolutionOfARotorThatStands) {
  const Clock clock;
  EXPECT_EQ(clock.speed(), 0.0);
  EXPECT_EQ(clock.period(), 1.0);
  EXPECT_EQ(clock.time_after(3.0), 3.0);
}

}  // namespace whirl::clock_test
