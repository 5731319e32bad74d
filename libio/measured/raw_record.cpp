#include "libio/measured/raw_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "libio/measured/channel_unit.hpp"
#include "libio/text/delimited.hpp"

namespace whirl::inline io {

namespace {

constexpr double same_rate = 1e-4;  ///< to which --rate gives that of a file more digits

/// Takes rate and start from a channel of times.
void take_times(RawRecord& raw, const RawChannel& time) {
  double factor = 1.0;
  if (!time.unit.empty()) {
    const auto second = parse_as("1 " + time.unit, "s");
    if (!second) throw ModelError(time.where, time.name, second.problem);
    factor = *second;
  }
  const std::vector<double>& t = time.samples;
  const std::size_t n = t.size();
  if (n < 2) throw ModelError(time.where, time.name, "expected two times or more");
  const double step = (t.back() - t.front()) / static_cast<double>(n - 1);
  if (!(step > 0.0)) {
    throw ModelError(
        time.where, time.name,
        fmt::format("goes from {} to {}, expected times that ascend", t.front(), t.back()));
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double expected = t.front() + step * static_cast<double>(i);
    if (std::abs(t[i] - expected) <= even_to * step) continue;
    throw ModelError(time.where, time.name,
                     fmt::format("sample {} is at {}, expected {:.9g}: steps must be even, write "
                                 "missing samples as empty cells or nan",
                                 i + 1, t[i], expected));
  }
  // a rate that the file says has more digits than its times
  if (!raw.rate) raw.rate = 1.0 / (factor * step);
  raw.start = factor * t.front();
}

bool is_one_of(const std::string& name, std::initializer_list<std::string_view> known) {
  return std::find(known.begin(), known.end(), plain_name(name)) != known.end();
}

}  // namespace

bool names_time(const std::string& name) {
  return is_one_of(name, {"time", "t", "times"});
}

bool names_rate(const std::string& name) {
  return is_one_of(name, {"rate", "fs", "samplerate", "samplingrate", "samplingfrequency",
                          "samplefrequency", "samplespersecond"});
}

MeasuredRecord finished(RawRecord raw, std::optional<double> rate) {
  const auto time = std::find_if(raw.channels.begin(), raw.channels.end(),
                                 [](const RawChannel& c) { return names_time(c.name); });
  if (time != raw.channels.end() && !raw.has_own_times) {
    const RawChannel times = std::move(*time);
    raw.channels.erase(time);
    take_times(raw, times);
  }
  const Where where{raw.file};
  if (raw.rate && rate) {
    if (!(std::abs(*raw.rate / *rate - 1.0) <= same_rate)) {
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
        "does not say how many samples a second has: expected a column \"time [s]\" or "
        "a sample rate; --rate says it, too");
  }
  if (!(*raw.rate > 0.0) || !std::isfinite(*raw.rate)) {
    throw ModelError(where, "", fmt::format("says a sample rate of {} 1/s", *raw.rate));
  }
  MeasuredRecord record{.rate = *raw.rate, .start = raw.start};
  const std::size_t n = raw.channels.front().samples.size();
  record.samples.resize(static_cast<Eigen::Index>(n), std::ssize(raw.channels));
  for (std::size_t i = 0; i < raw.channels.size(); ++i) {
    const RawChannel& channel = raw.channels[i];
    if (channel.samples.size() != n) {
      throw ModelError(channel.where, channel.name,
                       fmt::format("has {} samples, expected {} as of {}", channel.samples.size(),
                                   n, raw.channels.front().name));
    }
    const ChannelUnit unit = channel_unit(channel.unit);
    record.channels.push_back({channel.name, unit.name});
    record.samples.col(static_cast<Eigen::Index>(i)) =
        unit.factor * Eigen::Map<const Vec>(channel.samples.data(), static_cast<Eigen::Index>(n));
  }
  return record;
}

}  // namespace whirl::inline io
