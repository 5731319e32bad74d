// Legendre's polynomials on [0, 1] against their closed forms.

#include "libbase/numerics/legendre.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace whirl::legendre_test {

constexpr double rounding = 1e-13;

// P_3(2 s - 1) = 20 s^3 - 30 s^2 + 12 s - 1
TEST(Legendre, ValuesAndPowersAreTheClosedForms) {
  const double s = 0.3;
  const Vec p = legendre(s, 4);
  EXPECT_NEAR(p(2), 6.0 * s * s - 6.0 * s + 1.0, rounding);
  EXPECT_NEAR(p(3), ((20.0 * s - 30.0) * s + 12.0) * s - 1.0, rounding);
  EXPECT_EQ(Vec(legendre_to_powers(4).col(3)), Vec(Eigen::Vector4d(-1.0, 12.0, -30.0, 20.0)));
}

// n points are exact to degree 2 n - 1, and not beyond.
TEST(Legendre, GaussRulesAreExactToTheirDegree) {
  for (const int n : {1, 2, 5, 12}) {
    const GaussRule rule = gauss_rule(n);
    const auto error = [&](int degree) {
      return std::abs(rule.w.dot(rule.s.array().pow(degree).matrix()) - 1.0 / (degree + 1));
    };
    for (int degree = 0; degree <= 2 * n - 1; ++degree) EXPECT_LT(error(degree), rounding) << n;
    if (n > 5) continue;  // later ones miss by less than rounding
    EXPECT_GT(error(2 * n), 1e3 * rounding) << n;
  }
}

TEST(Legendre, CoefficientsFollowFromValuesAtNodes) {
  const Vec nodes = chebyshev_points(6);
  EXPECT_EQ(nodes(0), 0.0);
  EXPECT_EQ(nodes(5), 1.0);
  Vec values(6), coefficients(6);
  coefficients << 0.3, -1.0, 2.0, 0.0, 0.5, -0.25;
  for (int i = 0; i < 6; ++i) values(i) = coefficients.dot(legendre(nodes(i), 6));
  EXPECT_LT((values_to_legendre(nodes) * values - coefficients).norm(), rounding);
}

TEST(Legendre, ARestrictionIsTheSamePolynomialOnAPart) {
  const double from = 0.25, to = 0.6;
  Vec whole(5);
  whole << 1.0, -0.5, 0.25, 2.0, -1.0;
  const Vec part = restriction(from, to, gauss_rule(5)) * whole;
  for (const double s : {0.0, 0.4, 1.0}) {
    EXPECT_NEAR(part.dot(legendre(s, 5)), whole.dot(legendre(from + (to - from) * s, 5)), rounding);
  }
}

}  // namespace whirl::legendre_test
