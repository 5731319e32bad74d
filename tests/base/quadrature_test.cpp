// Gauss-Legendre points on [0, 1] and the matrix of running integrals.

#include "libbase/numerics/quadrature.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace whirl::quadrature_test {

constexpr double rounding = 1e-14;  // sums of at most 24 terms below one

class EveryNumberOfPoints : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Gauss, EveryNumberOfPoints, testing::Values(1, 2, 3, 5, 8, 16, 24));

// integral_0^1 x^k dx = 1 / (k + 1) for k <= 2 n - 1
TEST_P(EveryNumberOfPoints, IntegratesPowersUpToTwiceTheirNumberLessOne) {
  const int n = GetParam();
  const Quadrature q = Quadrature::gauss(n);
  for (int k = 0; k < 2 * n; ++k) {
    EXPECT_NEAR(q.w.dot(Vec(q.x.array().pow(k))), 1.0 / (k + 1), rounding) << "power " << k;
  }
}

// integral_0^{x_i} x^k dx = x_i^(k+1) / (k + 1) for k <= n - 1
TEST_P(EveryNumberOfPoints, RunningIntegralsOfPowersAreExact) {
  const int n = GetParam();
  const Quadrature q = Quadrature::gauss(n);
  for (int k = 0; k < n; ++k) {
    const Vec running = q.S * Vec(q.x.array().pow(k));
    const Vec exact = q.x.array().pow(k + 1) / (k + 1.0);
    EXPECT_LT((running - exact).cwiseAbs().maxCoeff(), rounding) << "power " << k;
  }
}

TEST_P(EveryNumberOfPoints, PointsAscendWithinTheIntervalAndMirrorEachOther) {
  const int n = GetParam();
  const Quadrature q = Quadrature::gauss(n);
  EXPECT_GT(q.x(0), 0.0);
  EXPECT_GT(q.w.minCoeff(), 0.0);
  for (int i = 0; i + 1 < n; ++i) EXPECT_LT(q.x(i), q.x(i + 1));
  EXPECT_LT((q.x + q.x.reverse() - Vec::Ones(n)).cwiseAbs().maxCoeff(), rounding);
  EXPECT_LT((q.w - q.w.reverse()).cwiseAbs().maxCoeff(), rounding);
}

// First power that is not exact: 1 / (2n+1) - w . x^(2n) = (n!)^4 / ((2n+1) ((2n)!)^2),
// the error term of [AbramowitzStegun1964], 25.4.30, on an interval of length one.
TEST(Gauss, ErrorOfTheFirstPowerThatIsNotExactIsTheErrorTerm) {
  for (int n = 1; n <= 6; ++n) {
    const Quadrature q = Quadrature::gauss(n);
    const double central = std::tgamma(n + 1.0) * std::tgamma(n + 1.0) / std::tgamma(2 * n + 1.0);
    const double error = central * central / (2 * n + 1);
    EXPECT_NEAR(1.0 / (2 * n + 1) - q.w.dot(Vec(q.x.array().pow(2 * n))), error, rounding);
  }
}

// [AbramowitzStegun1964], table 25.4: +-0.57735 02691 89626; 0, +-0.77459 66692 41483 with
// weights 0.88888 88888 88889, 0.55555 55555 55556, all on [-1, 1]
TEST(Gauss, PointsOfTwoAndThreeAreThoseOfTheTables) {
  constexpr double printed = 1e-15;  // half of the last digit, on half the interval
  const Quadrature two = Quadrature::gauss(2), three = Quadrature::gauss(3);
  EXPECT_NEAR(two.x(0), 0.5 * (1.0 - 0.577350269189626), printed);
  EXPECT_NEAR(three.x(0), 0.5 * (1.0 - 0.774596669241483), printed);
  EXPECT_NEAR(three.w(0), 0.5 * 0.555555555555556, printed);
  EXPECT_NEAR(three.w(1), 0.5 * 0.888888888888889, printed);
}

}  // namespace whirl::quadrature_test
