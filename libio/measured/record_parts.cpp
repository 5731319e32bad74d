#include "libio/measured/record_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace whirl::inline io {

namespace {

constexpr std::size_t most_parts = 64;  ///< that are read; each names the channels of all others

/// What channels have that go together: number of the clock (-1: the record's), and samples.
using PartKey = std::pair<int, std::size_t>;

PartKey key_of(const RawChannel& c) {
  return {c.clock.value_or(-1), c.samples.size()};
}

/// "calibration (5), T (1000)": names and lengths of channels, of many the first ones.
std::string list_of(const std::vector<const RawChannel*>& channels) {
  constexpr std::size_t most_named = 12;
  std::string text;
  for (std::size_t i = 0; i < std::min(channels.size(), most_named); ++i) {
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", channels[i]->name,
                        channels[i]->samples.size());
  }
  if (channels.size() > most_named) {
    text += fmt::format(" and {} more", channels.size() - most_named);
  }
  return text;
}

/// Tells which channels a part has not: of another length, or of other times.
void note_others(RawRecord& part, const PartKey& key, const std::vector<RawChannel>& all) {
  std::vector<const RawChannel*> shorter_or_longer, of_other_times;
  for (const RawChannel& c : all) {
    if (key_of(c) == key) continue;
    (c.samples.size() == key.second ? of_other_times : shorter_or_longer).push_back(&c);
  }
  if (!shorter_or_longer.empty()) {
    part.notes.push_back(
        fmt::format("not as long as the {} samples of the record, and left out: {}", key.second,
                    list_of(shorter_or_longer)));
  }
  if (!of_other_times.empty()) {
    part.notes.push_back(
        fmt::format("at other times than the {} samples of the record, and left "
                    "out: {}",
                    key.second, list_of(of_other_times)));
  }
}

/// What the parts of a record share, without channels.
RawRecord head_of(const RawRecord& raw, int clock) {
  RawRecord part{.file = raw.file,
                 .rate = raw.rate,
                 .start = raw.start,
                 .has_own_times = raw.has_own_times,
                 .notes = raw.notes,
                 .rate_within = raw.rate_within,
                 .no_rate_because = raw.no_rate_because,
                 .left_out = raw.left_out};
  if (clock < 0) return part;
  const RawClock& own = raw.clocks[static_cast<std::size_t>(clock)];
  part.rate = own.rate;
  part.start = own.start;
  part.has_own_times = own.times.samples.empty();
  part.rate_within = 0.0;
  if (!part.has_own_times) part.channels.push_back(own.times);
  return part;
}

/// Keys of parts, that of the record first.
std::vector<PartKey> in_order(const std::map<PartKey, std::size_t>& counts,
                              std::size_t time_samples) {
  std::vector<PartKey> keys;
  for (const auto& [key, count] : counts) keys.push_back(key);
  const auto rank = [&](const PartKey& key) {
    const bool has_times = time_samples > 0 && key == PartKey{-1, time_samples};
    return std::tuple(!has_times, -static_cast<std::ptrdiff_t>(counts.at(key)),
                      -static_cast<std::ptrdiff_t>(key.second));
  };
  std::stable_sort(keys.begin(), keys.end(),
                   [&](const PartKey& a, const PartKey& b) { return rank(a) < rank(b); });
  return keys;
}

}  // namespace

std::vector<RawRecord> parts_of(RawRecord raw, std::optional<RawChannel> times) {
  const auto goes_by_record = [](const RawChannel& c) { return !c.clock; };
  const bool have_clocks = !std::all_of(raw.channels.begin(), raw.channels.end(), goes_by_record);
  const auto is_timed = [&](const RawChannel& c) {
    return goes_by_record(c) && times && c.samples.size() == times->samples.size();
  };
  if (times && !raw.channels.empty() &&
      std::none_of(raw.channels.begin(), raw.channels.end(), is_timed)) {
    if (!have_clocks) {
      const RawChannel& other = raw.channels.front();
      throw ModelError(times->where, times->name,
                       fmt::format("has {} times, and no channel has as many samples: {} has {}",
                                   times->samples.size(), other.name, other.samples.size()));
    }
    raw.left_out.push_back({times->name, "the other channels say their rate themselves"});
    times.reset();
  }
  const std::size_t time_samples = times ? times->samples.size() : 0;
  std::map<PartKey, std::size_t> counts;
  for (const RawChannel& c : raw.channels) {
    if (c.samples.size() >= fewest_samples || is_timed(c)) ++counts[key_of(c)];
  }
  // channels of a few samples, all of one clock: whether they are as long is told later
  const bool is_one = counts.empty() && !have_clocks;
  if (is_one) {
    if (times) raw.channels.push_back(std::move(*times));
    return {std::move(raw)};
  }
  if (counts.empty()) ++counts[key_of(raw.channels.front())];
  std::vector<PartKey> keys = in_order(counts, time_samples);
  if (keys.size() > most_parts) keys.resize(most_parts);
  std::map<PartKey, std::size_t> numbers;
  std::vector<RawRecord> parts;
  for (const PartKey& key : keys) {
    numbers[key] = parts.size();
    parts.push_back(head_of(raw, key.first));
    note_others(parts.back(), key, raw.channels);
  }
  for (RawChannel& c : raw.channels) {
    const auto number = numbers.find(key_of(c));
    if (number == numbers.end()) continue;
    c.clock.reset();
    parts[number->second].channels.push_back(std::move(c));
  }
  if (times) parts.front().channels.push_back(std::move(*times));
  return parts;
}

}  // namespace whirl::inline io
