#pragma once
/// Lines of tables that other programs write: what stands between commas, semicolons, tabs or
/// blanks.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "libbase/error.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

/// Reports a problem of a line of a table: where in the line (characters, from 1), the name of the
/// column, and what is wrong.
using ReportProblem = std::function<void(int, std::string, std::string)>;

enum class Delimiter { comma, semicolon, tab, bar, blanks, cell };

/// What stands between the cells of a line that comes from a sheet of a workbook (Delimiter::cell):
/// the unit separator of ASCII, which no cell has. Quotes and brackets mean nothing there.
constexpr char cell_mark = '\x1F';

/// What stands between two delimiters, without blanks and quotes around it.
struct Cell {
  std::string text;
  int place = 1;  ///< in the line, in characters, from 1; of a sheet the number of its column
};

/// A line of a table with something in it.
struct TableLine {
  int number = 0;  ///< in the file, from 1
  std::string text;
  int skipped = 0;  ///< characters before the text, which are the mark of a comment
};

/// Lines of a table that are no comments (#, !, %, //) and not empty, the names of columns first.
///
/// Titles above the names are left out: the names are the line that names most columns, two or more
/// of them, before the first line of numbers. Some programs write the names as a comment: the
/// comment right above the first line stands for the names if it has two known names or more, and
/// the first line is one of numbers.
///
/// @param known_names  how many columns a line names
std::vector<TableLine> table_lines(
    const std::string& text, const std::function<std::size_t(const std::string&)>& known_names);

/// The delimiter of a line of names, outside of brackets and quotes: the first of semicolon, comma
/// and tab that is there, else blanks.
Delimiter delimiter_of(std::string_view line);

/// Cells of a line.
/// Delimiters in quotes, (...) and [...] do not count. Where commas delimit, semicolons do, too.
std::vector<Cell> cells_of(std::string_view line, Delimiter delimiter);

/// A line below the names.
struct TableRow {
  const TableLine* line = nullptr;
  std::vector<Cell> cells;
};

/// The lines below the names as cells, without what people wrote beside and below: words behind the
/// last column, lines of words and of totals below the last row; and without lines that repeat the
/// names.
/// @param lines  as table_lines gives them, the names first
std::vector<TableRow> table_rows(const std::vector<TableLine>& lines, Delimiter delimiter,
                                 std::size_t columns);

/// Reports a line of more or fewer cells than there are columns.
void report_count(const std::vector<Cell>& cells, std::size_t columns, Delimiter delimiter,
                  const ReportProblem& report);

/// What the commas and points in the numbers of a table say together.
struct NumberMarks {
  Delimiter delimiter = Delimiter::comma;
  bool has_decimal_commas = false;  ///< "0,5": one that cannot be a comma of thousands
  bool has_decimal_points = false;  ///< "0.5" likewise

  /// Takes a number of the table into account.
  /// @return  its comma or point, if that may be one of thousands or of decimals; else 0
  char add(std::string_view cell);
};

/// A number as parse_quantity reads it: decimal commas become points where commas do not delimit,
/// "1.2D+6" becomes "1.2E+6". A unit behind the number stays.
///
/// @return  or what is wrong: "410,000" is a decimal comma only where other numbers of the table
///          have commas that can be nothing else, and "410.000" is a doubtful point there
Parsed<std::string> plain_number(std::string_view cell, const NumberMarks& marks);

/// Whether a text begins as numbers do.
bool begins_as_number(std::string_view text);

/// Whether a line has units of columns and nothing else; no number begins with what a unit does.
bool is_line_of_units(const std::vector<Cell>& cells);

/// Text without blanks and quotes around it.
std::string trimmed(std::string_view text);

/// A name in lower case, without accents and what stands between its words (blanks, "_", "-", ".").
std::string plain_name(std::string_view name);

/// What a cell of a line of names says.
struct NameAndUnit {
  std::string name, unit;
  bool has_unit = false;
};

/// Takes a unit in brackets off a cell; a unit behind a comma, a blank, "_", "/" or "in" ("t / s",
/// "time in s") only if the whole cell is no known name.
/// @param is_known  whether a column has a name with a unit; empty unit: a name without one
NameAndUnit name_and_unit(
    const std::string& cell,
    const std::function<bool(const std::string&, const std::string&)>& is_known);

/// Tells problems of one cause once: of problems from `first` on that differ only by their lines
/// and numbers, the first one stays and says how many more rows have it.
void tell_once(std::vector<Problem>& problems, std::size_t first);

}  // namespace whirl::inline io
