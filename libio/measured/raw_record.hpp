#pragma once
/// What formats of records have in common: channels as they stand in a file become a record.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libbase/structs/travel.hpp"
#include "libdata/measured/measured_record.hpp"

namespace whirl::inline io {

/// A channel as it stands in a file.
struct RawChannel {
  std::string name;    ///< empty: none in the file; it becomes the channel's number
  std::string unit{};  ///< as it is written
  std::vector<double> samples;
  Where where{};  ///< for messages
};

struct RawRecord {
  std::string file;
  std::vector<RawChannel> channels;
  std::optional<double> rate{};      ///< where the file says it [1/s]
  double start = 0.0;                ///< [s]
  bool has_own_times = false;        ///< the format says times itself: no channel is one of times
  std::vector<std::string> notes{};  ///< what was taken for granted, in words
};

template <class Bytes>
void travel(Bytes& bytes, Is<RawChannel> auto& channel) {
  auto& [name, unit, samples, where] = channel;
  bytes(name, unit, samples, where);
}

template <class Bytes>
void travel(Bytes& bytes, Is<RawRecord> auto& record) {
  auto& [file, channels, rate, start, has_own_times, notes] = record;
  bytes(file, channels, rate, start, has_own_times, notes);
}

/// Share of a step that times may be off.
constexpr double even_to = 0.1;

/// Makes a record of channels of equal length: lengths in m, voltages in V. Without a rate, the
/// channel named time, or t, or else the first channel in a unit of time says it; the steps of that
/// channel must be even to a tenth. Where its times jump by several steps, the samples between are
/// NaN.
///
/// @param rate  for files that say neither a rate nor times, or with more digits than the file has;
///              nothing: not known [1/s]
/// @throws ModelError  for a rate that is not that of the file, for times that do not ascend
///                     evenly, for channels of different lengths, without any, or where nothing
///                     says the rate
MeasuredRecord finished(RawRecord raw, std::optional<double> rate);

/// Whether a name is that of times.
bool names_time(const std::string& name);
/// Whether a name is that of a number of samples per second.
bool names_rate(const std::string& name);

}  // namespace whirl::inline io
