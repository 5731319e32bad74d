#include "libdyn/system/touch_spans.hpp"

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/roots.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int fewest_angles = 256;      ///< angles a revolution at which events are looked for
constexpr int angles_per_harmonic = 8;  ///< and of a harmonic
constexpr double whole = 1e-9;          ///< turns of a contact that count as whole ones
constexpr double sharpest = 1e-15;      ///< of a turn: how well events are known

}  // namespace

PeriodicContact::PeriodicContact(const ReducedContact& contact, const Periodic& motion)
    : contact_(contact), motion_(motion) {
  const double turns = turning_ratio_of(contact.geometry) * motion.period;
  closes_ = std::abs(turns - std::round(turns)) < whole;
  stiffness_ = normal_force(contact.law, contact.clearance, 0.0) / contact.clearance;
  const int N = std::max(fewest_angles * motion.period, angles_per_harmonic * motion.harmonics());
  angles_.reserve(static_cast<std::size_t>(N) + 1);
  for (int i = 0; i <= N; ++i) {
    angles_.push_back(turn * i / N);
    grid_.push_back(i < N || !closes_ ? at(angles_.back()) : grid_.front());
  }
}

ContactForces PeriodicContact::at(double theta) const {
  const auto [u, rate] = motion_.at(theta);
  const Vec2 d = u.head<2>() - contact_.offset;
  return kinematics(contact_, motion_.phase(theta),
                    {{d(0), d(1)}, {rate(0), rate(1)}, {rate.tail<2>()(0), rate.tail<2>()(1)}});
}

double PeriodicContact::gap(const ContactForces& f) const {
  if (const auto factor = rate_factor(contact_.law, f.rate)) {
    return std::min(f.depth, *factor * contact_.clearance);
  }
  if (is_continuous(contact_.law)) return f.depth;
  return std::min(f.depth, f.normal / stiffness_);
}

std::vector<double> PeriodicContact::zeros(const std::function<double(const ContactForces&)>& f,
                                           bool looks_between) const {
  const auto value = [&](double theta) { return f(at(theta)); };
  std::vector<double> found;
  const auto add = [&](double a, double fa, double b, double fb) {
    if ((fa > 0.0) != (fb > 0.0))
      found.push_back(bracketed_root(value, a, fa, b, fb, sharpest * turn));
  };
  const std::size_t N = angles_.size() - 1;
  std::vector<double> tops;  // of short touches: two neighbors may see the same one
  for (std::size_t i = 0; i < N; ++i) {
    const double here = f(grid_[i]), next = f(grid_[i + 1]);
    const double a = angles_[i], b = angles_[i + 1];
    // a short touch between two angles: the top of a parabola through three of them
    const bool is_first = i == 0 && !closes_;
    const double last = is_first ? here : f(grid_[i == 0 ? N - 1 : i - 1]);
    const double bend = last - 2.0 * here + next, slope = 0.5 * (next - last);
    if (looks_between && !is_first && here < 0.0 && next < 0.0 && last < 0.0 && bend < 0.0 &&
        std::abs(slope) < -bend && here - 0.5 * slope * slope / bend > 0.0) {
      const double top = a - slope / bend * (b - a), at_top = value(top);
      const bool is_known = std::any_of(tops.begin(), tops.end(), [&](double known) {
        return std::abs(std::remainder(top - known, turn)) < 0.5 * (b - a);
      });
      if (at_top > 0.0 && !is_known) {
        add(a - (b - a), last, top, at_top);
        add(top, at_top, b, next);
        tops.push_back(top);
      }
    }
    add(a, here, b, next);
  }
  for (double& theta : found) theta = theta < 0.0 ? theta + turn : theta;
  std::sort(found.begin(), found.end());
  return found;
}

/// Spans of what does not close, each from an event or the beginning to an event or the end.
std::vector<PeriodicContact::Span> PeriodicContact::spans_between(
    const std::vector<double>& touches) const {
  std::vector<Span> spans;
  double from = 0.0;
  for (std::size_t i = 0; i <= touches.size(); ++i) {
    const bool is_last = i == touches.size();
    const double to = is_last ? turn : touches[i];
    if (to > from && gap(at(0.5 * (from + to))) > 0.0) {
      spans.push_back({from, to, 1.0, i > 0, !is_last});
    }
    from = to;
  }
  return spans;
}

std::vector<PeriodicContact::Span> PeriodicContact::spans() const {
  const std::vector<double> touches = zeros([this](const auto& f) { return gap(f); }, true);
  std::vector<double> reversals;
  if (contact_.friction.is_exact()) {
    reversals = zeros([](const auto& f) { return f.slip; }, false);
  }
  if (!closes_) return spans_between(touches);
  std::vector<Span> spans;
  if (touches.empty() && reversals.empty()) {
    if (gap(grid_.front()) > 0.0) {
      spans.push_back({0.0, turn, grid_.front().slip >= 0.0 ? 1.0 : -1.0, false, false, true});
    }
    return spans;
  }
  std::vector<std::pair<double, bool>> events;  // and whether it touches or releases there
  for (const double theta : touches) events.emplace_back(theta, true);
  for (const double theta : reversals) events.emplace_back(theta, false);
  std::sort(events.begin(), events.end());
  for (std::size_t i = 0; i < events.size(); ++i) {
    const auto [from, begins] = events[i];
    const auto [next, ends] = events[(i + 1) % events.size()];
    const double to = i + 1 < events.size() ? next : next + turn;
    const ContactForces middle = at(0.5 * (from + to));
    if (gap(middle) <= 0.0) continue;
    spans.push_back({from, to, middle.slip >= 0.0 ? 1.0 : -1.0, begins, ends});
  }
  return spans;
}

}  // namespace whirl::inline dyn
