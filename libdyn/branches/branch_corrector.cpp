#include "libdyn/branches/branch_corrector.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "libbase/error.hpp"
#include "libbase/numerics/newton.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int most_corrections = 8;
constexpr int renewal = 2;  ///< corrections after which the derivative by the parameter is renewed

}  // namespace

BranchCorrector::BranchCorrector(BranchEquations equations, double low, double high,
                                 Eigen::Index unknowns)
    : equations_(std::move(equations)),
      low_(low),
      high_(high),
      weights_(Vec::Constant(unknowns + 1, 1.0 / static_cast<double>(unknowns))) {
  weights_(unknowns) = 1.0;
}

double BranchCorrector::value_of(double u) const {
  if (u == 0.0) return low_;
  if (u == 1.0) return high_;
  return low_ + u * (high_ - low_);
}

double BranchCorrector::dot(const Vec& a, const Vec& b) const {
  return a.cwiseProduct(weights_).dot(b);
}

BranchEquations::Value BranchCorrector::evaluate(const Vec& z, WithTangent wanted) const {
  const Eigen::Index size = z.size() - 1;
  try {
    return equations_.at(z.head(size), value_of(z(size)), wanted);
  } catch (const NumericalError& error) {
    return {.failure = error.what()};
  }
}

Vec BranchCorrector::derivative_by_parameter(const Vec& z,
                                             const std::function<Vec()>& slope) const {
  try {
    const Vec exact = slope ? slope() : Vec();
    if (exact.size() > 0) return exact * (high_ - low_);
  } catch (const NumericalError&) {
  }  // it is not known
  return difference_by_parameter(z);
}

Vec BranchCorrector::difference_by_parameter(const Vec& z) const {
  // within the range, beyond which there may be no model: at its ends to one side
  const double u = z(z.size() - 1), h = equations_.difference;
  const double shifts[2][3] = {{-h, h, 0.0}, {0.0, u < 0.5 ? h : -h, u < 0.5 ? 2.0 * h : -2.0 * h}};
  const bool is_central = u - h >= 0.0 && u + h <= 1.0;
  Vec g[3];
  for (int k = 0; k < (is_central ? 2 : 3); ++k) {
    Vec at = z;
    at(z.size() - 1) = std::clamp(u + shifts[is_central ? 0 : 1][k], 0.0, 1.0);
    g[k] = evaluate(at, WithTangent::no).residual;
    if (g[k].size() == 0) return Vec::Zero(z.size() - 1);
  }
  if (is_central) return (g[1] - g[0]) / (2.0 * h);
  return (-3.0 * g[0] + 4.0 * g[1] - g[2]) / (2.0 * shifts[1][1]);
}

bool BranchCorrector::add_tangent(BranchTrial& trial, const Vec& along) const {
  const Eigen::Index size = trial.point.z.size() - 1;
  trial.by_parameter = derivative_by_parameter(trial.point.z, trial.slope);
  Mat M(size + 1, size + 1);
  M << trial.jacobian, trial.by_parameter, along.cwiseProduct(weights_).transpose();
  Vec unit = Vec::Zero(size + 1);
  unit(size) = 1.0;
  const auto tangent = newton_step(M, unit);
  if (!tangent) return false;
  trial.point.tangent = *tangent / std::sqrt(dot(*tangent, *tangent));
  return true;
}

BranchTrial BranchCorrector::correct(const BranchPlane& plane, Vec by_parameter) const {
  const Eigen::Index size = plane.at.size() - 1;
  struct Place {
    Vec z;
    BranchEquations::Value value{};
    double residual = std::numeric_limits<double>::infinity();
  };
  const auto is_outside = [&](const Vec& z) { return z(size) < 0.0 || z(size) > 1.0; };
  const auto place = [&](Vec z) {
    Place p{std::move(z)};
    p.value = is_outside(p.z) ? BranchEquations::Value{.failure = "outside of the range"}
                              : evaluate(p.z, WithTangent::yes);
    if (p.value.residual.size() > 0) p.residual = p.value.residual.lpNorm<Eigen::Infinity>();
    return p;
  };
  int corrections = 0;
  const auto step = [&](const Place& p) {
    if (corrections++ == renewal || by_parameter.size() == 0) {
      by_parameter = derivative_by_parameter(p.z, p.value.slope);
    }
    Mat M(size + 1, size + 1);
    M << p.value.jacobian, by_parameter, plane.normal.cwiseProduct(weights_).transpose();
    Vec r(size + 1);
    r << p.value.residual, dot(plane.normal, p.z - plane.at);
    return newton_step(M, r);
  };
  const bool is_at_value = plane.normal.head(size).isZero(0.0);
  const auto moved = [&](const Place& p, const Vec& dz) {
    Vec z = p.z - dz;
    if (is_at_value) z(size) = plane.at(size);  // exactly
    return place(std::move(z));
  };
  Place at = place(plane.at);
  const NewtonSearch search = newton(
      at, step, moved, {.most_steps = most_corrections, .largest_growth = 2.0, .largest = 1e3});
  BranchTrial trial{.corrections = search.steps()};
  if (search.has_converged()) {
    trial.point = {.value = value_of(at.z(size)),
                   .z = at.z,
                   .multipliers = at.value.multipliers(),
                   .residual = at.residual,
                   .contacts = std::move(at.value.contacts)};
    trial.jacobian = std::move(at.value.jacobian);
    trial.slope = std::move(at.value.slope);
    return trial;
  }
  trial.is_outside = is_outside(at.z);
  trial.failure = at.value.failure;
  if (search.end == NewtonEnd::singular) trial.failure = "the equations of the branch are singular";
  if (!trial.failure) trial.failure = "Newton's method does not converge";
  return trial;
}

}  // namespace whirl::inline dyn
