#pragma once
/// Lines of tables that other programs write: what stands between commas, semicolons, tabs or
/// blanks.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "libio/text/units.hpp"

namespace whirl::inline io {

/// Reports a problem of a line of a table: the column's name, and what is wrong.
using ReportProblem = std::function<void(std::string, std::string)>;

enum class Delimiter { comma, semicolon, tab, blanks };

/// The delimiter of a line of names, outside of brackets and quotes: the first of semicolon, comma
/// and tab that is there, else blanks.
Delimiter delimiter_of(std::string_view line);

/// Cells of a line without blanks and quotes around them.
/// Delimiters in quotes, (...) and [...] do not count. Where commas delimit, semicolons do, too.
std::vector<std::string> cells_of(std::string_view line, Delimiter delimiter);

/// A number as parse_quantity reads it: decimal commas become points where commas do not delimit,
/// "1.2D+6" becomes "1.2E+6". A unit behind the number stays.
///
/// @return  or what is wrong: in tables with tabs or blanks nobody knows what "1,000" is
Parsed<std::string> plain_number(std::string_view cell, Delimiter delimiter);

/// Text without blanks and quotes around it.
std::string trimmed(std::string_view text);

}  // namespace whirl::inline io
