#include "libio/model/bearing_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <sstream>

#include "libio/model/table_columns.hpp"
#include "libio/text/delimited.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

namespace {

using Kind = CoefficientColumn::Kind;

/// A table while its lines are read.
struct OpenTable {
  CoefficientTable table{};
  std::vector<int> lines{};  ///< where its rows stand
  Delimiter delimiter = Delimiter::comma;
  std::vector<CoefficientColumn> columns{};

  bool has(Kind kind) const {
    return std::any_of(columns.begin(), columns.end(),
                       [&](const CoefficientColumn& c) { return c.kind == kind; });
  }
};

std::optional<double> value_of(const std::string& cell, const CoefficientColumn& column,
                               Delimiter delimiter, const ReportProblem& report) {
  const auto number = plain_number(cell, delimiter);
  if (!number) {
    report(column.name, number.problem);
    return std::nullopt;
  }
  const auto value =
      parse_as(*number + (column.unit.empty() ? "" : " " + column.unit), column.si_unit);
  if (!value) report(column.name, value.problem);
  return value.value;
}

/// Adds the row of a line.
void add_row(OpenTable& open, const std::vector<std::string>& parts, int line,
             const ReportProblem& report) {
  if (parts.size() != open.columns.size()) {
    report("", fmt::format("found {} columns, expected {} as in the first line", parts.size(),
                           open.columns.size()));
    return;
  }
  BearingCoefficients row;
  double speed = 0.0, whirl = 0.0;
  bool has_place = true;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const CoefficientColumn& column = open.columns[i];
    const auto value = value_of(parts[i], column, open.delimiter, report);
    if (!value) {
      has_place = has_place && column.kind == Kind::entry;
      continue;
    }
    if (column.kind == Kind::speed) {
      speed = *value;
    } else if (column.kind == Kind::whirl) {
      whirl = *value;
      if (whirl < 0.0) report("whirl", "a whirl frequency is zero or more, for either sense");
    } else {
      (row.*column.matrix)(column.row, column.column) = *value;
    }
  }
  if (!has_place) return;
  if (open.has(Kind::speed)) open.table.speed.push_back(speed);
  if (open.has(Kind::whirl)) open.table.whirl.push_back(whirl);
  open.table.rows.push_back(row);
  open.lines.push_back(line);
}

/// Rows of a table over both in the order of speeds, at one speed in that of frequencies.
void sort_rows(OpenTable& open) {
  const CoefficientTable& t = open.table;
  std::vector<std::size_t> order(t.rows.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(t.speed[a], t.whirl[a]) < std::pair(t.speed[b], t.whirl[b]);
  });
  CoefficientTable sorted;
  std::vector<int> lines;
  for (const std::size_t i : order) {
    sorted.speed.push_back(t.speed[i]);
    sorted.whirl.push_back(t.whirl[i]);
    sorted.rows.push_back(t.rows[i]);
    lines.push_back(open.lines[i]);
  }
  open.table = std::move(sorted);
  open.lines = std::move(lines);
}

/// Reports rows that do not ascend, of a table over one of both, or that are there twice.
void check_order(OpenTable& open, const std::function<ReportProblem(int)>& report_at) {
  const bool has_both = open.has(Kind::speed) && open.has(Kind::whirl);
  if (has_both) sort_rows(open);
  const CoefficientTable& t = open.table;
  for (std::size_t i = 1; i < t.rows.size(); ++i) {
    if (has_both) {
      if (t.speed[i] != t.speed[i - 1] || t.whirl[i] != t.whirl[i - 1]) continue;
      report_at(open.lines[i])(
          "whirl",
          fmt::format("this speed and whirl frequency are in line {} already", open.lines[i - 1]));
    } else if (!t.speed.empty() && t.speed[i] <= t.speed[i - 1]) {
      report_at(open.lines[i])("speed", "speeds must ascend from line to line");
    } else if (!t.whirl.empty() && t.whirl[i] <= t.whirl[i - 1]) {
      report_at(open.lines[i])("whirl", "whirl frequencies must ascend from line to line");
    }
  }
}

bool is_comment(const std::string& line) {
  const std::string text = trimmed(line);
  return text.empty() || text[0] == '#' || text[0] == '!' || text[0] == '%' ||
         text.starts_with("//");
}

}  // namespace

CoefficientTable parse_bearing_table(const std::string& text, const std::string& file,
                                     std::vector<Problem>& problems) {
  OpenTable open;
  const std::size_t others = problems.size();  // of other tables
  const auto report_at = [&](int number) -> ReportProblem {
    return [&problems, &file, number](std::string key, std::string message) {
      problems.push_back({{file, number, 1}, std::move(key), std::move(message)});
    };
  };
  std::istringstream lines(text);
  std::string line;
  int names = 0;  // line of the names
  bool is_below_names = true;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // spreadsheets begin so
    if (is_comment(line)) continue;
    if (names == 0) {
      names = number;
      open.delimiter = delimiter_of(line);
      open.columns = columns_named(line, open.delimiter, report_at(number));
      if (problems.size() > others) return open.table;  // what is wrong here is so in every row
      continue;
    }
    std::vector<std::string> cells = cells_of(line, open.delimiter);
    while (cells.size() > open.columns.size() && cells.back().empty()) cells.pop_back();
    if (is_below_names) {
      is_below_names = false;
      const bool has_units = is_line_of_units(cells);
      if (has_units) take_units(open.columns, cells, report_at(number));
      check_columns(open.columns, report_at(names));
      if (problems.size() > others) return open.table;
      if (has_units) continue;
    }
    add_row(open, cells, number, report_at(number));
  }
  check_order(open, report_at);
  if (open.table.rows.empty() && problems.size() == others) {
    problems.push_back({{file},
                        "",
                        "the table has no rows; expected a line of column names and one line per "
                        "speed or whirl frequency"});
  }
  return open.table;
}

}  // namespace whirl::inline io
