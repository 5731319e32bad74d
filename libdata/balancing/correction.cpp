#include "libdata/balancing/correction.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>

#include "libbase/error.hpp"
#include "libdata/balancing/central_path.hpp"

namespace whirl::inline data {

namespace {

constexpr double same_planes = 1e-9;    ///< singular values below which planes do the same
constexpr double nothing_left = 1e-10;  ///< of the vibration: nothing is left
constexpr double proven = 1e-6;  ///< of the vibration: what an objective may be above its bound

/// A problem with rows times their weights, all columns and the vibration of size one.
struct ScaledProblem {
  explicit ScaledProblem(const CorrectionProblem& p)
      : a(p.weight.asDiagonal() * p.A), v(p.weight.asDiagonal() * p.V) {
    size = v.size() > 0 ? v.cwiseAbs().maxCoeff() : 0.0;
    if (!(size > 0.0)) size = 1.0;
    v /= size;
    unit.resize(a.cols());
    for (Eigen::Index k = 0; k < a.cols(); ++k) {
      const double largest = a.col(k).cwiseAbs().maxCoeff();
      unit(k) = largest > 0.0 ? size / largest : 1.0;
      a.col(k) *= unit(k) / size;
    }
    limit = p.limit.cwiseQuotient(unit);
  }

  CMat a;
  CVec v;
  Vec limit;
  Vec unit;           ///< of the weights [kg]
  double size = 1.0;  ///< the largest vibration
};

double objective_of(const CorrectionProblem& p, const CVec& left) {
  const Vec r = p.weight.cwiseProduct(left.cwiseAbs());
  return p.criterion == BalancingCriterion::min_max ? r.maxCoeff() : r.norm();
}

/// The two planes that make most of what does nothing.
std::string planes_in(const CVec& direction, const std::vector<std::string>& planes) {
  Vec share = direction.cwiseAbs();
  Eigen::Index first = 0, second = 0;
  share.maxCoeff(&first);
  share(first) = -1.0;
  share.maxCoeff(&second);
  const std::string& a = planes[static_cast<std::size_t>(first)];
  if (planes.size() == 1) return fmt::format("weights in plane {} do nothing to the readings", a);
  return fmt::format(
      "weights in planes {} and {} do the same to all readings: leave one of these planes out", a,
      planes[static_cast<std::size_t>(second)]);
}

}  // namespace

Correction correct(const CorrectionProblem& problem, const std::vector<std::string>& planes) {
  const ScaledProblem scaled(problem);
  const Eigen::Index m = scaled.a.rows(), n = scaled.a.cols();
  if ((problem.weight.array() > 0.0).count() < n) {
    throw OptionError(
        fmt::format("{} readings do not tell the weights of {} planes: expected as "
                    "many probes and speeds as planes, or more",
                    m, n));
  }
  const Eigen::JacobiSVD<CMat> svd(scaled.a, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Vec& values = svd.singularValues();
  if (!(values(n - 1) > same_planes * values(0))) {
    throw OptionError(planes_in(svd.matrixV().col(n - 1), planes));
  }
  CVec w = -svd.solve(scaled.v);
  const CVec rest = scaled.a * w + scaled.v;
  const bool is_within = (w.cwiseAbs().array() <= scaled.limit.array()).all();
  const bool is_sum = problem.criterion == BalancingCriterion::least_squares;
  Correction found;
  const auto finish = [&](const CVec& scaled_weights) {
    found.weights = scaled.unit.cwiseProduct(scaled_weights);
    found.left = problem.V + problem.A * found.weights;
    found.objective = objective_of(problem, found.left);
  };
  if (is_within && (is_sum || rest.cwiseAbs().maxCoeff() <= nothing_left)) {
    finish(w);
    found.bound = is_sum ? found.objective : 0.0;
    return found;
  }
  if ((scaled.limit.array() <= 0.0).any()) {
    throw OptionError("limits of weights must be above zero");
  }
  const CentralPathEnd end = walk_central_path(scaled.a, scaled.v, scaled.limit, is_sum);
  finish(end.w);
  const Vec rests = rest.cwiseAbs();
  if (is_within && scaled.size * rests.maxCoeff() < found.objective) finish(w);  // next to nothing
  found.bound =
      scaled.size * std::sqrt(lower_bound(scaled.a, scaled.v, scaled.limit, end.lambda, end.mu));
  if (!(found.objective - found.bound <= proven * scaled.size)) {
    throw NumericalError(fmt::format(
        "weights were not found: {:.6g} is left at best, while {:.6g} is all that is proven",
        found.objective, found.bound));
  }
  found.bound = std::min(found.bound, found.objective);
  return found;
}

}  // namespace whirl::inline data
