#include "libdyn/branches/continuation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "libbase/error.hpp"
#include "libbase/numerics/newton.hpp"
#include "libdyn/branches/bifurcation.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int most_corrections = 8;
constexpr int renewal = 2;  ///< corrections after which the derivative by the parameter is renewed
constexpr double flattest = 0.9;  ///< cosine of the angle between tangents, at least
constexpr double bend = 0.2;      ///< angle that steps aim at [rad]
constexpr double longest = 0.1;   ///< arc length of a step
constexpr double shrink = 0.4;    ///< of a step that fails
constexpr double finest = 1e-6;   ///< arc length down to which bifurcations are told apart
/// Parameter's share of a tangent that leads to an end of the range, rather than along it.
constexpr double along_range = 1e-3;

const BranchEnd range_end{EndKind::range, "the end of the range"};

using enum BifurcationKind;

}  // namespace

void ContinuationOptions::check() const {
  if (!(low < high) || !(first >= low) || !(first <= high)) {
    throw OptionError("continuation: the parameter's range must hold its first value");
  }
  if (period < 1 || most_points < 1 || !(smallest_step > 0.0) || !(located > 0.0) ||
      !(largest_step >= 0.0) || std::abs(direction) != 1.0) {
    throw OptionError("continuation: steps, points and period must be positive");
  }
}

double Continuation::value_of(double u) const {
  if (u == 0.0) return options_.low;
  if (u == 1.0) return options_.high;
  return options_.low + u * options_.range();
}

double Continuation::dot(const Vec& a, const Vec& b) const {
  return a.cwiseProduct(weights_).dot(b);
}

Continuation::Continuation(BranchEquations equations, const Vec& x,
                           const ContinuationOptions& options)
    : equations_(std::move(equations)), options_(options) {
  options_.check();
  const Eigen::Index size = x.size();
  weigh(size);
  Vec z(size + 1);
  z << x,
      options_.first == options_.high ? 1.0 : (options_.first - options_.low) / options_.range();
  Trial trial = correct({Vec::Unit(size + 1, size), z}, Vec::Zero(size));
  if (trial.failure) {
    throw NumericalError(
        fmt::format("at the first value, {:g}: {}", options_.first, trial.failure.text()));
  }
  trial.point.value = options_.first;
  Vec along = Vec::Zero(size + 1);
  along(size) = options_.direction;
  if (!add_tangent(trial, along)) {
    throw NumericalError("the branch has no tangent at the first value: begin at another");
  }
  trial.point.step = limited(longest, trial.point.tangent);
  branch_.period = options_.period;
  accept(std::move(trial));
}

Continuation::Continuation(BranchEquations equations, Branch branch,
                           const ContinuationOptions& options, Vec by_parameter)
    : equations_(std::move(equations)),
      options_(options),
      branch_(std::move(branch)),
      by_parameter_(std::move(by_parameter)) {
  options_.check();
  const Vec& z = branch_.points.back().z;
  weigh(z.size() - 1);
  if (!branch_.end && by_parameter_.size() == 0) {
    by_parameter_ = derivative_by_parameter(z, evaluate(z, WithTangent::yes).slope);
  }
}

void Continuation::weigh(Eigen::Index unknowns) {
  weights_ = Vec::Constant(unknowns + 1, 1.0 / static_cast<double>(unknowns));
  weights_(unknowns) = 1.0;
}

double Continuation::limited(double step, const Vec& tangent) const {
  const double most = options_.largest_step > 0.0 ? options_.largest_step / options_.range() : 0.01;
  const double share = std::abs(tangent(tangent.size() - 1));
  step = std::min(step, longest);
  return share * step > most ? most / share : step;
}

BranchEquations::Value Continuation::evaluate(const Vec& z, WithTangent wanted) const {
  const Eigen::Index size = z.size() - 1;
  try {
    return equations_.at(z.head(size), value_of(z(size)), wanted);
  } catch (const NumericalError& error) {
    return {.failure = error.what()};
  }
}

Vec Continuation::derivative_by_parameter(const Vec& z, const std::function<Vec()>& slope) const {
  try {
    const Vec exact = slope ? slope() : Vec();
    if (exact.size() > 0) return exact * options_.range();
  } catch (const NumericalError&) {
  }  // it is not known
  return difference_by_parameter(z);
}

Vec Continuation::difference_by_parameter(const Vec& z) const {
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

bool Continuation::add_tangent(Trial& trial, const Vec& along) const {
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

Continuation::Trial Continuation::correct(const Plane& plane, Vec by_parameter) const {
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
  Trial trial{.corrections = search.steps()};
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

Continuation::Plane Continuation::range_end_ahead() const {
  const BranchPoint& last = branch_.points.back();
  const Eigen::Index size = last.z.size() - 1;
  const double share = last.tangent(size), end = share > 0.0 ? 1.0 : 0.0;
  Plane plane{Vec::Unit(size + 1, size), last.z + (end - last.z(size)) / share * last.tangent};
  plane.at(size) = end;
  return plane;
}

Continuation::Trial Continuation::reach(double step) const {
  const BranchPoint& last = branch_.points.back();
  const Eigen::Index size = last.z.size() - 1;
  const bool is_first = last.multipliers.size() == 0;
  Plane plane{last.tangent, last.z + step * last.tangent};
  bool is_end = plane.at(size) >= 1.0 || plane.at(size) <= 0.0;
  if (is_end) plane = range_end_ahead();
  // where branches meet, what leads to either of them is in the derivative near by
  Trial trial = correct(plane, is_first ? Vec() : by_parameter_);
  if (trial.is_outside && !is_end && std::abs(last.tangent(size)) > along_range) {
    is_end = true;
    trial = correct(range_end_ahead(), by_parameter_);
  }
  if (!trial.failure && !add_tangent(trial, last.tangent)) {
    trial.failure = "the branch has no tangent";
  }
  if (trial.failure) return trial;
  const Vec moved = trial.point.z - last.z;
  const double cosine = dot(trial.point.tangent, last.tangent),
               length = std::sqrt(dot(moved, moved));
  if (!is_first && (cosine < flattest || length > 2.0 * step)) {
    trial.failure = "the branch bends too sharply";
  }
  if (is_end) trial.end = range_end;
  trial.point.step = next_step(trial, step);
  return trial;
}

double Continuation::next_step(const Trial& trial, double step) const {
  const double cosine = dot(trial.point.tangent, branch_.points.back().tangent);
  const double angle = std::acos(std::min(1.0, std::abs(cosine)));
  double growth = trial.corrections <= 2 ? 1.6 : trial.corrections <= 4 ? 1.2 : 0.6;
  if (angle > 0.0) growth = std::min(growth, bend / angle);
  return limited(std::max(0.3, growth) * step, trial.point.tangent);
}

void Continuation::accept(Trial trial) {
  if (trial.end && trial.end->kind == EndKind::period_halved) forget_vertex(trial.point);
  branch_.end = std::move(trial.end);
  by_parameter_ = std::move(trial.by_parameter);
  branch_.points.push_back(std::move(trial.point));
}

bool Continuation::advance() {
  const std::size_t known = branch_.bifurcations.size();
  try {
    return add_point();
  } catch (...) {
    branch_.bifurcations.resize(known);
    branch_.end.reset();  // an ended branch evaluates nothing: the end is of this point
    throw;
  }
}

bool Continuation::add_point() {
  if (branch_.end) return false;
  if (std::ssize(branch_.points) >= options_.most_points) {
    branch_.end = {EndKind::most_points, "as many points as asked for"};
    return false;
  }
  const BranchPoint& last = branch_.points.back();
  const bool is_first = last.multipliers.size() == 0;
  const std::size_t known = branch_.bifurcations.size();
  std::string why;
  for (double step = std::max(last.step, options_.smallest_step); step >= options_.smallest_step;
       step *= shrink) {
    Trial trial = reach(step);
    if (!trial.failure) {
      trial = stop_on_the_way(std::move(trial));
      if (is_first || find_bifurcations(last, trial.point) || step <= finest) {
        accept(std::move(trial));
        return true;
      }
      branch_.bifurcations.resize(known);
      trial.failure = "bifurcations are too close to each other";
    }
    why = trial.failure;
  }
  const double u = last.z(last.z.size() - 1);
  if (std::abs(last.tangent(last.z.size() - 1)) > along_range && (u <= 0.0 || u >= 1.0) &&
      std::ssize(branch_.points) > 1) {
    branch_.end = range_end;
  } else {
    cross_or_end(why);
  }
  return !branch_.end;
}

}  // namespace whirl::inline dyn
