#include "libdyn/continuation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "libdyn/bifurcation.hpp"
#include "libfe/base/error.hpp"

namespace whirl {

namespace {

constexpr int most_corrections = 8;
constexpr int renewal = 2;  ///< corrections after which the derivative by the parameter is renewed
constexpr double flattest = 0.9;     ///< cosine of the angle between tangents, at least
constexpr double bend = 0.2;         ///< angle that steps aim at [rad]
constexpr double longest = 0.1;      ///< arc length of a step
constexpr double difference = 3e-6;  ///< of the range, for the derivative by the parameter
constexpr double shrink = 0.4;       ///< of a step that fails
constexpr double probed = 1e-2;      ///< arc length ahead of an end, for a grazing that causes it
constexpr double finest = 1e-6;      ///< arc length down to which bifurcations are told apart
constexpr double zero = 1e-3;        ///< of a test function, where it is located
constexpr int most_refinements = 60;
constexpr int most_grazings = 8;  ///< between two points

using enum BifurcationKind;

bool same_impacts(const std::vector<ContactMeasure>& a, const std::vector<ContactMeasure>& b) {
  for (std::size_t c = 0; c < std::min(a.size(), b.size()); ++c) {
    if (a[c].impacts != b[c].impacts) return false;
  }
  return true;
}

}  // namespace

void ContinuationOptions::check() const {
  if (!(low < high) || !(first >= low) || !(first <= high)) {
    throw NumericalError("continuation: the parameter's range must hold its first value");
  }
  if (period < 1 || most_points < 1 || !(smallest_step > 0.0) || !(located > 0.0) ||
      !(largest_step >= 0.0) || std::abs(direction) != 1.0) {
    throw NumericalError("continuation: steps, points and period must be positive");
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

Continuation::Continuation(FlowAt flow_at, const Vec& start, const ContinuationOptions& options)
    : options_(options) {
  options_.check();
  const Flow flow = flow_at(options_.first);
  scale_ = flow.scale;
  const PeriodicOrbit orbit = find_orbit(flow, start, {.period = options_.period});
  if (!orbit.is_good()) {
    throw NumericalError(
        fmt::format("at the first value, {:g}: {}", options_.first, orbit.failure));
  }
  equations_ = shooting_equations(std::move(flow_at), scale_);
  const Eigen::Index n = scale_.size();
  Vec x(n * options_.period);
  for (int i = 0; i < options_.period; ++i) {
    x.segment(i * n, n) = orbit.states[static_cast<std::size_t>(i)].cwiseQuotient(scale_);
  }
  begin(x, orbit.residual,
        {.jacobian = shooting_jacobian(orbit.tangents),
         .contacts = orbit.contacts,
         .multipliers = [&] { return orbit.multipliers; }});
}

Continuation::Continuation(OrbitEquations equations, const Vec& x,
                           const ContinuationOptions& options)
    : equations_(std::move(equations)), options_(options) {
  options_.check();
  const auto there = equations_.at(x, options_.first, Tangents::yes);
  if (there.residual.size() == 0) {
    throw NumericalError(
        fmt::format("at the first value, {:g}: {}", options_.first, there.failure));
  }
  begin(x, there.residual.lpNorm<Eigen::Infinity>(), there);
}

void Continuation::begin(const Vec& x, double residual, const OrbitEquations::Evaluation& there) {
  const Eigen::Index size = x.size();
  set_weights(size);
  Trial trial;
  trial.point.value = options_.first;
  trial.point.z.resize(size + 1);
  trial.point.z << x, (options_.first - options_.low) / options_.range();
  if (options_.first == options_.high) trial.point.z(size) = 1.0;
  trial.point.multipliers = there.multipliers();
  trial.point.residual = residual;
  trial.point.contacts = there.contacts;
  trial.jacobian = there.jacobian;
  Vec along = Vec::Zero(size + 1);
  along(size) = options_.direction;
  if (!add_tangent(trial, along, by_parameter_)) {
    throw NumericalError("the branch has no tangent at the first value: begin at another");
  }
  trial.point.step = limited(longest, trial.point.tangent);
  branch_.period = options_.period;
  branch_.points.push_back(std::move(trial.point));
}

Continuation::Continuation(FlowAt flow_at, Vec scale, Branch branch,
                           const ContinuationOptions& options)
    : Continuation(shooting_equations(std::move(flow_at), scale), std::move(branch), options) {
  scale_ = std::move(scale);
}

Continuation::Continuation(OrbitEquations equations, Branch branch,
                           const ContinuationOptions& options)
    : equations_(std::move(equations)), options_(options), branch_(std::move(branch)) {
  options_.period = branch_.period;
  options_.check();
  set_weights(branch_.points.back().z.size() - 1);
  if (branch_.end.empty()) by_parameter_ = derivative_by_parameter(branch_.points.back().z);
}

void Continuation::set_weights(Eigen::Index size) {
  weights_ = Vec::Constant(size + 1, 1.0 / static_cast<double>(size));
  weights_(size) = 1.0;
}

double Continuation::limited(double step, const Vec& tangent) const {
  const double most = options_.largest_step > 0.0 ? options_.largest_step / options_.range() : 0.01;
  const double share = std::abs(tangent(tangent.size() - 1));
  step = std::min(step, longest);
  return share * step > most ? most / share : step;
}

OrbitEquations::Evaluation Continuation::evaluate(const Vec& z, Tangents wanted) const {
  const Eigen::Index size = z.size() - 1;
  return equations_.at(z.head(size), value_of(z(size)), wanted);
}

Vec Continuation::derivative_by_parameter(const Vec& z) const {
  // within the range, beyond which there may be no model: at its ends to one side
  const double u = z(z.size() - 1), h = difference;
  const double shifts[2][3] = {{-h, h, 0.0}, {0.0, u < 0.5 ? h : -h, u < 0.5 ? 2.0 * h : -2.0 * h}};
  const bool is_central = u - h >= 0.0 && u + h <= 1.0;
  Vec g[3];
  for (int k = 0; k < (is_central ? 2 : 3); ++k) {
    Vec at = z;
    at(z.size() - 1) = std::clamp(u + shifts[is_central ? 0 : 1][k], 0.0, 1.0);
    g[k] = evaluate(at, Tangents::no).residual;
    if (g[k].size() == 0) return Vec::Zero(z.size() - 1);
  }
  if (is_central) return (g[1] - g[0]) / (2.0 * h);
  return (-3.0 * g[0] + 4.0 * g[1] - g[2]) / (2.0 * shifts[1][1]);
}

bool Continuation::add_tangent(Trial& trial, const Vec& along, Vec& by_parameter) const {
  const Eigen::Index size = trial.point.z.size() - 1;
  by_parameter = derivative_by_parameter(trial.point.z);
  Mat M(size + 1, size + 1);
  M << trial.jacobian, by_parameter, along.cwiseProduct(weights_).transpose();
  Vec unit = Vec::Zero(size + 1);
  unit(size) = 1.0;
  const auto tangent = newton_step(M, unit);
  if (!tangent) return false;
  trial.point.tangent = *tangent / std::sqrt(dot(*tangent, *tangent));
  return true;
}

Continuation::Trial Continuation::correct(const Plane& plane, Vec by_parameter) const {
  const Eigen::Index size = plane.at.size() - 1;
  Trial trial;
  Vec z = plane.at;
  double before = std::numeric_limits<double>::infinity();
  for (;; ++trial.corrections) {
    if (z(size) < 0.0 || z(size) > 1.0) {
      trial.is_outside = true;
      trial.failure = "outside of the range";
      return trial;
    }
    OrbitEquations::Evaluation now = evaluate(z, Tangents::yes);
    if (now.residual.size() == 0) {
      trial.failure = now.failure;
      return trial;
    }
    const double residual = now.residual.lpNorm<Eigen::Infinity>();
    trial.point.contacts = now.contacts;  // also of a failure, to tell why
    if (is_closed(residual, before)) {
      trial.point.value = value_of(z(size));
      trial.point.z = z;
      trial.point.residual = residual;
      trial.point.multipliers = now.multipliers();
      trial.jacobian = std::move(now.jacobian);
      return trial;
    }
    if (trial.corrections == most_corrections || residual > 2.0 * before || residual > 1e3) {
      trial.failure = "Newton's method does not converge";
      return trial;
    }
    before = residual;
    if (trial.corrections == renewal) by_parameter = derivative_by_parameter(z);
    Mat M(size + 1, size + 1);
    M << now.jacobian, by_parameter, plane.normal.cwiseProduct(weights_).transpose();
    Vec r(size + 1);
    r << now.residual, dot(plane.normal, z - plane.at);
    const auto correction = newton_step(M, r);
    if (!correction) {
      trial.failure = "the equations of the branch are singular";
      return trial;
    }
    z -= *correction;
    if (plane.normal.head(size).isZero(0.0)) z(size) = plane.at(size);  // exactly at this value
  }
}

bool Continuation::advance() {
  if (!branch_.end.empty()) return false;
  if (std::ssize(branch_.points) >= options_.most_points) {
    branch_.end = "as many points as asked for";
    return false;
  }
  const BranchPoint last = branch_.points.back();
  const Eigen::Index size = last.z.size() - 1;
  const double u = last.z(size), share = last.tangent(size);
  const bool is_first = last.multipliers.size() == 0;
  std::string why;
  for (double step = std::max(last.step, options_.smallest_step); step >= options_.smallest_step;
       step *= shrink) {
    Plane plane{last.tangent, last.z + step * last.tangent};
    const auto to_the_end = [&] {  // onto the end of the range, where the branch is done
      const double end = share > 0.0 ? 1.0 : 0.0;
      plane.at = last.z + (end - u) / share * last.tangent;
      plane.at(size) = end;
      plane.normal = Vec::Unit(size + 1, size);
    };
    bool is_end = plane.at(size) >= 1.0 || plane.at(size) <= 0.0;
    if (is_end) to_the_end();
    // where branches meet, what leads to either of them is in the derivative near by
    Trial trial = correct(plane, is_first ? derivative_by_parameter(plane.at) : by_parameter_);
    if (trial.is_outside && !is_end && std::abs(share) > 1e-3) {
      is_end = true;
      to_the_end();
      trial = correct(plane, by_parameter_);
    }
    Vec by_parameter;
    if (trial.failure.empty() && !add_tangent(trial, last.tangent, by_parameter)) {
      trial.failure = "the branch has no tangent";
    }
    if (!trial.failure.empty()) {
      why = trial.failure;
      continue;
    }
    const double cosine = dot(trial.point.tangent, last.tangent);
    const Vec moved = trial.point.z - last.z;
    const double length = std::sqrt(dot(moved, moved));
    if (!is_first && (cosine < flattest || length > 2.0 * step)) {
      why = "the branch bends too sharply";
      continue;
    }
    const double angle = std::acos(std::min(1.0, std::abs(cosine)));
    double growth = trial.corrections <= 2 ? 1.6 : trial.corrections <= 4 ? 1.2 : 0.6;
    if (angle > 0.0) growth = std::min(growth, bend / angle);
    trial.point.step = limited(std::max(0.3, growth) * step, trial.point.tangent);
    const std::size_t known = branch_.bifurcations.size();
    if (!is_first && !find_bifurcations(last, trial.point) && step > finest) {
      branch_.bifurcations.resize(known);  // too much happens on the way
      why = "bifurcations are too close to each other";
      continue;
    }
    by_parameter_ = std::move(by_parameter);
    branch_.points.push_back(std::move(trial.point));
    if (is_end) branch_.end = "the end of the range";
    return true;
  }
  if (std::abs(share) > 1e-3 && (u <= 0.0 || u >= 1.0) && std::ssize(branch_.points) > 1) {
    branch_.end = "the end of the range";
  } else {
    end_at_failure(why);
  }
  return false;
}

void Continuation::end_at_failure(const std::string& why) {
  const BranchPoint& last = branch_.points.back();
  branch_.end = fmt::format("no orbit is found beyond {:.10g}: {}", last.value, why);
  // the motions that the tangent predicts: do they touch otherwise, and from where on
  const auto impacts_differ = [&](double length, std::vector<ContactMeasure>& seen) {
    Vec z = last.z + length * last.tangent;
    z(z.size() - 1) = std::clamp(z(z.size() - 1), 0.0, 1.0);
    const auto there = evaluate(z, Tangents::no);
    if (there.residual.size() == 0) return false;
    seen = there.contacts;
    return !same_impacts(seen, last.contacts);
  };
  std::vector<ContactMeasure> seen;
  double low = 0.0, high = options_.smallest_step;
  while (high < probed && !impacts_differ(high, seen)) {
    low = high;
    high *= 2.0;
  }
  if (high >= probed) return;
  for (std::vector<ContactMeasure> middle; high - low > 1e-3 * high;) {
    const double half = 0.5 * (low + high);
    if (impacts_differ(half, middle)) {
      high = half;
      seen = middle;
    } else {
      low = half;
    }
  }
  for (std::size_t c = 0; c < seen.size(); ++c) {
    const double change = seen[c].impacts - last.contacts[c].impacts;
    if (change == 0.0) continue;
    Bifurcation end{.kind = grazing,
                    .at = last,
                    .after = branch_.points.size() - 1,
                    .contact = last.contacts[c].name,
                    .change = change,
                    .multiplier = critical_multiplier(grazing, {})};
    const double u = last.z(last.z.size() - 1) + high * last.tangent(last.z.size() - 1);
    end.at.value = value_of(std::clamp(u, 0.0, 1.0));
    branch_.end = fmt::format("contact {} grazes at about {:.7g}, beyond {:.10g} no orbit is found",
                              end.contact, end.at.value, last.value);
    branch_.bifurcations.push_back(std::move(end));
  }
}

Continuation::Trial Continuation::between(const BranchPoint& a, const BranchPoint& b,
                                          double length) const {
  const Vec chord = b.z - a.z;
  Plane plane{chord / std::sqrt(dot(chord, chord)), a.z};
  plane.at += length * plane.normal;
  Trial trial = correct(plane, by_parameter_);
  Vec ignored;
  // where two branches meet there is no single tangent
  if (trial.failure.empty() && !add_tangent(trial, plane.normal, ignored)) {
    trial.point.tangent = plane.normal;
  }
  return trial;
}

bool Continuation::find_bifurcations(const BranchPoint& a, const BranchPoint& b) {
  const std::size_t known = branch_.bifurcations.size();
  const auto changes = [&](BifurcationKind kind) {
    return (test_function(kind, a) > 0.0) != (test_function(kind, b) > 0.0);
  };
  const bool folds = changes(fold);
  bool all = true;
  if (folds) all = locate(fold, a, b);
  if (changes(period_doubling)) all = locate(period_doubling, a, b) && all;
  if (changes(pitchfork) != folds) all = locate(pitchfork, a, b) && all;
  if (changes(neimark_sacker)) all = locate(neimark_sacker, a, b) && all;
  if (!same_impacts(a.contacts, b.contacts)) all = locate_grazings(a, b) && all;
  const Vec chord = b.z - a.z;
  std::stable_sort(branch_.bifurcations.begin() + static_cast<std::ptrdiff_t>(known),
                   branch_.bifurcations.end(), [&](const Bifurcation& x, const Bifurcation& y) {
                     return dot(chord, x.at.z - y.at.z) < 0.0;
                   });
  return all;
}

bool Continuation::locate(BifurcationKind kind, const BranchPoint& a, const BranchPoint& b) {
  // false position with halved weights, within brackets all the time
  const Vec chord = b.z - a.z;
  double low = 0.0, high = std::sqrt(dot(chord, chord)), length = high;
  double f_low = test_function(kind, a), f_high = test_function(kind, b);
  int side = 0;
  BranchPoint best = std::abs(f_low) < std::abs(f_high) ? a : b;
  double before = best.z(best.z.size() - 1) + 1.0;
  for (int i = 0; i < most_refinements; ++i) {
    const bool bisects = i % 8 == 7 || !std::isfinite(f_low) || !std::isfinite(f_high);
    length = bisects ? 0.5 * (low + high) : (low * f_high - high * f_low) / (f_high - f_low);
    const Trial trial = between(a, b, length);
    if (!trial.failure.empty()) break;
    best = trial.point;
    const double f = test_function(kind, best), u = best.z(best.z.size() - 1);
    const bool is_still = std::abs(u - before) < options_.located;
    if ((is_still && (std::abs(f) < 1e-6 || high - low < 1e-12)) || std::abs(f) < 1e-12) break;
    before = u;
    if ((f > 0.0) == (f_high > 0.0)) {
      high = length, f_high = f;
      if (side == 1) f_low *= 0.5;
      side = 1;
    } else {
      low = length, f_low = f;
      if (side == -1) f_high *= 0.5;
      side = -1;
    }
  }
  const Complex mu = critical_multiplier(kind, best.multipliers);
  if (!(std::abs(test_function(kind, best)) < zero)) return false;
  if (kind == neimark_sacker && std::abs(mu.imag()) < 1e-8)
    return true;  // a real pair, 1/mu and mu
  branch_.bifurcations.push_back(
      {.kind = kind, .at = std::move(best), .after = branch_.points.size() - 1, .multiplier = mu});
  return true;
}

bool Continuation::locate_grazings(const BranchPoint& a, const BranchPoint& b) {
  const Vec chord = b.z - a.z;
  const double whole = std::sqrt(dot(chord, chord));
  double from = 0.0;
  BranchPoint before = a;
  for (int k = 0; k < most_grazings && !same_impacts(before.contacts, b.contacts); ++k) {
    double low = from, high = whole;
    BranchPoint beyond = b;
    while (high - low > 1e-12 && std::abs(beyond.z(beyond.z.size() - 1) -
                                          before.z(before.z.size() - 1)) > options_.located) {
      const double middle = 0.5 * (low + high);
      Trial trial = between(a, b, middle);
      if (!trial.failure.empty()) return false;
      if (same_impacts(trial.point.contacts, before.contacts)) {
        low = middle;
        before = std::move(trial.point);
      } else {
        high = middle;
        beyond = std::move(trial.point);
      }
    }
    for (std::size_t c = 0; c < beyond.contacts.size(); ++c) {
      const double change = beyond.contacts[c].impacts - before.contacts[c].impacts;
      if (change == 0.0) continue;
      branch_.bifurcations.push_back({.kind = grazing,
                                      .at = beyond,
                                      .after = branch_.points.size() - 1,
                                      .contact = beyond.contacts[c].name,
                                      .change = change,
                                      .multiplier = critical_multiplier(grazing, {})});
    }
    before = std::move(beyond);
    from = high;
  }
  return same_impacts(before.contacts, b.contacts);
}

}  // namespace whirl
