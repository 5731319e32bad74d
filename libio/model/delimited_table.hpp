#pragma once
/// Tables as spreadsheets save them: a line of column names with units in brackets, then rows.

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "libbase/error.hpp"
#include "libbase/structs/field.hpp"

namespace whirl::inline io {

/// A column that a table may have. Other names of it are in column_names.hpp.
struct ColumnKind {
  std::string name;
  std::string unit{};           ///< SI unit of its numbers; empty: numbers without one
  Range range = Range::any;     ///< of its numbers
  bool is_text = false;         ///< words, no numbers
  std::string unit_problem{};   ///< what is wrong if words have a unit
  bool must_be_filled = false;  ///< an empty cell is a problem
  /// Under another name it needs a unit: programs that write that name do not mean SI.
  bool others_need_unit = false;
  /// Of words that are numbers with units of their own: a unit of the column stands behind each.
  bool keeps_unit = false;
};

/// A line of a table. A cell that is empty or wrong is left out.
struct DelimitedRow {
  int line = 0;                                        ///< in the file, from 1
  std::map<std::string, double, std::less<>> numbers;  ///< by the columns' names [SI]
  std::map<std::string, std::string, std::less<>> texts;
  std::map<std::string, int, std::less<>> places;  ///< of all cells in the line, from 1

  std::optional<double> number(std::string_view column) const;
  /// Words of a column; empty: none.
  std::string text(std::string_view column) const;
  /// Where the cell of a column is in the line; 1: there is no such column.
  int place(std::string_view column) const;
};

struct DelimitedTable {
  int header = 0;                    ///< line of the column names; 0: there is none
  std::vector<std::string> columns;  ///< names of those that are there; of those not read empty
  std::vector<int> places;           ///< of their names in that line, from 1
  std::vector<DelimitedRow> rows;

  bool has(std::string_view column) const;
};

/// Reads a table. Comments (#, !, %, //) and lines without anything in their cells are left out.
///
/// Capitals, accents, blanks, "_", "-" and "." in column names do not count: "O.D. left [mm]" is
/// outer_left in mm. Units stand in [...] or (...), behind a blank, or in a line of their own below
/// the names. Without a unit numbers are SI; a number may have a unit of its own. Commas,
/// semicolons, tabs or blanks delimit; where commas do not, decimals may have them. See table_lines
/// for titles above and names in a comment, table_rows for what is beside and below.
///
/// @param file      for messages
/// @param kinds     columns that are known
/// @param problems  receives what is wrong, with its place; a problem of many rows only once
/// @param doubts    receives the columns that are not known and not read; null: not wanted
DelimitedTable parse_delimited(const std::string& text, const std::string& file,
                               const std::vector<ColumnKind>& kinds, std::vector<Problem>& problems,
                               std::vector<Problem>* doubts = nullptr);

/// How many known columns a line names.
std::size_t columns_named_in(const std::string& line, const std::vector<ColumnKind>& kinds);

}  // namespace whirl::inline io
