// Rules of the lateral analysis of compressors, beside numbers by hand.

#include "libfe/lateral/lateral_rules.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/rotors.hpp"

namespace whirl::lateral_rules_test {

using test::rpm;

constexpr double rounding = 1e-12;  // relative

/// A peak of some amplification at a speed [rpm].
ResponsePeak peak(double speed, double AF) {
  return {.speed = speed * rpm,
          .below = speed * rpm * (1.0 - 0.5 / AF),
          .above = speed * rpm * (1.0 + 0.5 / AF)};
}

// 25.4 um up to 12 000 rpm, and no more at 3000, where the root alone would allow 50.8; half at 48
// 000; 6350 * 100 kg / 10 000 rpm = 63.5 g.mm, twice.
TEST(LateralRules, AllowVibrationAndUnbalanceByTheSpeed) {
  EXPECT_NEAR(vibration_limit(12000.0 * rpm), 25.4e-6, rounding * 25.4e-6);
  EXPECT_EQ(vibration_limit(3000.0 * rpm), 25.4e-6);
  EXPECT_NEAR(vibration_limit(48000.0 * rpm), 12.7e-6, rounding * 12.7e-6);
  EXPECT_NEAR(analysis_unbalance(100.0, 10000.0 * rpm), 127e-6, rounding * 127e-6);
}

// AF = 4: 17 (1 - 1 / 2.5) = 10.2 % below, of 5000 rpm; 20.2 % above, of 6000 rpm.
TEST(LateralRules, AskForMarginsFromTheNearestOperatingSpeed) {
  const OperatingRange range{5000.0 * rpm, 6000.0 * rpm, 6300.0 * rpm};
  const SeparationMargin below = separation_margin(peak(4000.0, 4.0), range);
  EXPECT_TRUE(below.is_below);
  EXPECT_NEAR(below.actual, 0.2, rounding);
  EXPECT_NEAR(below.required, 0.102, rounding);
  const SeparationMargin above = separation_margin(peak(7200.0, 4.0), range);
  EXPECT_FALSE(above.is_below);
  EXPECT_NEAR(above.actual, 0.2, rounding);
  EXPECT_NEAR(above.required, 0.202, rounding);
  EXPECT_FALSE(above.is_kept());
}

// Sharp peaks ask for 16 and 26 % at most, broad ones for nothing.
TEST(LateralRules, AskForNoMoreOfSharpPeaksAndForNothingOfBroadOnes) {
  const OperatingRange range{5000.0 * rpm, 6000.0 * rpm, 6300.0 * rpm};
  EXPECT_EQ(separation_margin(peak(4000.0, 100.0), range).required, 0.16);
  EXPECT_EQ(separation_margin(peak(7000.0, 100.0), range).required, 0.26);
  EXPECT_EQ(separation_margin(peak(4999.0, 2.4), range).required, 0.0);
  EXPECT_TRUE(separation_margin(peak(5500.0, 2.4), range).is_kept());
}

TEST(LateralRules, ForbidSharpPeaksAmongOperatingSpeeds) {
  const OperatingRange range{5000.0 * rpm, 6000.0 * rpm, 6300.0 * rpm};
  for (const double speed : {5000.0, 5500.0, 6000.0}) {
    const SeparationMargin margin = separation_margin(peak(speed, 8.0), range);
    EXPECT_EQ(margin.actual, 0.0) << speed;
    EXPECT_GT(margin.required, 0.1) << speed;
    EXPECT_FALSE(margin.is_kept()) << speed;
  }
}

// 2.5 in light gas, 2.69 - 0.0115 * 34.05 = 2.298425, 2.0 at 60 kg/m^3; denser gas is always in
// region B.
TEST(LateralRules, ScreenASpeedRatioByTheDensityOfTheGas) {
  EXPECT_EQ(largest_speed_ratio(1.2), 2.5);
  EXPECT_EQ(largest_speed_ratio(16.5), 2.5);
  EXPECT_LT(largest_speed_ratio(16.6), 2.5);
  EXPECT_NEAR(largest_speed_ratio(34.05), 2.298425, rounding);
  EXPECT_NEAR(largest_speed_ratio(60.0), 2.0, rounding);
  EXPECT_EQ(stability_region(2.29, 34.05), StabilityRegion::a);
  EXPECT_EQ(stability_region(2.30, 34.05), StabilityRegion::b);
  EXPECT_EQ(stability_region(2.6, 1.2), StabilityRegion::b);
  EXPECT_EQ(stability_region(0.5, 60.1), StabilityRegion::b);
}

// 1 MW at 10 000 rpm are 954.930 N.m; 3 * 954.930 / (0.4 * 0.01) * 1.2 = 859 436.7 N/m.
TEST(LateralRules, ExpectOfAnImpellerTheCrossCouplingOfItsTorque) {
  const Stage stage{.power = 1e6, .diameter = 0.4, .width = 0.01, .density_ratio = 1.2};
  EXPECT_NEAR(anticipated_coupling(stage, 10000.0 * rpm), 859436.7, 0.1);
}

}  // namespace whirl::lateral_rules_test
