#include "libdata/measured/key_phasor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/statistics.hpp"

namespace whirl::inline data {

namespace {

constexpr double back_by = 0.2;           ///< of a signal's range, before another pulse counts
constexpr double uneven_by = 0.35;        ///< of an interval between pulses, against its neighbors
constexpr double same_interval = 0.15;    ///< to which intervals are alike
constexpr std::size_t most_together = 3;  ///< pulses that are missing one after the other
constexpr std::size_t around = 3;         ///< intervals to each side that one is compared with

/// Intervals between pulses, and what they usually are about each of them.
class Intervals {
 public:
  explicit Intervals(const std::vector<double>& pulses) {
    for (std::size_t i = 1; i < pulses.size(); ++i) of_.push_back(pulses[i] - pulses[i - 1]);
  }
  double at(std::size_t i) const { return of_[i]; }
  /// The median of an interval and its neighbors.
  double usual(std::size_t i) const {
    const std::size_t first = i > around ? i - around : 0;
    const std::size_t end = std::min(of_.size(), i + around + 1);
    return median_of({of_.begin() + static_cast<std::ptrdiff_t>(first),
                      of_.begin() + static_cast<std::ptrdiff_t>(end)});
  }
  std::size_t count() const { return of_.size(); }
  /// Whether an interval and the next one are one that a pulse too many cuts in two: rather than
  /// the next one and that behind it.
  bool is_cut(std::size_t i) const {
    const double off = off_as_one(i);
    return off < same_interval && off <= off_as_one(i + 1);
  }

 private:
  /// By what share an interval and the next one together are not a usual one.
  double off_as_one(std::size_t i) const {
    if (i + 1 >= of_.size()) return std::numeric_limits<double>::infinity();
    return std::abs((of_[i] + of_[i + 1]) / usual(i) - 1.0);
  }

  std::vector<double> of_;
};

/// Leaves pulses out that cut an interval in two, and puts missing ones between their neighbors.
std::vector<double> mended_pulses(const std::vector<double>& pulses, const KeyPhasor& key,
                                  std::vector<std::string>& notes) {
  const Intervals intervals(pulses);
  if (intervals.count() <= 2 * around) return pulses;
  std::vector<double> mended{pulses.front()}, extra, missing;
  for (std::size_t i = 0; i < intervals.count(); ++i) {
    const double usual = intervals.usual(i), begin = pulses[i];
    double interval = intervals.at(i);
    if (intervals.is_cut(i)) {
      extra.push_back(pulses[++i]);
      interval += intervals.at(i);
    }
    for (std::size_t more = 1; more <= most_together; ++more) {
      const auto parts = static_cast<double>(more + 1);
      if (std::abs(interval / (parts * usual) - 1.0) > same_interval) continue;
      for (std::size_t k = 1; k <= more; ++k) {
        missing.push_back(begin + static_cast<double>(k) * interval / parts);
        mended.push_back(missing.back());
      }
      break;
    }
    mended.push_back(pulses[i + 1]);
  }
  const auto note = [&](const std::vector<double>& which, const char* what, const char* done) {
    if (which.empty()) return;
    notes.push_back(fmt::format("key-phasor \"{}\": {} pulse{} {}, the first at {:.6g} s; {}",
                                key.channel, which.size(), which.size() == 1 ? " is" : "s are",
                                what, which.front(), done));
  };
  note(missing, "missing", "such pulses are put between their neighbors");
  note(extra, "too many", "such pulses are left out");
  return mended;
}

}  // namespace

std::vector<double> pulse_times(const Vec& samples, const MeasuredRecord& record,
                                const KeyPhasor& key) {
  std::vector<double> times;
  if (samples.size() < 2) return times;
  const double low = samples.minCoeff(), high = samples.maxCoeff();
  const double sign = key.slope == PulseEdge::rising ? 1.0 : -1.0;
  const double threshold = sign * key.threshold.value_or(0.5 * (low + high));
  const double lowest = key.slope == PulseEdge::rising ? low : -high;
  const double armed_below =
      std::max(threshold - back_by * (high - low), 0.5 * (lowest + threshold));
  bool is_armed = sign * samples(0) < threshold;
  for (Eigen::Index j = 1; j < samples.size(); ++j) {
    const double before = sign * samples(j - 1), here = sign * samples(j);
    if (here < armed_below) is_armed = true;
    if (!is_armed || here < threshold || before >= threshold) continue;
    is_armed = false;
    times.push_back(record.time(j - 1) + (threshold - before) / (here - before) / record.rate);
  }
  return times;
}

TurnClock::TurnClock(std::vector<double> pulses, const KeyPhasor& key,
                     std::vector<std::string>& notes)
    : pulses_(std::move(pulses)), per_turn_(key.pulses), angle_(key.angle) {
  const std::size_t n = pulses_.size();
  if (n < 3) {
    throw OptionError(fmt::format(
        "key-phasor \"{}\": found {} pulse{}, expected three or more: set its threshold "
        "and slope, or leave the key-phasor out and give the speed",
        key.channel, n, n == 1 ? "" : "s"));
  }
  pulses_ = mended_pulses(pulses_, key, notes);
  note_jump(key, notes);
  set_slopes();
}

void TurnClock::note_jump(const KeyPhasor& key, std::vector<std::string>& notes) const {
  const Intervals intervals(pulses_);
  for (std::size_t i = 1; i + 1 < intervals.count(); ++i) {
    const double expected = 0.5 * (intervals.at(i - 1) + intervals.at(i + 1));
    if (std::abs(intervals.at(i) / expected - 1.0) < uneven_by) continue;
    notes.push_back(fmt::format(
        "key-phasor \"{}\": the time between pulses jumps at {:.6g} s; one is missing or too many",
        key.channel, pulses_[i]));
    break;
  }
}

void TurnClock::set_slopes() {
  const std::size_t n = pulses_.size();
  slopes_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    // the parabola through three pulses, about the middle one
    const std::size_t m = std::clamp<std::size_t>(i, 1, n - 2);
    const double h0 = pulses_[m] - pulses_[m - 1], h1 = pulses_[m + 1] - pulses_[m];
    const double middle = (h1 / h0 + h0 / h1) / (h0 + h1);
    const double curvature = 2.0 * (1.0 / h1 - 1.0 / h0) / (h0 + h1);
    slopes_[i] = middle + curvature * (pulses_[i] - pulses_[m]);
  }
}

TurnClock::Piece TurnClock::piece_at(double t) const {
  const auto above = std::upper_bound(pulses_.begin() + 1, pulses_.end() - 1, t);
  const auto i = static_cast<std::size_t>(above - pulses_.begin()) - 1;
  const double h = pulses_[i + 1] - pulses_[i];
  return {h, (t - pulses_[i]) / h, slopes_[i] * h, slopes_[i + 1] * h, i};
}

std::vector<double> TurnClock::turns() const {
  std::vector<double> times;
  for (std::size_t i = 0; i < pulses_.size(); i += static_cast<std::size_t>(per_turn_)) {
    times.push_back(pulses_[i]);
  }
  return times;
}

double TurnClock::angle(double t) const {
  const Piece p = piece_at(t);
  // from 0 to 1 with these slopes
  const double s = p.s;
  const double part = s * s * (3.0 - 2.0 * s) + p.slope_0 * s * (1.0 - s) * (1.0 - s) -
                      p.slope_1 * s * s * (1.0 - s);
  return angle_ + turn * (static_cast<double>(p.number) + part) / per_turn_;
}

double TurnClock::speed(double t) const {
  const Piece p = piece_at(t);
  const double s = p.s;
  const double rate = 6.0 * s * (1.0 - s) + p.slope_0 * (1.0 - s) * (1.0 - 3.0 * s) +
                      p.slope_1 * s * (3.0 * s - 2.0);
  return turn * rate / (p.h * per_turn_);
}

double TurnClock::mean_speed() const {
  return turn * static_cast<double>(pulses_.size() - 1) / (per_turn_ * (last() - first()));
}

double TurnClock::variation() const {
  const auto apart = static_cast<std::size_t>(per_turn_);
  double least = mean_speed(), most = least;
  for (std::size_t i = apart; i < pulses_.size(); ++i) {
    const double speed = turn / (pulses_[i] - pulses_[i - apart]);
    least = std::min(least, speed);
    most = std::max(most, speed);
  }
  return (most - least) / mean_speed();
}

}  // namespace whirl::inline data
