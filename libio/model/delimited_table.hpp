#pragma once
/// Tables as spreadsheets save them: a line of column names with units in brackets, then rows.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "libbase/error.hpp"
#include "libbase/structs/field.hpp"

namespace whirl::inline io {

/// A column that a table may have.
struct ColumnKind {
  std::string name;
  std::string unit{};                   ///< SI unit of its numbers; empty: numbers without one
  Range range = Range::any;             ///< of its numbers
  bool is_text = false;                 ///< words, no numbers
  std::vector<std::string> synonyms{};  ///< other names of it, as plain_name has them
  std::string problem{};                ///< what is wrong if it is there; empty: nothing
  std::string unit_problem{};           ///< what is wrong if words have a unit
};

/// A line of a table. A cell that is empty or wrong is left out.
struct DelimitedRow {
  int line = 0;                                        ///< in the file, from 1
  std::map<std::string, double, std::less<>> numbers;  ///< by the columns' names [SI]
  std::map<std::string, std::string, std::less<>> texts;
  std::map<std::string, int, std::less<>> places;  ///< of all cells in the line, from 1

  std::optional<double> number(std::string_view column) const;
  /// Where the cell of a column is in the line; 1: there is no such column.
  int place(std::string_view column) const;
};

struct DelimitedTable {
  int header = 0;                    ///< line of the column names; 0: there is none
  std::vector<std::string> columns;  ///< names of those that are there
  std::vector<DelimitedRow> rows;

  bool has(std::string_view column) const;
};

/// Reads a table. Comments (#, !, %, //) and lines without anything in their cells are left out.
///
/// Capitals, blanks, "_", "-" and "." in column names do not count: "O.D. left [mm]" is od_left in
/// mm. Units stand in [...] or (...), behind a blank, or in a line of their own below the names.
/// Without a unit numbers are SI; a number may have a unit of its own. Commas, semicolons or tabs
/// delimit; where commas do not, decimals may have them. See table_lines for names in a comment.
///
/// @param file      for messages
/// @param kinds     columns that are known
/// @param problems  receives what is wrong, with its place; a problem of many rows only once
DelimitedTable parse_delimited(const std::string& text, const std::string& file,
                               const std::vector<ColumnKind>& kinds,
                               std::vector<Problem>& problems);

}  // namespace whirl::inline io
