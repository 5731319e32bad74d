// Peaks of a response: amplification factors in closed form, and the margins they ask for.

#include "libfe/analyses/amplification.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace whirl::amplification_test {

std::vector<double> speeds_to(double last, double step) {
  std::vector<double> speeds;
  for (int i = 0; i * step <= last; ++i) speeds.push_back(i * step);
  return speeds;
}

// Response of a Jeffcott rotor to unbalance, w = speed over natural frequency:
//   r = e w^2 / ((1 - w^2)^2 + (2 zeta w)^2)^(1/2), highest at w = (1 - 2 zeta^2)^(-1/2) with
//   e / (2 zeta (1 - zeta^2)^(1/2)); half the power at
//   1 / w^2 = 1 - 2 zeta^2 +- 2 zeta (1 - zeta^2)^(1/2)
double jeffcott(double w, double zeta, double e) {
  return e * w * w / std::hypot(1.0 - w * w, 2.0 * zeta * w);
}

TEST(Amplification, OfAJeffcottRotorIsTheClosedForm) {
  constexpr double omega = 100.0, e = 1e-4;
  for (const double zeta : {0.01, 0.05, 0.1}) {
    const double step = 0.02 * zeta * omega;
    const auto speeds = speeds_to(300.0, step);
    Mat amplitude(1, static_cast<Eigen::Index>(speeds.size()));
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      amplitude(0, static_cast<Eigen::Index>(i)) = jeffcott(speeds[i] / omega, zeta, e);
    }
    const auto peaks = response_peaks(speeds, amplitude);
    ASSERT_EQ(peaks.size(), 1u);
    const double root = std::sqrt(1.0 - zeta * zeta), middle = 1.0 - 2.0 * zeta * zeta;
    const double peak = omega / std::sqrt(middle);
    const double below = omega / std::sqrt(middle + 2.0 * zeta * root);
    const double above = omega / std::sqrt(middle - 2.0 * zeta * root);
    constexpr double samples = 1e-4;  // of step^2 / width^2, between samples
    EXPECT_NEAR(peaks[0].speed, peak, samples * peak);
    EXPECT_NEAR(peaks[0].amplitude, 0.5 * e / (zeta * root), samples * 0.5 * e / zeta);
    EXPECT_NEAR(peaks[0].amplification(), peak / (above - below),
                10.0 * samples * peaks[0].amplification());
    // known for light damping: 1 / (2 zeta), to first order in zeta; the next term is -4 zeta^2
    EXPECT_NEAR(peaks[0].amplification() * 2.0 * zeta, 1.0 - 4.0 * zeta * zeta,
                zeta * zeta + 10.0 * samples);
  }
}

// Two speeds that only rounding tells apart, as of two grids, are one: a response that rises has no
// peak there.
TEST(Amplification, SpeedsThatRoundingTellsApartMakeNoPeaks) {
  std::vector<double> speeds;
  for (const double speed : speeds_to(40.0, 0.5)) {
    speeds.push_back(speed);
    speeds.push_back(std::nextafter(speed, 100.0));
  }
  Mat amplitude(1, static_cast<Eigen::Index>(speeds.size()));
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    amplitude(0, static_cast<Eigen::Index>(i)) = jeffcott(speeds[i - i % 2] / 100.0, 0.02, 1.0);
  }
  EXPECT_TRUE(response_peaks(speeds, amplitude).empty());
}

TEST(Amplification, TwoPeaksBelongToTheResponsesThatAreLargestThere) {
  const auto speeds = speeds_to(400.0, 0.1);
  Mat amplitude(2, static_cast<Eigen::Index>(speeds.size()));
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    amplitude(0, k) = jeffcott(speeds[i] / 100.0, 0.02, 1.0);
    amplitude(1, k) = jeffcott(speeds[i] / 300.0, 0.05, 2.0);
  }
  const auto peaks = response_peaks(speeds, amplitude);
  ASSERT_EQ(peaks.size(), 2u);
  EXPECT_EQ(peaks[0].row, 0);
  EXPECT_EQ(peaks[1].row, 1);
  EXPECT_NEAR(peaks[0].amplification(), 25.0 * (1.0 - 4.0 * 0.02 * 0.02), 0.02);
  EXPECT_NEAR(peaks[1].amplification(), 10.0 * (1.0 - 4.0 * 0.05 * 0.05), 0.02);
  EXPECT_EQ(response_peaks(speeds, amplitude, 1).at(0).row, 0);  // the higher one
  // too few samples to tell
  const auto coarse = speeds_to(400.0, 2.0);
  Mat sampled(1, static_cast<Eigen::Index>(coarse.size()));
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    sampled(0, static_cast<Eigen::Index>(i)) = jeffcott(coarse[i] / 100.0, 0.02, 1.0);
  }
  EXPECT_TRUE(std::isnan(response_peaks(coarse, sampled).at(0).amplification()));
  // speeds that end before the response has fallen do not tell
  const std::vector<double> few(speeds.begin(), speeds.begin() + 1005);
  EXPECT_TRUE(std::isnan(response_peaks(few, amplitude.leftCols(1005)).at(0).amplification()));
}

// A peak of straight sides falls to 0.707 at 0.2929 of its height by its slope. With five samples
// between these speeds its factor counts, with four it does not.
TEST(Amplification, AFactorNeedsFiveSamplesWithinHalfThePower) {
  const auto peak_with = [](double below, double above) {  // samples from the peak to 0.707
    const double fall = 1.0 - std::numbers::sqrt2 / 2.0;
    std::vector<double> speeds;
    Mat amplitude(1, 11);
    for (int k = 0; k <= 10; ++k) {
      speeds.push_back(100.0 + k);
      const double from_peak = k - 5.0;
      const double slope = fall / (from_peak < 0.0 ? below : above);
      amplitude(0, k) = std::max(0.0, 1.0 - slope * std::abs(from_peak));
    }
    return response_peaks(speeds, amplitude).at(0);
  };
  EXPECT_NEAR(peak_with(2.5, 2.5).amplification(), 105.0 / 5.0, 1e-9);
  EXPECT_TRUE(std::isnan(peak_with(1.5, 2.5).amplification()));
}

// The formulas of the standard at AF = 3.5 and 6.5, where 1 / (AF - 1.5) is 1/2 and 1/5, and its
// limits: none below 2.5, 16 % and 26 % at most.
TEST(Amplification, MarginsAreThoseOfTheStandard) {
  const auto margin = [](double AF, double speed) {
    return separation_margin({.speed = speed, .below = 0.0, .above = speed / AF}, 100.0);
  };
  EXPECT_NEAR(margin(3.5, 80.0).required, 0.085, 1e-12);
  EXPECT_NEAR(margin(6.5, 80.0).required, 0.136, 1e-12);
  EXPECT_NEAR(margin(3.5, 130.0).required, 0.185, 1e-12);
  EXPECT_NEAR(margin(6.5, 130.0).required, 0.236, 1e-12);
  EXPECT_EQ(margin(100.0, 80.0).required, 0.16);
  EXPECT_EQ(margin(100.0, 130.0).required, 0.26);
  EXPECT_EQ(margin(2.4, 99.0).required, 0.0);
  // above the running speed the margin jumps at 2.5, from none to 10 %
  EXPECT_EQ(margin(2.499, 130.0).required, 0.0);
  EXPECT_NEAR(margin(2.501, 130.0).required, 0.10 + 0.17 * (1.0 - 1.0 / 1.001), 1e-12);
  EXPECT_TRUE(margin(2.4, 99.0).is_kept());
  EXPECT_NEAR(margin(100.0, 80.0).actual, 0.2, 1e-12);
  EXPECT_TRUE(margin(100.0, 80.0).is_below && margin(100.0, 80.0).is_kept());
  EXPECT_FALSE(margin(100.0, 125.0).is_below || margin(100.0, 125.0).is_kept());
  EXPECT_FALSE(margin(NAN, 80.0).is_kept());
}

}  // namespace whirl::amplification_test
