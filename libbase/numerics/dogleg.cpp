#include "libbase/numerics/dogleg.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "libbase/system/interruption.hpp"

namespace whirl::inline base {

namespace {

/// Tells which steps to take: those by which the cost falls as predicted, from the last place or
/// from an earlier one that several steps lead away from.
class Acceptance {
 public:
  Acceptance(double cost, int most_uphill)
      : most_uphill_(most_uphill), current_(cost), least_(cost), reference_(cost), worst_(cost) {}

  /// Decrease of the cost over the one that is predicted, by one step or by all since the
  /// reference.
  double quality(double cost, double predicted) const {
    return std::max((current_ - cost) / predicted,
                    (reference_ - cost) / (since_reference_ + predicted));
  }

  void take(double cost, double predicted) {
    current_ = cost;
    since_reference_ += predicted;
    since_worst_ += predicted;
    if (cost < least_) {
      least_ = worst_ = cost;
      since_worst_ = 0.0;
      uphill_ = 0;
      return;
    }
    ++uphill_;
    if (cost > worst_) {
      worst_ = cost;
      since_worst_ = 0.0;
    }
    if (uphill_ == most_uphill_) {
      reference_ = worst_;
      since_reference_ = since_worst_;
    }
  }

 private:
  int most_uphill_, uphill_ = 0;
  double current_, least_, reference_, worst_;        ///< worst_: since the least one
  double since_reference_ = 0.0, since_worst_ = 0.0;  ///< predicted decreases
};

/// The two steps that a dogleg is made of, at one place.
class Steps {
 public:
  /// @param least_scale  of each variable, for columns that vanish
  Steps(const Sparse& J, const Vec& r, const Vec& least_scale) : D_(least_scale) {
    for (Eigen::Index i = 0; i < J.cols(); ++i) D_(i) = std::max(D_(i), J.col(i).norm());
    const Vec g = J.transpose() * r;
    slope_ = g.cwiseQuotient(D_);
    const Vec along = J * slope_.cwiseQuotient(D_);
    const double curvature = along.squaredNorm();
    lowest_ = curvature > 0.0 ? slope_.squaredNorm() / curvature : 0.0;
    const Sparse normal = Sparse(J.transpose()) * J;
    for (double nu = 1e-8; nu <= 1.0; nu *= 10.0) {
      const Eigen::SimplicialLLT<Sparse> factor(normal +
                                                Sparse((nu * D_.cwiseAbs2()).asDiagonal()));
      if (factor.info() != Eigen::Success) continue;
      gauss_newton_ = -D_.cwiseProduct(Vec(factor.solve(g)));
      if (gauss_newton_.allFinite()) return;
    }
    gauss_newton_ = -lowest_ * slope_;
  }

  /// Step within a radius of the scaled variables D s.
  Vec within(double radius) const {
    const double far = gauss_newton_.norm();
    if (far <= radius) return gauss_newton_.cwiseQuotient(D_);
    const double downhill = lowest_ * slope_.norm();
    if (downhill >= radius) return (-radius / slope_.norm() * slope_).cwiseQuotient(D_);
    const Vec a = -lowest_ * slope_, b = gauss_newton_ - a;  // |a + t b| = radius
    const double bb = b.squaredNorm(), ab = a.dot(b);
    const double left = radius * radius - a.squaredNorm();
    const double t = left / (ab + std::sqrt(ab * ab + bb * left));
    return (a + t * b).cwiseQuotient(D_);
  }

  double length(const Vec& step) const { return D_.cwiseProduct(step).norm(); }

 private:
  Vec D_, slope_;
  double lowest_ = 0.0;  ///< of slope_, to the minimum along the steepest descent
  Vec gauss_newton_;     ///< times D
};

/// Where a search is.
struct Place {
  Vec x, r;
  Sparse J;
  double cost = 0.0;
};

/// J without the columns of variables that a bound holds: the cost falls beyond it.
Sparse free_columns(const LeastSquares& problem, const Place& at) {
  if (problem.lower.size() == 0) return at.J;
  const Vec g = at.J.transpose() * at.r;
  const auto is_low = at.x.array() <= problem.lower.array() && g.array() > 0.0;
  const auto is_high = at.x.array() >= problem.upper.array() && g.array() < 0.0;
  const Vec is_free = (is_low || is_high).select(0.0, Vec::Ones(at.x.size()).array());
  return at.J * is_free.asDiagonal();
}

Vec within_bounds(const LeastSquares& problem, Vec x) {
  if (problem.lower.size() == 0) return x;
  return x.cwiseMax(problem.lower).cwiseMin(problem.upper);
}

class Search {
 public:
  Search(const LeastSquares& problem, const DoglegOptions& options)
      : problem_(problem), options_(options) {}

  DoglegResult from(Vec x) {
    found_.x = x;
    at_.x = std::move(x);
    found_.iterations = 1;
    if (!look()) return found_;
    Acceptance acceptance(at_.cost, options_.most_uphill_steps);
    for (Eigen::Index i = 0; i < at_.J.cols(); ++i) {
      const double norm = at_.J.col(i).norm();
      least_scale_.conservativeResize(i + 1);
      least_scale_(i) = norm > 0.0 ? 1e-3 * norm : 1.0;
    }
    keep_best();
    for (bool goes_on = true; goes_on;) {
      Sparse J = free_columns(problem_, at_);
      const Steps steps(J, at_.r, least_scale_);
      goes_on = step(steps, J, acceptance);
    }
    return found_;
  }

 private:
  static constexpr double accepted = 1e-3, poor = 0.25, good = 0.75;  ///< qualities of steps

  bool look() {
    if (!problem_.evaluate(at_.x, at_.r, &at_.J)) return false;
    at_.cost = 0.5 * at_.r.squaredNorm();
    return std::isfinite(at_.cost);
  }

  void keep_best() {
    if (!(at_.cost < found_.cost)) return;
    found_.x = at_.x;
    found_.cost = at_.cost;
  }

  bool ends(DoglegEnd why) {
    found_.end = why;
    return false;
  }

  /// Shrinks the region until a step is taken.
  /// @return  whether the search goes on
  bool step(const Steps& steps, const Sparse& J, Acceptance& acceptance) {
    bool was_defined = true;
    for (;;) {
      interruption_point();
      if (options_.is_stopped && options_.is_stopped()) return ends(DoglegEnd::stopped);
      if (found_.iterations > options_.most_iterations) return ends(DoglegEnd::most_iterations);
      const Vec next = within_bounds(problem_, at_.x + steps.within(radius_));
      const Vec s = next - at_.x;
      if (s.norm() <= options_.step_tolerance * (at_.x.norm() + options_.step_tolerance)) {
        return ends(was_defined ? DoglegEnd::converged : DoglegEnd::undefined);
      }
      ++found_.iterations;
      const Vec change = J * s;
      const double predicted = -change.dot(at_.r + 0.5 * change);
      Vec r;
      was_defined = problem_.evaluate(next, r, nullptr);
      const double cost = was_defined ? 0.5 * r.squaredNorm() : HUGE_VAL;
      const bool is_last = std::abs(at_.cost - cost) <= options_.cost_tolerance * at_.cost;
      const double quality = predicted > 0.0 ? acceptance.quality(cost, predicted) : -1.0;
      if (!(quality > accepted) && !is_last) {
        radius_ = 0.5 * std::min(radius_, steps.length(s));
        continue;
      }
      if (is_last) {
        if (cost < found_.cost) found_.x = next, found_.cost = cost;
        return ends(DoglegEnd::converged);
      }
      if (quality < poor) radius_ *= 0.5;
      if (quality > good) radius_ = std::max(radius_, 3.0 * steps.length(s));
      acceptance.take(cost, predicted);
      at_.x = next;
      if (!look()) return ends(DoglegEnd::undefined);
      keep_best();
      return true;
    }
  }

  const LeastSquares& problem_;
  const DoglegOptions& options_;
  Place at_;
  Vec least_scale_;
  double radius_ = 1e4;
  DoglegResult found_;
};

}  // namespace

DoglegResult dogleg(const LeastSquares& problem, Vec x, const DoglegOptions& options) {
  return Search(problem, options).from(std::move(x));
}

}  // namespace whirl::inline base
