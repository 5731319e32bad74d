#include "libfe/eigen/energy_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "libbase/numerics/dense.hpp"
#include "libfe/eigen/positive_factor.hpp"
#include "libfe/eigen/symmetric.hpp"

namespace whirl::inline fe {

namespace {

constexpr int steps = 30;            ///< of Lanczos' method: ends of a spectrum come first
constexpr double used_up = 1e-12;    ///< of its length: what is left of a vector inside the basis
constexpr double margin = 0.02;      ///< added to a bound, of the larger of both
constexpr double negligible = 1e-9;  ///< of the most damping: less is none
constexpr double rounding_of_sums = 1e-13;  ///< of the largest entry of a sum

struct Interval {
  double low = 0.0, high = 0.0;
};

/// Where eigenvalues of an operator are that is symmetric in the inner product of K.
Interval spectrum(const std::function<Vec(const Vec&)>& op, const Sparse& K) {
  const auto n = K.rows();
  const auto most = std::min<Eigen::Index>(steps, n);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  Vec v(n);
  for (double& x : v) x = normal(random);
  v /= std::sqrt(v.dot(K * v));
  Mat basis(n, most), images(n, most);
  Eigen::Index size = 0;
  double left = 0.0;
  while (size < most) {
    basis.col(size) = v;
    Vec w = op(v);
    images.col(size++) = w;
    const double before = std::sqrt(std::max(w.dot(K * w), 0.0));
    for (int twice = 0; twice < 2; ++twice) {
      const Vec Kw = K * w;
      w -= basis.leftCols(size) * (basis.leftCols(size).transpose() * Kw);
    }
    left = std::sqrt(std::max(w.dot(K * w), 0.0));
    if (!(left > used_up * before)) {
      left = 0.0;
      break;
    }
    v = w / left;
  }
  const Mat T = basis.leftCols(size).transpose() * (K * images.leftCols(size));
  const SymmetricModes<Mat> ritz = symmetric_modes(Mat(0.5 * (T + T.transpose())));
  const auto residual = [&](Eigen::Index i) { return left * std::abs(ritz.vectors(size - 1, i)); };
  return {ritz.values(0) - residual(0), ritz.values(size - 1) + residual(size - 1)};
}

/// (A - A^T) / 2, without what is rounding.
Sparse skew_part(const Sparse& A) {
  Sparse S = 0.5 * (A - Sparse(A.transpose()));
  const double largest = A.nonZeros() == 0 ? 0.0 : A.coeffs().abs().maxCoeff();
  S.prune([&](Eigen::Index, Eigen::Index, double x) {
    return std::abs(x) > rounding_of_sums * largest;
  });
  return S;
}

}  // namespace

EnergyBounds energy_bounds(const Sparse& D, const Sparse& K) {
  const Sparse elastic = symmetric_part(K), damping = symmetric_part(D), skew = skew_part(K);
  const auto positive = positive_factor(elastic);
  if (!positive) return {};
  const Ldlt& factor = *positive;
  EnergyBounds bounds{.are_known = true};
  if (damping.nonZeros() > 0) {
    const Interval found =
        spectrum([&](const Vec& v) { return Vec(factor.solve(damping * v)); }, elastic);
    const double safety = margin * std::max(std::abs(found.low), std::abs(found.high));
    bounds.most_damping = found.high + safety;
    // pivots tell damping that nowhere feeds energy from one that Lanczos has not resolved
    const bool dissipates =
        found.high > 0.0 && is_supported(Sparse(damping + negligible * found.high * elastic));
    bounds.least_damping = dissipates ? std::max(found.low, 0.0) : found.low - safety;
  }
  if (skew.nonZeros() > 0) {
    const Interval squares = spectrum(
        [&](const Vec& v) { return Vec(-factor.solve(skew * Vec(factor.solve(skew * v)))); },
        elastic);
    bounds.skew = (1.0 + margin) * std::sqrt(std::max(squares.high, 0.0));
  }
  return bounds;
}

}  // namespace whirl::inline fe
