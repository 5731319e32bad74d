#include "libio/measured/raw_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "libbase/numerics/constants.hpp"
#include "libio/measured/channel_unit.hpp"
#include "libio/measured/record_parts.hpp"
#include "libio/text/delimited.hpp"
#include "libio/text/vendor_units.hpp"

namespace whirl::inline io {

namespace {

constexpr double same_rate = 1e-4;  ///< to which --rate gives that of a file more digits
constexpr double near_rate = 0.1;   ///< to which a rate is that of times in seconds, not in ms

/// Numbers of the steps at which times stand, from 0: a time that comes after several steps has
/// left the samples between out.
std::vector<double> step_numbers(const RawChannel& time) {
  const std::vector<double>& t = time.samples;
  std::vector<double> steps;
  for (std::size_t i = 1; i < t.size(); ++i) {
    steps.push_back(t[i] - t[i - 1]);
    if (steps.back() > 0.0) continue;
    throw ModelError(time.where, time.name,
                     fmt::format("sample {} is at {}, the one before at {}: expected times that "
                                 "ascend, with all their digits",
                                 i + 1, t[i], t[i - 1]));
  }
  std::vector<double> sorted = steps;
  const auto middle = sorted.begin() + (std::ssize(sorted) - 1) / 2;
  std::nth_element(sorted.begin(), middle, sorted.end());
  std::vector<double> numbers{0.0};
  for (const double step : steps) {
    numbers.push_back(numbers.back() + std::max(1.0, std::round(step / *middle)));
  }
  const auto longest = std::max_element(steps.begin(), steps.end()) - steps.begin();
  const auto n = static_cast<double>(t.size());
  const double missing = numbers.back() + 1.0 - n;
  if (!(missing <= most_missing * (n + missing))) {
    const auto after = static_cast<std::size_t>(longest);
    throw ModelError(
        time.where, time.name,
        fmt::format("{:.6g} of {:.6g} samples are missing, the longest gap is from {} to {}: steps "
                    "must be even, with at most {:g} % of the samples left out",
                    missing, n + missing, t[after], t[after + 1], 100.0 * most_missing));
  }
  return numbers;
}

/// Checks that a rate that a file says beside its times is that of these: one of both may be in
/// another unit.
void require_same_rate(const RawRecord& raw, const RawChannel& time, double said, double steps) {
  constexpr double most_apart = 0.01;  // beside what the digits of two times leave open
  const double within = std::max({most_apart, raw.rate_within, 2.0 * even_to / steps});
  if (std::abs(*raw.rate / said - 1.0) <= within) return;
  throw ModelError(time.where, time.name,
                   fmt::format("the times say {:.6g} samples per second, another line of the file "
                               "says {:.6g}: one of them is wrong, or in another unit",
                               said, *raw.rate));
}

/// Takes rate and start from a channel of times; returns the step number of each.
std::vector<double> take_times(RawRecord& raw, const RawChannel& time) {
  const auto seconds = seconds_in(time.unit);
  if (!seconds) throw ModelError(time.where, time.name, seconds.problem);
  const double factor = *seconds;
  const std::vector<double>& t = time.samples;
  if (t.size() < 2) throw ModelError(time.where, time.name, "expected two times or more");
  const std::vector<double> numbers = step_numbers(time);
  const double step = (t.back() - t.front()) / numbers.back();
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double expected = t.front() + step * numbers[i];
    if (std::abs(t[i] - expected) <= even_to * step) continue;
    throw ModelError(
        time.where, time.name,
        fmt::format("sample {} is at {}, expected {:.9g}: steps must be even, to {:g} % of {:.6g}",
                    i + 1, t[i], expected, 100.0 * even_to, step));
  }
  const double said = 1.0 / (factor * step);
  if (raw.rate) require_same_rate(raw, time, said, numbers.back());
  // a rate that the file says has more digits than its times, unless it is rounded
  if (!raw.rate || raw.rate_within > same_rate) raw.rate = said;
  raw.rate_within = 0.0;
  raw.start = factor * t.front();
  return numbers;
}

/// Puts samples where their times are, and NaN where times were left out.
void spread(std::vector<double>& samples, const std::vector<double>& numbers) {
  if (samples.size() != numbers.size()) return;  // told later
  std::vector<double> all(static_cast<std::size_t>(numbers.back()) + 1, nan);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    all[static_cast<std::size_t>(numbers[i])] = samples[i];
  }
  samples = std::move(all);
}

Eigen::Map<const Vec> samples_of(const RawChannel& channel) {
  return {channel.samples.data(), std::ssize(channel.samples)};
}

/// The channel of times: by its name, else the first one in a unit of time, in whatever language,
/// which always ascends where the rate is known.
std::vector<RawChannel>::iterator time_in(std::vector<RawChannel>& channels, bool is_rate_known) {
  // T may be a temperature beside t
  const auto is_named = [](const RawChannel& c) { return !c.clock && names_time(c.name); };
  auto named = std::find_if(channels.begin(), channels.end(),
                            [&](const RawChannel& c) { return is_named(c) && ascends(c.samples); });
  if (named == channels.end()) named = std::find_if(channels.begin(), channels.end(), is_named);
  if (named != channels.end()) return named;
  std::map<std::string, bool> is_time;  // each unit is read once: there may be many channels
  return std::find_if(channels.begin(), channels.end(), [&](const RawChannel& c) {
    if (c.unit.empty() || c.clock) return false;
    const auto [known, is_new] = is_time.try_emplace(c.unit, false);
    if (is_new) known->second = static_cast<bool>(unit_in_table(c.unit, "s"));
    return known->second && (!is_rate_known || always_ascends(samples_of(c)));
  });
}

/// Gives a first column that always ascends, in a file that names none, the name that it must have:
/// of times in seconds, unless that cannot be.
void name_ramp(RawRecord& raw, std::optional<double> rate) {
  RawChannel& first = raw.channels.front();
  if (!first.unit.empty()) return;
  for (const RawChannel& c : raw.channels) {
    if (!c.name.empty()) return;
  }
  const Eigen::Map<const Vec> samples = samples_of(first);
  if (!always_ascends(samples)) return;
  const double step =
      (samples(samples.size() - 1) - samples(0)) / static_cast<double>(samples.size() - 1);
  const std::optional<double> known = raw.rate ? raw.rate : rate;
  const bool is_right = known ? std::abs(*known * step - 1.0) <= near_rate : step <= longest_step;
  if (!is_right) {
    throw ModelError(
        first.where, "",
        fmt::format(
            "the first column always ascends, by {:.6g}, and no line says what it is: times "
            "{}, numbers of the samples, or a channel; name the columns in a line above, "
            "such as \"time [ms]\"",
            step,
            known ? fmt::format("in seconds do not fit {:.6g} samples per second", *known)
                  : "in seconds would be far apart"));
  }
  first.name = "time";
  raw.notes.push_back(
      fmt::format("the first column has no name and always ascends, by {:.6g}: taken as times in "
                  "seconds; the columns behind it are channels 1 to {}",
                  step, raw.channels.size() - 1));
}

/// Numbers as names of channels that have none.
void number_channels(std::vector<RawChannel>& channels) {
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (channels[i].name.empty()) channels[i].name = std::to_string(i + 1);
  }
}

/// Settles the rate between what the file and --rate say.
void take_rate(RawRecord& raw, std::optional<double> rate) {
  const Where where{raw.file};
  if (raw.rate && rate) {
    if (!(std::abs(*raw.rate / *rate - 1.0) <= std::max(same_rate, raw.rate_within))) {
      throw ModelError(
          where, "",
          fmt::format("says {:.6g} samples per second, --rate says {:.6g}: leave --rate out, "
                      "or mend the file",
                      *raw.rate, *rate));
    }
    raw.rate = rate;
  }
  if (raw.channels.empty()) throw ModelError(where, "", "has no channels with samples");
  if (!raw.rate) raw.rate = rate;
  if (!raw.rate) {
    throw ModelError(
        where, "",
        "does not say how many samples a second has: " +
            (raw.no_rate_because.empty() ? "expected a column \"time [s]\" or a sample rate"
                                         : raw.no_rate_because) +
            "; --rate says it, too");
  }
  if (!(*raw.rate > 0.0) || !std::isfinite(*raw.rate)) {
    throw ModelError(where, "", fmt::format("says a sample rate of {} 1/s", *raw.rate));
  }
}

/// Times that count from long ago, as from 1970, have few digits left for samples.
void count_from_first(RawRecord& raw) {
  constexpr double long_ago = 1e8;  // three years [s]
  if (!(std::abs(raw.start) > long_ago)) return;
  raw.notes.push_back(
      fmt::format("times begin at {:.9g} s: they are counted from the first sample", raw.start));
  raw.start = 0.0;
}

/// Checks that the times of neighboring samples differ by more than their rounding.
void require_times_apart(const RawRecord& raw) {
  constexpr double least = 8.0 * std::numeric_limits<double>::epsilon();
  const double step = 1.0 / *raw.rate;
  const double length = static_cast<double>(raw.channels.front().samples.size()) * step;
  if (step > least * std::max(std::abs(raw.start), std::abs(raw.start + length))) return;
  throw ModelError({raw.file}, "",
                   fmt::format("begins at {:.6g} s and says {:.6g} samples per second: times of "
                               "neighbors are the same number; mend the start or the rate",
                               raw.start, *raw.rate));
}

/// Channels in m and V as one matrix.
MeasuredRecord as_record(RawRecord raw) {
  MeasuredRecord record{.rate = *raw.rate,
                        .start = raw.start,
                        .notes = std::move(raw.notes),
                        .left_out = std::move(raw.left_out)};
  const std::size_t n = raw.channels.front().samples.size();
  if (n == 0) throw ModelError({raw.file}, "", "has no samples");
  record.samples.resize(static_cast<Eigen::Index>(n), std::ssize(raw.channels));
  for (std::size_t i = 0; i < raw.channels.size(); ++i) {
    const RawChannel& channel = raw.channels[i];
    if (channel.samples.size() != n) {
      throw ModelError(channel.where, channel.name,
                       fmt::format("has {} samples, expected {} as of {}", channel.samples.size(),
                                   n, raw.channels.front().name));
    }
    const ChannelUnit unit = channel_unit(channel.unit);
    record.channels.push_back({channel.name, unit.name, channel.path});
    record.samples.col(static_cast<Eigen::Index>(i)) =
        unit.factor * Eigen::Map<const Vec>(channel.samples.data(), static_cast<Eigen::Index>(n));
  }
  return record;
}

MeasuredRecord finished_part(RawRecord raw, std::optional<double> rate) {
  if (!raw.has_own_times) {
    const auto time = time_in(raw.channels, raw.rate || rate);
    if (time != raw.channels.end()) {
      const RawChannel times = std::move(*time);
      raw.channels.erase(time);
      const std::vector<double> numbers = take_times(raw, times);
      for (RawChannel& channel : raw.channels) spread(channel.samples, numbers);
    }
  }
  number_channels(raw.channels);
  take_rate(raw, rate);
  count_from_first(raw);
  require_times_apart(raw);
  return as_record(std::move(raw));
}

bool is_one_of(const std::string& name, std::initializer_list<std::string_view> known) {
  return std::find(known.begin(), known.end(), plain_name(name)) != known.end();
}

}  // namespace

bool ascends(const std::vector<double>& samples) {
  return std::adjacent_find(samples.begin(), samples.end(),
                            [](double a, double b) { return !(a < b); }) == samples.end();
}

Parsed<double> seconds_in(const std::string& unit) {
  if (unit.empty()) return 1.0;
  const auto known = unit_in_table(unit, "s");
  if (!known) return Parsed<double>::failed(known.problem);
  return parse_as("1 " + *known, "s");
}

bool names_time(const std::string& name) {
  return is_one_of(name, {"time", "t", "times", "zeit", "temps", "tiempo", "tempo"});
}

bool names_rate(const std::string& name) {
  return is_one_of(name, {"rate", "fs", "samplerate", "samplingrate", "samplingfrequency",
                          "samplefrequency", "samplespersecond"});
}

MeasuredRecord finished(RawRecord raw, std::optional<double> rate) {
  if (raw.has_own_times) return finished_part(std::move(raw), rate);
  if (!raw.channels.empty()) name_ramp(raw, rate);
  std::optional<RawChannel> times;
  if (const auto time = time_in(raw.channels, raw.rate || rate); time != raw.channels.end()) {
    times = std::move(*time);
    raw.channels.erase(time);
  }
  std::vector<RawRecord> parts = parts_of(std::move(raw), std::move(times));
  MeasuredRecord record = finished_part(std::move(parts.front()), rate);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    std::vector<ChannelLeftOut> channels;
    for (const RawChannel& c : parts[i].channels) channels.push_back({c.name, ""});
    try {
      record.others.push_back(finished_part(std::move(parts[i]), rate));
    } catch (const ModelError& error) {
      for (ChannelLeftOut& c : channels) {
        record.left_out.push_back({c.name, error.problems().front().message});
      }
    }
  }
  return record;
}

}  // namespace whirl::inline io
