#pragma once
/// What formats of records have in common: channels as they stand in a file become a record.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libbase/structs/travel.hpp"
#include "libdata/measured/measured_record.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

/// A channel as it stands in a file.
struct RawChannel {
  std::string name;    ///< empty: none in the file; it becomes the channel's number
  std::string unit{};  ///< as it is written
  std::vector<double> samples;
  Where where{};               ///< for messages
  std::optional<int> clock{};  ///< which of the record's clocks its samples go by; none: its own
  std::string path{};          ///< with the names of groups that it is in, where a name may do
};

/// Times that some channels of a file have, and others have not.
struct RawClock {
  std::optional<double> rate{};  ///< where the file says it [1/s]
  double start = 0.0;            ///< [s]
  RawChannel times{};            ///< of each sample, in its unit; none: rate and start say them
};

struct RawRecord {
  std::string file;
  std::vector<RawChannel> channels;
  std::optional<double> rate{};      ///< where the file says it [1/s]
  double start = 0.0;                ///< [s]
  bool has_own_times = false;        ///< the format says times itself: no channel is one of times
  std::vector<std::string> notes{};  ///< what was taken for granted, in words
  double rate_within = 0.0;          ///< share of the rate that its digits leave open
  std::string no_rate_because{};     ///< where the file seems to say a rate and does not
  std::vector<RawClock> clocks{};
  std::vector<ChannelLeftOut> left_out{};
};

template <class Bytes>
void travel(Bytes& bytes, Is<RawChannel> auto& channel) {
  auto& [name, unit, samples, where, clock, path] = channel;
  bytes(name, unit, samples, where, clock, path);
}

template <class Bytes>
void travel(Bytes& bytes, Is<RawClock> auto& clock) {
  auto& [rate, start, times] = clock;
  bytes(rate, start, times);
}

template <class Bytes>
void travel(Bytes& bytes, Is<ChannelLeftOut> auto& channel) {
  auto& [name, why] = channel;
  bytes(name, why);
}

template <class Bytes>
void travel(Bytes& bytes, Is<RawRecord> auto& record) {
  auto& [file, channels, rate, start, has_own_times, notes, within, because, clocks, left_out] =
      record;
  bytes(file, channels, rate, start, has_own_times, notes, within, because, clocks, left_out);
}

/// Nobody records vibrations with longer steps [s].
constexpr double longest_step = 0.1;
/// Share of a step that times may be off.
constexpr double even_to = 0.1;

/// Samples that a measurement has at least: shorter vectors of a file are something else.
constexpr std::size_t fewest_samples = 16;

/// Makes a record: lengths in m, voltages in V. Without a rate, the channel named time, or t, or
/// else the first channel in a unit of time says it; the steps of that channel must be even to a
/// tenth. Where its times jump by several steps, the samples between are NaN.
///
/// Channels of other lengths or clocks are others of the record, which has those that are as long
/// as its times, or where there are none most channels.
///
/// @param rate  for files that say neither a rate nor times, or with more digits than the file has;
///              nothing: not known [1/s]
/// @throws ModelError  for a rate that is not that of the file or of its times, for times that do
///                     not ascend evenly or have no channel as long as they are, without any
///                     channel, or where nothing says the rate
MeasuredRecord finished(RawRecord raw, std::optional<double> rate);

/// Seconds of a unit of time; 1 of none.
Parsed<double> seconds_in(const std::string& unit);

/// Whether each number is larger than the one before.
bool ascends(const std::vector<double>& samples);

/// Whether a name is that of times.
bool names_time(const std::string& name);
/// Whether a name is that of a number of samples per second.
bool names_rate(const std::string& name);

}  // namespace whirl::inline io
