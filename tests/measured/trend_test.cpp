// Trends and zones of machines in operation, against closed forms and the printed boundaries.

#include "libdata/measured/trend.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "libbase/error.hpp"
#include "libdata/measured/zones.hpp"

namespace whirl::trend_test {

constexpr double pi = std::numbers::pi;
constexpr double rpm = pi / 30.0;

/// Readings of one probe at 3000 rpm for 20 s: 1X of an amplitude and 2X of a fifth of it, and a
/// gap that moves evenly.
ProbeReadings steady(double amplitude, double gap_rate, const std::string& name = "x") {
  constexpr double rate = 3200.0, turns = 50.0;
  ProbeReadings r{.rate = rate};
  Probe probe;
  probe.name = name;
  r.probes = {probe};
  r.displacement.resize(64000, 1);
  for (Eigen::Index j = 0; j < r.displacement.rows(); ++j) {
    const double t = static_cast<double>(j) / rate, angle = 2.0 * pi * turns * t;
    r.displacement(j, 0) = amplitude * std::cos(angle + 0.5) +
                           0.2 * amplitude * std::cos(2.0 * angle) + 1e-3 + gap_rate * t;
  }
  std::vector<double> pulses;
  for (int k = 0; k < 1000; ++k) pulses.push_back(k / turns);
  r.clock.emplace(pulses, KeyPhasor{}, r.notes);
  return r;
}

TEST(Trend, FollowsOverallFirstOrderGapAndVelocity) {
  const Trend trend = trend_of(steady(30e-6, 2e-6), {});
  ASSERT_GT(trend.number.size(), 100u);
  ASSERT_EQ(trend.probes.size(), 1u);
  const TrendCurve& c = trend.probes[0];
  double low = 1.0, high = -1.0;  // of a period
  for (double a = 0.0; a < 2.0 * pi; a += 1e-3) {
    const double reading = std::cos(a + 0.5) + 0.2 * std::cos(2.0 * a);
    low = std::min(low, reading), high = std::max(high, reading);
  }
  for (Eigen::Index k = 0; k < trend.speed.size(); ++k) {
    EXPECT_NEAR(trend.speed(k), 3000.0 * rpm, 1e-6);
    EXPECT_NEAR(std::abs(c.first(k) - std::polar(30e-6, 0.5)), 0.0, 0.02e-6);
    EXPECT_NEAR(c.gap(k), 1e-3 + 2e-6 * trend.time(k), 0.01e-6);
    // samples every 5.6 degrees, and what the gap moves by in eight revolutions
    EXPECT_NEAR(c.overall(k), 30e-6 * (high - low), 0.4e-6);
    const double velocity = 30e-6 * 100.0 * pi * std::sqrt((1.0 + 0.4 * 0.4) / 2.0);
    // the window widens a line by a bin of an eighth of 1X: (1/8)^2 / 6 of 1X, less of 2X
    EXPECT_NEAR(c.velocity(k), velocity, 3e-3 * velocity);
  }
  ProbeReadings without = steady(30e-6, 0.0);
  without.clock.reset();
  EXPECT_NEAR(std::abs(trend_of(without, {.speed = 3000.0 * rpm}).probes[0].first(0)), 30e-6, 1e-8);
  EXPECT_THROW(trend_of(without, {}), OptionError);
}

TEST(Trend, HasAPointForEachRecord) {
  const std::vector<Trend> records{trend_of(steady(20e-6, 0.0), {}),
                                   trend_of(steady(25e-6, 0.0), {})};
  const Trend trend = trend_of_records(records, {"monday.csv", "tuesday.csv"});
  ASSERT_EQ(trend.number.size(), 2u);
  EXPECT_TRUE(std::isnan(trend.time(0)));
  EXPECT_NEAR(std::abs(trend.probes[0].first(1)), 25e-6, 1e-9);
  EXPECT_THROW(trend_of_records({records[0], trend_of(steady(1e-6, 0.0, "y"), {})}, {"a", "b"}),
               OptionError);
}

// ISO 7919-3: 4800, 9000 and 13200 um over the root of the speed in rpm, 60 at 3600 rpm.
TEST(Zones, HaveTheBoundariesOfTheStandard) {
  const ZoneLimits shaft = zone_limits(ZoneClass::shaft, 3600.0 * rpm);
  EXPECT_NEAR(shaft.ab, 80e-6, 1e-12);
  EXPECT_NEAR(shaft.bc, 150e-6, 1e-12);
  EXPECT_NEAR(shaft.cd, 220e-6, 1e-12);
  const ZoneLimits housing = zone_limits(ZoneClass::housing_1_flexible, 1.0);
  EXPECT_DOUBLE_EQ(housing.ab, 3.5e-3);
  EXPECT_DOUBLE_EQ(housing.bc, 7.1e-3);
  EXPECT_DOUBLE_EQ(housing.cd, 11.0e-3);
  EXPECT_DOUBLE_EQ(zone_limits(ZoneClass::housing_2_rigid, 1.0).cd, 4.5e-3);
  EXPECT_DOUBLE_EQ(zone_limits(ZoneClass::housing_2_flexible, 1.0).ab, 2.3e-3);
  EXPECT_DOUBLE_EQ(zone_limits(ZoneClass::housing_1_rigid, 1.0).cd, 7.1e-3);
  EXPECT_EQ(zone_of(79.9e-6, shaft), "A");
  EXPECT_EQ(zone_of(100e-6, shaft), "B");
  EXPECT_EQ(zone_of(200e-6, shaft), "C");
  EXPECT_EQ(zone_of(221e-6, shaft), "D");
}

// At 3000 rpm A ends at 87.6 um, B at 164.3 um.
TEST(Zones, JudgeEachProbe) {
  EXPECT_EQ(zones_of(trend_of(steady(35e-6, 0.0), {}), ZoneClass::shaft).zone, "A");
  const ZoneReport report = zones_of(trend_of(steady(60e-6, 0.0), {}), ZoneClass::shaft);
  EXPECT_EQ(report.of, "shaft");
  EXPECT_EQ(report.zone, "B");
  ASSERT_EQ(report.probes.size(), 1u);
  EXPECT_NEAR(report.probes[0].limits.ab, 4800e-6 / std::sqrt(3000.0), 1e-10);
  // 60 um at 50 Hz and a fifth at 100 Hz: 14.4 mm/s
  const ZoneReport housing =
      zones_of(trend_of(steady(60e-6, 0.0), {}), ZoneClass::housing_1_flexible);
  EXPECT_EQ(housing.zone, "D");
  EXPECT_NEAR(housing.probes[0].value, 14.36e-3, 3e-3 * 14.36e-3);
}

}  // namespace whirl::trend_test
