// Whether sections have settled, on sequences whose drift is known.

#include "libdyn/studies/settling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace whirl::settling_test {

constexpr double golden = 2.0 * std::numbers::pi * std::numbers::phi;  ///< turn between sections
constexpr double told = 0.02;  ///< change of averages from which on a motion counts as not settled

/// Sections of two frequencies whose circle is  radius(k).
template <class Radius>
Mat whirling(int count, const Radius& radius) {
  Mat points(2, count);
  for (int k = 0; k < count; ++k) {
    points.col(k) << radius(k) * std::cos(golden * k), radius(k) * std::sin(golden * k);
  }
  return points;
}

// Smooth averages along a circle agree to many digits, those of equal weights only to 1 / 100.
TEST(Drift, OfATorusIsNone) {
  constexpr double digits = 1e-6;
  EXPECT_LT(drift_of(whirling(200, [](int) { return 0.3; })).change, digits);
}

// r = e^(-d k): the decay that is measured is d, and what is left at the end is the radius there.
TEST(Drift, OfADecayingMotionIsItsDecay) {
  constexpr double of_the_rate = 0.05;  // smooth averages of a square root's decay
  for (const double decay : {0.002, 0.01, 0.03}) {
    const Drift drift = drift_of(whirling(400, [&](int k) { return std::exp(-decay * k); }));
    EXPECT_GT(drift.change, told) << decay;
    EXPECT_NEAR(drift.rate, decay, of_the_rate * decay);
    const double radius = std::exp(-decay * 400);
    EXPECT_LT(std::abs(std::log(drift.left * drift.spread / radius)), std::log(2.0)) << decay;
  }
}

// r = 1 + 0.3 e^(-d k): it settles on a circle, at the rate d.
TEST(Drift, TowardsATorusIsItsDecay) {
  constexpr double of_the_rate = 0.15;  // mean squares do not decay by one rate
  constexpr double decay = 0.005;
  const Drift drift =
      drift_of(whirling(400, [](int k) { return 1.0 + 0.3 * std::exp(-decay * k); }));
  EXPECT_GT(drift.change, told);
  EXPECT_NEAR(drift.rate, decay, of_the_rate * decay);
  const Drift later =
      drift_of(whirling(400, [](int k) { return 1.0 + 0.3 * std::exp(-decay * (k + 1000)); }));
  EXPECT_LT(later.change, told);
}

// Arnold's cat map is chaotic: means of 200 points differ by chance, one over the root of 200.
TEST(Drift, OfChaosIsChance) {
  Mat points(2, 400);
  double a = 0.1234, b = 0.4321;
  for (int i = 0; i < 400; ++i) {
    const double sum = a + b;
    a = std::fmod(a + sum, 1.0);
    b = std::fmod(sum, 1.0);
    points.col(i) << a, b;
  }
  const Drift drift = drift_of(points);
  EXPECT_GT(drift.change, told);
  EXPECT_LT(drift.change, 0.5);
}

TEST(Drift, OfSectionsThatRepeatIsNone) {
  EXPECT_EQ(drift_of(Mat::Zero(3, 100)).change, 0.0);
  EXPECT_EQ(drift_of(Mat::Random(3, 4)).change, 0.0);  // too few to tell
}

}  // namespace whirl::settling_test
