#include "libdyn/branches/continuation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"
#include "libdyn/branches/bifurcation.hpp"

namespace whirl::inline dyn {

namespace {

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

std::string ContinuationOptions::value_text(double value) const {
  return fmt::format("{:.10g}{}{}", value, unit.empty() ? "" : " ", unit);
}

void ContinuationOptions::check() const {
  if (!(low < high) || !(first >= low) || !(first <= high)) {
    throw OptionError("continuation: the parameter's range must hold its first value");
  }
  if (period < 1 || most_points < 1 || !(smallest_step > 0.0) || !(located > 0.0) ||
      !(largest_step >= 0.0) || std::abs(direction) != 1.0) {
    throw OptionError("continuation: steps, points and period must be positive");
  }
}

Continuation::Continuation(BranchEquations equations, const Vec& x,
                           const ContinuationOptions& options)
    : corrector_(std::move(equations), options.low, options.high, x.size()), options_(options) {
  options_.check();
  const Eigen::Index size = x.size();
  Vec z(size + 1);
  z << x,
      options_.first == options_.high ? 1.0 : (options_.first - options_.low) / options_.range();
  BranchTrial trial = corrector_.correct({Vec::Unit(size + 1, size), z}, Vec::Zero(size));
  if (trial.failure) {
    throw NumericalError(fmt::format("at the first value, {}: {}",
                                     options_.value_text(options_.first), trial.failure.text()));
  }
  trial.point.value = options_.first;
  Vec along = Vec::Zero(size + 1);
  along(size) = options_.direction;
  if (!corrector_.add_tangent(trial, along)) {
    throw NumericalError("the branch has no tangent at the first value: begin at another");
  }
  trial.point.step = limited(longest, trial.point.tangent);
  branch_.period = options_.period;
  accept(std::move(trial));
}

Continuation::Continuation(BranchEquations equations, Branch branch,
                           const ContinuationOptions& options, Vec by_parameter)
    : corrector_(std::move(equations), options.low, options.high,
                 branch.points.back().z.size() - 1),
      options_(options),
      branch_(std::move(branch)),
      by_parameter_(std::move(by_parameter)) {
  options_.check();
  const Vec& z = branch_.points.back().z;
  if (!branch_.end && by_parameter_.size() == 0) {
    by_parameter_ =
        corrector_.derivative_by_parameter(z, corrector_.evaluate(z, WithTangent::yes).slope);
  }
}

double Continuation::limited(double step, const Vec& tangent) const {
  const double most = options_.largest_step > 0.0 ? options_.largest_step / options_.range() : 0.01;
  const double share = std::abs(tangent(tangent.size() - 1));
  step = std::min(step, longest);
  return share * step > most ? most / share : step;
}

BranchPlane Continuation::range_end_ahead() const {
  const BranchPoint& last = branch_.points.back();
  const Eigen::Index size = last.z.size() - 1;
  const double share = last.tangent(size), end = share > 0.0 ? 1.0 : 0.0;
  BranchPlane plane{Vec::Unit(size + 1, size),
                    last.z + (end - last.z(size)) / share * last.tangent};
  plane.at(size) = end;
  return plane;
}

BranchTrial Continuation::reach(double step) const {
  const BranchPoint& last = branch_.points.back();
  const Eigen::Index size = last.z.size() - 1;
  const bool is_first = last.multipliers.size() == 0;
  BranchPlane plane{last.tangent, last.z + step * last.tangent};
  bool is_end = plane.at(size) >= 1.0 || plane.at(size) <= 0.0;
  if (is_end) plane = range_end_ahead();
  // where branches meet, what leads to either of them is in the derivative near by
  BranchTrial trial = corrector_.correct(plane, is_first ? Vec() : by_parameter_);
  if (trial.is_outside && !is_end && std::abs(last.tangent(size)) > along_range) {
    is_end = true;
    trial = corrector_.correct(range_end_ahead(), by_parameter_);
  }
  if (!trial.failure && !corrector_.add_tangent(trial, last.tangent)) {
    trial.failure = "the branch has no tangent";
  }
  if (trial.failure) return trial;
  const Vec moved = trial.point.z - last.z;
  const double cosine = corrector_.dot(trial.point.tangent, last.tangent),
               length = std::sqrt(corrector_.dot(moved, moved));
  if (!is_first && (cosine < flattest || length > 2.0 * step)) {
    trial.failure = "the branch bends too sharply";
  }
  if (is_end) trial.end = range_end;
  trial.point.step = next_step(trial, step);
  return trial;
}

double Continuation::next_step(const BranchTrial& trial, double step) const {
  const double cosine = corrector_.dot(trial.point.tangent, branch_.points.back().tangent);
  const double angle = std::acos(std::min(1.0, std::abs(cosine)));
  double growth = trial.corrections <= 2 ? 1.6 : trial.corrections <= 4 ? 1.2 : 0.6;
  if (angle > 0.0) growth = std::min(growth, bend / angle);
  return limited(std::max(0.3, growth) * step, trial.point.tangent);
}

void Continuation::accept(BranchTrial trial) {
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
    BranchTrial trial = reach(step);
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
