#include "libbase/numerics/quadrature.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "libbase/numerics/legendre.hpp"

namespace whirl::inline base {

namespace {

/// Points and weights on [-1, 1], and P_0 ... P_n at each point in a row.
struct Rule {
  Vec t, w;
  Mat P;
};
Rule rule_of(int n) {
  Rule rule{Vec(n), Vec(n), Mat(n, n + 1)};
  auto& [t, wt, P] = rule;
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    double slope = 1.0;
    for (int it = 0; it < 100; ++it) {  // Newton on P_n
      const Vec p = legendre_at(x, n + 1);
      slope = n * (x * p(n) - p(n - 1)) / (x * x - 1.0);
      const double step = p(n) / slope;
      x -= step;
      if (std::abs(step) < 1e-16) break;
    }
    t(i) = x;
    P.row(i) = legendre_at(x, n + 1).transpose();
    slope = n * (x * P(i, n) - P(i, n - 1)) / (x * x - 1.0);
    wt(i) = 2.0 / ((1.0 - x * x) * slope * slope);
  }
  return rule;
}

}  // namespace

GaussRule gauss_rule(int points) {
  const Rule rule = rule_of(points);
  return {0.5 * (rule.t.array() + 1.0), 0.5 * rule.w};
}

Quadrature Quadrature::gauss(int n) {
  const auto [t, wt, P] = rule_of(n);
  Mat S(n, n);
  // Lagrange polynomial j = sum_k (k + 1/2) w_j P_k(x_j) P_k, integrated term by term from -1
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      double sum = 0.5 * (t(i) + 1.0);
      for (int k = 1; k < n; ++k) sum += 0.5 * P(j, k) * (P(i, k + 1) - P(i, k - 1));
      S(i, j) = 0.5 * wt(j) * sum;
    }
  }
  return {0.5 * (t.array() + 1.0), 0.5 * wt, std::move(S)};
}

Mat Quadrature::interpolation(const Vec& at) const {
  constexpr double capacity = 4.0;  // keeps the products below near one on [0, 1]
  const auto n = x.size();
  Vec weight(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    double product = 1.0;
    for (Eigen::Index k = 0; k < n; ++k) {
      if (k != j) product *= capacity * (x(j) - x(k));
    }
    weight(j) = 1.0 / product;
  }
  Mat values(at.size(), n);
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    Vec terms = weight.cwiseQuotient((at(i) - x.array()).matrix());
    for (Eigen::Index j = 0; j < n; ++j) {
      if (at(i) != x(j)) continue;
      terms.setZero();
      terms(j) = 1.0;
    }
    values.row(i) = terms.transpose() / terms.sum();
  }
  return values;
}

}  // namespace whirl::inline base
