#pragma once
/// What stands above the numbers of a table: names and units of channels, and a rate.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "libio/text/delimited.hpp"

namespace whirl::inline io {

/// A line of a table.
struct CsvLine {
  int number = 0;  ///< in the file, from 1
  std::string_view text;
};

/// Lines of a text that are not blank.
std::vector<CsvLine> csv_lines(std::string_view text);

/// In the order in which they are tried: commas may be decimal ones.
inline constexpr std::array csv_delimiters{Delimiter::semicolon, Delimiter::tab, Delimiter::bar,
                                           Delimiter::comma, Delimiter::blanks};

struct CsvHeader {
  std::vector<std::string> names, units;  ///< of channels; "": the header says none
  bool has_names = false;                 ///< else all names are empty
};

/// Reads the lines above the numbers: the last line with a cell per channel names the channels, and
/// a line below it with units alone says their units. Settings are passed over.
///
/// @param count              of channels
/// @param may_have_one_more  words behind the numbers may have a name, too
CsvHeader csv_header(const std::vector<CsvLine>& lines, std::size_t count, bool may_have_one_more);

}  // namespace whirl::inline io
