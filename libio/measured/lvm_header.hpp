#pragma once
/// Headers of LabVIEW measurement files: what is said of a file, and of each segment of its data.

#include <string>
#include <string_view>
#include <vector>

#include "libio/measured/csv_header.hpp"

namespace whirl::inline io {

/// How a file is written.
struct LvmForm {
  enum class XColumns { none, one, each };
  char separator = '\t';
  char decimal = '\0';  ///< of numbers; 0: the file does not say it
  XColumns x = XColumns::one;
};

/// What a segment says of a channel, as it is written; "": nothing.
struct LvmChannel {
  std::string_view name;
  std::size_t column = 0;    ///< of its samples
  std::size_t x_column = 0;  ///< of its times, if it has them
  std::string_view samples{}, date{}, time{}, unit{}, dimension{}, x_unit{}, x0{}, delta{};
};

/// Data below one header.
struct LvmSegment {
  int line = 0;  ///< of its first line
  std::vector<LvmChannel> channels;
  std::vector<CsvLine> rows;  ///< of numbers; a blank line may be one of samples that are missing
};

struct LvmFile {
  LvmForm form;
  std::vector<LvmSegment> segments;
};

/// Whether a text is one of a LabVIEW measurement file.
bool is_lvm(std::string_view text);

/// Cells of a line, without blanks around them.
std::vector<std::string_view> lvm_cells(std::string_view line, char separator);

/// Reads the headers of a file, and which lines are those of samples.
///
/// @param text  stays where it is: what is found are parts of it
/// @param file  for messages
/// @throws ModelError  for a header that does not end, for a segment without channels or with other
///                     columns than channels, for a separator that numbers have, too
/// @source National Instruments, Specification for the LabVIEW Measurement File, version 2
LvmFile lvm_file(std::string_view text, const std::string& file);

}  // namespace whirl::inline io
