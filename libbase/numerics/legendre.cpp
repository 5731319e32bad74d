#include "libbase/numerics/legendre.hpp"

#include <cmath>
#include <numbers>

#include "libbase/numerics/dense.hpp"

namespace whirl::inline base {

Vec legendre_at(double x, int terms) {
  Vec p(terms);
  for (int k = 0; k < terms; ++k) {
    p(k) = k == 0 ? 1.0 : k == 1 ? x : ((2 * k - 1) * x * p(k - 1) - (k - 1) * p(k - 2)) / k;
  }
  return p;
}

Vec legendre(double s, int terms) {
  return legendre_at(2.0 * s - 1.0, terms);
}

Mat restriction(double from, double to, const GaussRule& rule) {
  const auto terms = static_cast<int>(rule.s.size());
  Mat r = Mat::Zero(terms, terms);
  for (int i = 0; i < terms; ++i) {
    const Vec whole = legendre(from + (to - from) * rule.s(i), terms);
    const Vec part = legendre(rule.s(i), terms);
    for (int j = 0; j < terms; ++j) {
      r.row(j) += rule.w(i) * (2 * j + 1) * part(j) * whole.transpose();
    }
  }
  return r.triangularView<Eigen::Upper>();  // the degree does not grow
}

Mat legendre_to_powers(int terms) {
  Mat m = Mat::Zero(terms, terms);
  for (int j = 0; j < terms; ++j) {
    // P_j(2 s - 1) = sum_k (-1)^(j+k) C(j, k) C(j + k, k) s^k
    double c = j % 2 == 0 ? 1.0 : -1.0;
    for (int k = 0; k <= j; ++k) {
      m(k, j) = c;
      c *= -static_cast<double>((j - k) * (j + k + 1)) / ((k + 1) * (k + 1));
    }
  }
  return m;
}

Mat values_to_legendre(const Vec& nodes) {
  const auto n = static_cast<int>(nodes.size());
  Mat values(n, n);
  for (int i = 0; i < n; ++i) values.row(i) = legendre(nodes(i), n).transpose();
  return DenseLu<Mat>(values).solve(Mat::Identity(n, n));
}

Vec chebyshev_points(int points) {
  Vec s(points);
  for (int i = 0; i < points; ++i) {
    s(i) = 0.5 * (1.0 - std::cos(std::numbers::pi * i / (points - 1)));
  }
  return s;
}

}  // namespace whirl::inline base
