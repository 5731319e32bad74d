#include "libio/results/motion_window.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"
#include "libio/text/value_range.hpp"

namespace whirl::inline io {

namespace {

constexpr double rounding = 1e-6;  ///< of a sample's spacing

/// Where a motion begins and ends, in revolutions.
struct RecordedRange {
  explicit RecordedRange(const RecordedMotion& m)
      : motion(m),
        first(m.time(0) / m.period),
        last(m.time(m.time.size() - 1) / m.period),
        spacing(1.0 / static_cast<double>(m.per_revolution)) {}

  const RecordedMotion& motion;
  double first, last, spacing;

  /// The end as it is said: whole revolutions were recorded, and the last sample is one short.
  double end() const { return last + spacing; }
  /// "revolutions 0 to 20 of 120, 0 to 0.27 s"
  std::string text(double from, double to, const std::string& of) const {
    const std::string seconds =
        fmt::format("{:.4g} to {:.4g} s", from * motion.period, to * motion.period);
    return motion.spins ? fmt::format("revolutions {:.6g} to {:.6g}{}, {}", from, to, of, seconds)
                        : seconds;
  }
  bool begins_within(double from) const {
    return from >= first - rounding * spacing && from < last;
  }
  bool ends_within(double to) const { return to <= last + (1.0 + rounding) * spacing; }

  [[noreturn]] void refuse(const std::string& asked) const {
    throw ModelError({asked}, "", "is not within what was recorded: " + text(first, end(), ""));
  }
};

/// First and last revolution that were asked for.
std::pair<double, double> asked_for(const MotionWindow& window, const RecordedRange& all,
                                    double usual) {
  if (window.times) {
    const auto [from, to] = *window.times;
    const double first = from / all.motion.period, last = to / all.motion.period;
    if (!all.begins_within(first) || !all.ends_within(last) || !(first < last)) {
      all.refuse(fmt::format("--times {:g}:{:g}", from, to));
    }
    return {first, last};
  }
  if (!window.from_revolution) {
    const double count = window.revolutions.value_or(usual);
    return {std::max(all.first, all.last - count), all.last};
  }
  const double from = *window.from_revolution, to = from + window.revolutions.value_or(usual);
  if (!all.begins_within(from)) all.refuse(fmt::format("--from-revolution {:g}", from));
  if (window.revolutions && !all.ends_within(to)) {
    all.refuse(fmt::format("--from-revolution {:g} --revolutions {:g}", from, to - from));
  }
  return {from, to};
}

}  // namespace

ModelError wrong_window(std::string problem) {
  return ModelError({"--revolutions, --from-revolution, --times"}, "", std::move(problem));
}

Parsed<std::pair<double, double>> parse_times(std::string_view text) {
  using Times = std::pair<double, double>;
  const auto range = parse_range(text, "s");
  if (!range) return Parsed<Times>::failed(range.problem);
  if (range->step) return Parsed<Times>::failed("expected two times, first:last");
  return Times{range->first, range->last};
}

RecordedMotion recorded_motion(const ResultReader& file) {
  const double samples = file.number_attribute("/trajectory", "samples_per_revolution");
  const bool spins = file.has_attribute("/", "speed") && file.number_attribute("/", "speed") > 0.0;
  return {.time = file.vector("/trajectory/time"),
          .period = file.number_attribute("/trajectory", "period"),
          .per_revolution = std::max<Eigen::Index>(1, static_cast<Eigen::Index>(samples)),
          .spins = spins};
}

MotionSamples samples_of(const MotionWindow& window, const RecordedMotion& motion, double usual) {
  const RecordedRange all(motion);
  const auto [from, to] = asked_for(window, all, usual);
  const auto most = static_cast<double>(motion.time.size() - 1);
  const auto place = [&](double revolution) { return (revolution - all.first) / all.spacing; };
  MotionSamples samples;
  samples.first =
      static_cast<Eigen::Index>(std::clamp(std::ceil(place(from) - rounding), 0.0, most));
  samples.last = static_cast<Eigen::Index>(
      std::clamp(std::floor(place(to) + rounding), static_cast<double>(samples.first), most));
  const bool is_to_the_end = samples.last == motion.time.size() - 1;
  // the last revolutions begin a sample early, where they close; that is not worth a fraction in
  // words
  const bool are_last = !window.times && !window.from_revolution;
  const double begin = motion.time(samples.first) / motion.period;
  samples.text =
      all.text(are_last && begin > all.first ? begin + all.spacing : begin,
               is_to_the_end ? all.end() : motion.time(samples.last) / motion.period,
               fmt::format(" of {}{:.6g}",
                           all.first > 0.0 ? fmt::format("{:.6g} to ", all.first) : "", all.end()));
  return samples;
}

}  // namespace whirl::inline io
