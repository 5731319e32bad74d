#include "libdata/balancing/central_path.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace whirl::inline data {

namespace {

/// Rows of a complex problem as pairs of real ones: w = (Re w, Im w).
class Barrier {
 public:
  Barrier(const CMat& a, const CVec& v, const Vec& limit, bool is_sum)
      : n_(a.cols()), parts_(n_ + n_), limit_(limit), is_sum_(is_sum) {
    rows_.resize(2 * a.rows(), parts_);
    constant_.resize(2 * a.rows());
    for (Eigen::Index j = 0; j < a.rows(); ++j) {
      rows_.row(2 * j) << a.row(j).real(), -a.row(j).imag();
      rows_.row(2 * j + 1) << a.row(j).imag(), a.row(j).real();
      constant_.segment<2>(2 * j) << v(j).real(), v(j).imag();
    }
  }

  Eigen::Index planes() const { return n_; }
  Eigen::Index parts() const { return parts_; }
  Eigen::Index readings() const { return constant_.size() / 2; }
  /// Constraints, each of which adds 1/s to the gap at the center.
  double constraints() const {
    return static_cast<double>((is_sum_ ? 0 : readings()) + limit_.array().isFinite().count());
  }

  Vec squares(const Vec& w) const {
    const Vec r = rows_ * w + constant_;
    return Eigen::Map<const Eigen::Matrix2Xd>(r.data(), 2, readings()).colwise().squaredNorm();
  }
  double room(const Vec& w, Eigen::Index k) const {
    return limit_(k) * limit_(k) - w(k) * w(k) - w(n_ + k) * w(n_ + k);
  }
  Vec start() const {
    Vec x = Vec::Zero(parts_ + 1);
    x(parts_) = 2.0 * squares(x.head(parts_)).maxCoeff() + 1e-3;
    return x;
  }

  /// What a step adds to s times the objective and the barriers; infinite: it leads outside. The
  /// sum itself is so large at the end that the change would be lost in it.
  double change(const Vec& x, const Vec& step, double s) const {
    const Vec w = x.head(parts_), r = rows_ * w + constant_, dr = rows_ * step.head(parts_);
    double total = is_sum_ ? s * dr.dot(2.0 * r + dr) : s * step(parts_);
    for (Eigen::Index j = 0; j < readings() && !is_sum_; ++j) {
      const auto r_j = r.segment<2>(2 * j), dr_j = dr.segment<2>(2 * j);
      const double slack = x(parts_) - r_j.squaredNorm(),
                   more = step(parts_) - dr_j.dot(2.0 * r_j + dr_j);
      if (!(slack + more > 0.0)) return INFINITY;
      total -= std::log1p(more / slack);
    }
    for (Eigen::Index k = 0; k < n_; ++k) {
      if (!std::isfinite(limit_(k))) continue;
      const double now = room(w + step.head(parts_), k);
      if (!(now > 0.0)) return INFINITY;
      total -= std::log(now / room(w, k));
    }
    return total;
  }

  /// A Newton step for the value; its decrement is the value that is hoped for.
  Vec step(const Vec& x, double s, double& decrement) const {
    const Eigen::Index size = parts_ + (is_sum_ ? 0 : 1);
    Vec g = Vec::Zero(size);
    Mat H = Mat::Zero(size, size);
    const Vec w = x.head(parts_), r = rows_ * w + constant_;
    if (!is_sum_) g(parts_) = s;
    for (Eigen::Index j = 0; j < readings(); ++j) {
      const auto B = rows_.middleRows<2>(2 * j);
      Vec df = Vec::Zero(size);  // of |r_j|^2 - tau
      df.head(parts_) = 2.0 * B.transpose() * r.segment<2>(2 * j);
      if (is_sum_) {
        g += s * df;
        H.topLeftCorner(parts_, parts_) += 2.0 * s * B.transpose() * B;
        continue;
      }
      df(parts_) = -1.0;
      const double slack = x(parts_) - r.segment<2>(2 * j).squaredNorm();
      g += df / slack;
      H += df * df.transpose() / (slack * slack);
      H.topLeftCorner(parts_, parts_) += 2.0 / slack * B.transpose() * B;
    }
    for (Eigen::Index k = 0; k < n_; ++k) {
      if (!std::isfinite(limit_(k))) continue;
      const double slack = room(w, k);
      Vec df = Vec::Zero(size);
      df(k) = 2.0 * w(k);
      df(n_ + k) = 2.0 * w(n_ + k);
      g += df / slack;
      H += df * df.transpose() / (slack * slack);
      H(k, k) += 2.0 / slack;
      H(n_ + k, n_ + k) += 2.0 / slack;
    }
    // scaled: near the end some curvatures are far larger than others
    const Vec scale = H.diagonal().cwiseSqrt().cwiseInverse();
    const Vec found =
        -(scale.asDiagonal() *
          (scale.asDiagonal() * H * scale.asDiagonal()).ldlt().solve(scale.asDiagonal() * g));
    decrement = -g.dot(found);
    Vec full = Vec::Zero(parts_ + 1);
    full.head(size) = found;
    return full;
  }

 private:
  Eigen::Index n_;      // planes
  Eigen::Index parts_;  // real and imaginary ones of their weights
  Mat rows_;
  Vec constant_, limit_;
  bool is_sum_;
};

void center(const Barrier& barrier, Vec& x, double s) {
  constexpr int most_steps = 60;
  constexpr double enough = 1e-8;  // of the decrement: multipliers are right to its root
  for (int i = 0; i < most_steps; ++i) {
    double decrement = 0.0;
    const Vec step = barrier.step(x, s, decrement);
    if (!step.allFinite() || !(decrement > enough)) return;
    double length = 1.0;
    constexpr double shortest = 1e-6;
    while (length > shortest &&
           !(barrier.change(x, length * step, s) < -0.1 * length * decrement)) {
      length *= 0.5;
    }
    if (length <= shortest) return;  // rounding
    x += length * step;
  }
}

/// Weights and multipliers at a place of the path.
CentralPathEnd end_at(const Barrier& barrier, const Vec& x, double s, const Vec& limit,
                      bool is_sum) {
  const Eigen::Index n = barrier.planes();
  CentralPathEnd end{CVec(n), Vec::Ones(barrier.readings()), Vec::Zero(n)};
  end.w.real() = x.head(n);
  end.w.imag() = x.segment(n, n);
  if (!is_sum) {
    end.lambda =
        (s * (x(barrier.parts()) - barrier.squares(x.head(barrier.parts())).array())).inverse();
    end.lambda /= end.lambda.sum();
  }
  for (Eigen::Index k = 0; k < n; ++k) {
    if (std::isfinite(limit(k))) end.mu(k) = 1.0 / (s * barrier.room(x.head(barrier.parts()), k));
  }
  return end;
}

}  // namespace

CentralPathEnd walk_central_path(const CMat& a, const CVec& v, const Vec& limit, bool is_sum) {
  const Barrier barrier(a, v, limit, is_sum);
  Vec x = barrier.start();
  constexpr double growth = 10.0, enough = 1e-12;  // of the gap, relative
  constexpr double longest = 1e15;                 // beyond it there is rounding only
  CentralPathEnd best;
  double least = INFINITY;
  for (double s = 1.0; s < longest; s *= growth) {
    center(barrier, x, s);
    const Vec f = barrier.squares(x.head(barrier.parts()));
    const double objective = is_sum ? f.sum() : f.maxCoeff();
    const CentralPathEnd end = end_at(barrier, x, s, limit, is_sum);
    const double gap = objective - lower_bound(a, v, limit, end.lambda, end.mu);
    if (gap < least) {
      least = gap;
      best = end;
    }
    if (gap <= enough * objective) break;
  }
  return best;
}

double lower_bound(const CMat& a, const CVec& v, const Vec& limit, const Vec& lambda,
                   const Vec& mu) {
  // least squares of the rows times sqrt(lambda), with rows sqrt(mu_k) w_k below
  const Eigen::Index m = a.rows(), n = a.cols();
  CMat rows = CMat::Zero(m + n, n);
  CVec constant = CVec::Zero(m + n);
  rows.topRows(m) = lambda.cwiseSqrt().asDiagonal() * a;
  constant.head(m) = lambda.cwiseSqrt().asDiagonal() * v;
  double taken_off = 0.0;
  for (Eigen::Index k = 0; k < n; ++k) {
    if (!std::isfinite(limit(k))) continue;
    rows(m + k, k) = std::sqrt(mu(k));
    taken_off += mu(k) * limit(k) * limit(k);
  }
  const CVec w = -rows.completeOrthogonalDecomposition().solve(constant);
  return std::max(0.0, (rows * w + constant).squaredNorm() - taken_off);
}

}  // namespace whirl::inline data
