// Fourier series of periodic motions: what is put in comes out, and slopes are slopes.

#include "libbase/numerics/fourier.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "libbase/numerics/constants.hpp"

namespace whirl::fourier_test {

constexpr double rounding = 1e-13;

/// Two rows of a series with as many harmonics.
Mat series(int harmonics) {
  Mat c(2, 2 * harmonics + 1);
  for (Eigen::Index k = 0; k < c.cols(); ++k) {
    c(0, k) = 1.0 / (1.0 + static_cast<double>(k));
    c(1, k) = k % 2 == 0 ? -0.5 : 0.25;
  }
  return c;
}

TEST(Fourier, CoefficientsOfAFiniteSeriesComeBack) {
  const int harmonics = 20, angles = 64;
  const Mat c = series(harmonics);
  Mat values(2, angles);
  for (int i = 0; i < angles; ++i) {
    values.col(i) = c * harmonic_functions(turn * i / angles, harmonics);
  }
  EXPECT_TRUE(fourier_coefficients(values, harmonics).isApprox(c, rounding));
}

// (cos k theta)' = -k sin k theta
TEST(Fourier, TheDerivativeOfACosineIsASine) {
  Mat c = Mat::Zero(1, 7);
  c(0, 3) = 1.0;  // cos 2 theta
  Mat expected = Mat::Zero(1, 7);
  expected(0, 4) = -2.0;
  EXPECT_EQ(differentiated(c), expected);
  const double theta = 0.7;
  EXPECT_NEAR(harmonic_slopes(theta, 3)(3), -2.0 * std::sin(2.0 * theta), rounding);
  EXPECT_NEAR(harmonic_slopes(theta, 3)(6), 3.0 * std::cos(3.0 * theta), rounding);
}

TEST(Fourier, FunctionsOfManyHarmonicsDoNotDrift) {
  const double theta = 1.2345;
  const Vec phi = harmonic_functions(theta, 1000);
  EXPECT_NEAR(phi(1999), std::cos(1000.0 * theta), 1e-11);
  EXPECT_NEAR(phi(2000), std::sin(1000.0 * theta), 1e-11);
}

// The rate of a motion is its change in time: a central difference has the error h^2 / 6 x'''.
TEST(Fourier, RatesAreSlopesInTime) {
  const Periodic motion{.coefficients = series(5), .period = 3, .rate = 40.0};
  const double theta = 0.4, h = 1e-5, dt = h / motion.frequency();
  const Vec difference = (motion.at(theta + h).x - motion.at(theta - h).x) / (2.0 * dt);
  EXPECT_LT((difference - motion.at(theta).rate).norm(), 1e-7 * difference.norm());
  EXPECT_EQ(motion.phase(theta), 3.0 * theta);
}

TEST(Fourier, OtherHarmonicsAreCutOffOrZero) {
  const Mat c = series(3);
  EXPECT_EQ(with_harmonics(c, 1), c.leftCols(3));
  EXPECT_EQ(with_harmonics(c, 5).leftCols(7), c);
  EXPECT_TRUE(with_harmonics(c, 5).rightCols(4).isZero(0.0));
}

}  // namespace whirl::fourier_test
