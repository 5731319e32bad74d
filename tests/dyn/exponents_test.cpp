// Exponents from the growth of tangents, where their limits are known.

#include "libdyn/studies/exponents.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "libdyn/studies/classify.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::exponents_test {

// What tangents grow by while they turn to their directions is no part of the mean: e^6 at first,
// then e^0.2 and e^-0.1 a revolution, the first of them in the second column.
TEST(Exponents, LeaveOutWhatTangentsAlignBy) {
  constexpr int T = 200;
  Mat growths(2, T);
  for (int k = 0; k < T; ++k) growths.col(k) << -0.1 * (k + 1) - 6.0, 0.2 * (k + 1) + 6.0;
  const ExponentEstimate e = estimate_exponents(growths);
  EXPECT_NEAR(e.exponents(0), 0.2, 1e-12);
  EXPECT_NEAR(e.exponents(1), -0.1, 1e-12);
  EXPECT_EQ(e.zero, (1.0 + std::log(200.0)) / 200.0);
  EXPECT_NEAR(e.resolution, 2.0 * e.zero, 1e-12);  // nothing is left to chance
}

// The path ends in the estimate of all revolutions, and each of its points is that of the first
// ones.
TEST(Exponents, PathIsOfTheFirstRevolutions) {
  constexpr int T = 100;
  Mat growths(2, T);
  for (int k = 0; k < T; ++k) growths.col(k) << 0.1 * (k + 1) + std::sin(k), -0.3 * (k + 1);
  const ExponentPath path = exponent_path(growths, 20);
  ASSERT_EQ(path.revolutions.size(), 20u);
  EXPECT_EQ(path.revolutions.front(), 5.0);
  EXPECT_EQ(path.revolutions.back(), 100.0);
  EXPECT_EQ(Vec(path.exponents.col(19)), estimate_exponents(growths).exponents);
  EXPECT_EQ(Vec(path.exponents.col(9)), estimate_exponents(growths.leftCols(50)).exponents);
  EXPECT_EQ(exponent_path(growths, 1000).revolutions.size(), 100u);
}

// Growth by chance, independent from revolution to revolution: the mean of n has the error
// s / sqrt(n), which the batches show within their own, a sixth. Of 1000 means 99 % lie within.
TEST(Exponents, KnowWhatChanceLeavesOfThem) {
  constexpr int T = 160;
  std::mt19937 random(1);
  std::normal_distribution<double> chance(0.3, 2.0);
  int within = 0;
  for (int motion = 0; motion < 1000; ++motion) {
    Mat growths(1, T);
    double sum = 0.0;
    for (int k = 0; k < T; ++k) growths(0, k) = sum += chance(random);
    const ExponentEstimate e = estimate_exponents(growths);
    within += std::abs(e.exponents(0) - 0.3) <= e.resolution;
    EXPECT_LT(e.resolution, 2.0 * e.zero + 2.0 * 3.5 * 2.0 / std::sqrt(120.0));
  }
  EXPECT_GE(within, 990);
}

// At 160 rad/s and 130 MN/m the rotor moves on a torus, whose largest exponent is zero. All growth
// in 100 revolutions over their number is 0.06, above what counts as zero: most of it is what
// tangents align by.
TEST(Exponents, OfATorusAreZeroAfterAHundredRevolutions) {
  const test::RotorStator p{.Omega = 160.0, .kC = 130e6};
  const Scene scene = p.scene();
  const Classification c = classify(scene.contacts, test::start_of(p.model(), scene),
                                    {.revolutions = 100, .exponents = 100});
  EXPECT_EQ(c.kind, MotionKind::quasi_periodic);
  EXPECT_LT(std::abs(c.exponents(0)), c.zero);
  EXPECT_LT(std::abs(c.exponents(0)), c.resolution);
}

}  // namespace whirl::exponents_test
