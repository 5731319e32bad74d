#pragma once
/// The bytes of TDMS files of National Instruments: segments of metadata and samples.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace whirl::inline io {

/// The value of a property.
struct TdmsValue {
  enum class Kind { number, text, time };
  Kind kind = Kind::number;
  double number = 0.0;       ///< of a time the part of a second behind `seconds` [s]
  std::int64_t seconds = 0;  ///< since 1904-01-01 0:00 UTC [s]
  std::string text{};
};

using TdmsProperties = std::map<std::string, TdmsValue>;

/// The number of a property; nothing: there is none of that name.
std::optional<double> number_in(const TdmsProperties& properties, const std::string& name);
/// The text of a property; empty: there is none of that name.
std::string text_in(const TdmsProperties& properties, const std::string& name);

/// The file, a group, or a channel.
struct TdmsObject {
  std::vector<std::string> names;  ///< none: the file; its group; its channel
  TdmsProperties properties{};     ///< of times, units and scales; of others nothing
  std::vector<double> samples{};   ///< as they stand in the file; of times since the first one [s]
  bool is_time = false;            ///< samples are times
  std::string no_samples{};        ///< why a channel with data has no samples, in words
};

struct TdmsFile {
  std::vector<TdmsObject> objects;  ///< in the order in which they come
  std::vector<std::string> notes;   ///< what is not whole, in words
};

/// Reads a file. Of a last segment that is not whole, as of a run that was killed, the samples are
/// taken that all of its channels have, with a note.
///
/// @param bytes  of the whole file
/// @param file   for messages
/// @throws ModelError  for what is no TDMS file, for raw data of DAQmx, for channels whose samples
///                     are of an unknown size, and for a damaged file
/// @source National Instruments, TDMS File Format Internal Structure
TdmsFile tdms_file(std::string_view bytes, const std::string& file);

}  // namespace whirl::inline io
