#include "libbase/numerics/vector_fit.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"
#include "libbase/numerics/dense.hpp"

namespace whirl::inline base {

namespace {

constexpr int most_rounds = 40;
constexpr double settled = 1e-12;       ///< relative change of poles
constexpr double first_damping = 0.01;  ///< of the poles that the search begins with
constexpr double least_weight = 1e-8;   ///< of the constant of the weighting function

/// One real pole, or one of a pair with Im > 0.
using Poles = std::vector<Complex>;

bool is_pair(Complex pole) {
  return pole.imag() != 0.0;
}

int count(const Poles& poles) {
  int n = 0;
  for (const Complex p : poles) n += is_pair(p) ? 2 : 1;
  return n;
}

/// Functions with real coefficients, a column each: 1 / (s - p), of pairs the sum and i times the
/// difference; then so many powers of s.
CMat basis(const CVec& s, const Poles& poles, int powers) {
  CMat phi(s.size(), count(poles) + powers);
  Eigen::Index column = 0;
  for (const Complex p : poles) {
    const CVec left = (s.array() - p).inverse();
    if (!is_pair(p)) {
      phi.col(column++) = left;
      continue;
    }
    const CVec right = (s.array() - std::conj(p)).inverse();
    phi.col(column++) = left + right;
    phi.col(column++) = Complex(0.0, 1.0) * (left - right);
  }
  for (int k = 0; k < powers; ++k) phi.col(column++) = s.array().pow(static_cast<double>(k));
  return phi;
}

Mat stacked(const CMat& A) {
  Mat both(2 * A.rows(), A.cols());
  both << A.real(), A.imag();
  return both;
}

/// Least squares with columns of length one.
Vec solution(Mat A, const Vec& b) {
  const Vec lengths = A.colwise().norm().cwiseMax(1e-300);
  for (Eigen::Index j = 0; j < A.cols(); ++j) A.col(j) /= lengths(j);
  return Vec(A.colPivHouseholderQr().solve(b)).cwiseQuotient(lengths);
}

/// Poles that the search begins with: weakly damped pairs along the band, and one real one.
Poles first_poles(int order, double lowest) {
  Poles poles;
  const int pairs = order / 2;
  for (int k = 0; k < pairs; ++k) {
    const double share = pairs > 1 ? static_cast<double>(k) / (pairs - 1) : 0.5;
    const double at = lowest + share * (1.0 - lowest);
    poles.emplace_back(-first_damping * at, at);
  }
  if (order % 2 == 1) poles.emplace_back(-0.5 * (lowest + 1.0), 0.0);
  return poles;
}

/// Eigenvalues of the poles' block matrix less b c^T: zeros of the weighting function.
Poles zeros(const Poles& poles, const Vec& c, double constant, int& unstable) {
  const int n = count(poles);
  Mat A = Mat::Zero(n, n);
  Vec b(n);
  int at = 0;
  for (const Complex p : poles) {
    if (!is_pair(p)) {
      A(at, at) = p.real();
      b(at++) = 1.0;
      continue;
    }
    A.block<2, 2>(at, at) << p.real(), p.imag(), -p.imag(), p.real();
    b.segment<2>(at) << 2.0, 0.0;
    at += 2;
  }
  Poles found;
  unstable = 0;
  for (const Complex p : eigenvalues(A - b * c.transpose() / constant)) {
    if (p.imag() < 0.0) continue;
    if (p.real() > 0.0) unstable += is_pair(p) ? 2 : 1;
    found.emplace_back(-std::abs(p.real()), p.imag());
  }
  std::ranges::sort(found, {}, [](Complex p) { return std::abs(p); });
  return found;
}

/// One round: from poles to better ones.
/// @param H  a row for each entry, weighted as `weight` is
Poles next_poles(const Poles& poles, const CVec& s, const CMat& H, const Vec& weight, int direct,
                 int& unstable) {
  const int n = count(poles);
  const CMat own = weight.cast<Complex>().asDiagonal() * basis(s, poles, direct);
  const CMat common = basis(s, poles, 1);
  const Eigen::Index left = n + 1;
  Mat A(H.rows() * left + 1, left);
  Vec b = Vec::Zero(A.rows());
  for (Eigen::Index e = 0; e < H.rows(); ++e) {
    CMat both(s.size(), own.cols() + left);
    both << own, -(H.row(e).transpose().asDiagonal() * common);
    const Mat real = stacked(both);
    const Mat R =
        real.householderQr().matrixQR().topRows(real.cols()).triangularView<Eigen::Upper>();
    A.middleRows(e * left, left) = R.bottomRightCorner(left, left);
  }
  // the weighting function is one on the average, and not everywhere
  const double scale = H.norm() / static_cast<double>(s.size());
  A.bottomRows(1) = scale * common.real().colwise().sum();
  b(b.size() - 1) = scale * static_cast<double>(s.size());
  const Vec x = solution(A, b);
  const double constant = std::abs(x(n)) > least_weight ? x(n) : std::copysign(least_weight, x(n));
  return zeros(poles, x.head(n), constant, unstable);
}

double change(const Poles& a, const Poles& b) {
  if (a.size() != b.size()) return 1.0;
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    largest = std::max(largest, std::abs(a[k] - b[k]) / std::max(std::abs(a[k]), 1e-300));
  }
  return largest;
}

}  // namespace

CVec RationalFit::at(Complex s) const {
  CVec H = (direct.col(0) + Mat(direct.col(1)).cast<Complex>() * s).eval();
  H += s * s * direct.col(2).cast<Complex>();
  for (Eigen::Index k = 0; k < poles.size(); ++k) {
    H += residues.col(k) / (s - poles(k));
    if (is_pair(poles(k))) H += residues.col(k).conjugate() / (s - std::conj(poles(k)));
  }
  return H;
}

RationalFit vector_fit(const Vec& omega, const CMat& H, int order, int direct) {
  const Vec sizes = H.colwise().norm();
  if (omega.size() < order + direct || omega.size() == 0 || !H.allFinite() ||
      !(sizes.minCoeff() > 0.0) || !(omega.minCoeff() > 0.0)) {
    throw NumericalError("too few samples for a fit, or samples that are zero or not finite");
  }
  const double top = omega.maxCoeff();
  const CVec s = Complex(0.0, 1.0) * (omega / top).cast<Complex>();
  const Vec weight = sizes.cwiseInverse();
  const CMat weighted = H * weight.cast<Complex>().asDiagonal();
  RationalFit fit;
  Poles poles = first_poles(order, omega.minCoeff() / top);
  for (int round = 0; round < most_rounds && order > 0; ++round) {
    const Poles before = poles;
    poles = next_poles(poles, s, weighted, weight, direct, fit.unstable);
    if (change(poles, before) < settled) break;
  }

  const Mat A = stacked(weight.cast<Complex>().asDiagonal() * basis(s, poles, direct));
  fit.poles.resize(std::ssize(poles));
  fit.residues.resize(H.rows(), std::ssize(poles));
  fit.direct = Mat::Zero(H.rows(), 3);
  for (Eigen::Index e = 0; e < H.rows(); ++e) {
    const Vec x = solution(A, stacked(CMat(weighted.row(e).transpose())));
    Eigen::Index at = 0;
    for (std::size_t k = 0; k < poles.size(); ++k) {
      const bool has_two = is_pair(poles[k]);
      fit.residues(e, static_cast<Eigen::Index>(k)) =
          top * Complex(x(at), has_two ? x(at + 1) : 0.0);
      at += has_two ? 2 : 1;
    }
    for (int k = 0; k < direct; ++k) fit.direct(e, k) = x(at++) / std::pow(top, k);
  }
  for (std::size_t k = 0; k < poles.size(); ++k) {
    fit.poles(static_cast<Eigen::Index>(k)) = top * poles[k];
  }
  for (Eigen::Index k = 0; k < omega.size(); ++k) {
    const double left = (fit.at(Complex(0.0, omega(k))) - H.col(k)).norm() / sizes(k);
    fit.error += left * left / static_cast<double>(omega.size());
    fit.largest = std::max(fit.largest, left);
  }
  fit.error = std::sqrt(fit.error);
  return fit;
}

}  // namespace whirl::inline base
