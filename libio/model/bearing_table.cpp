#include "libio/model/bearing_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "libio/model/table_columns.hpp"
#include "libio/text/delimited.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

namespace {

using Kind = CoefficientColumn::Kind;

/// A table while its lines are read.
struct OpenTable {
  CoefficientTable table{};
  std::vector<Where> places{};  ///< where its rows stand: the cell of the speed, or whirl frequency
  NumberMarks marks{};
  std::vector<CoefficientColumn> columns{};

  bool has(Kind kind) const {
    return std::any_of(columns.begin(), columns.end(),
                       [&](const CoefficientColumn& c) { return c.kind == kind; });
  }
};

std::optional<double> value_of(const Cell& cell, const CoefficientColumn& column,
                               const NumberMarks& marks, const ReportProblem& report) {
  const auto number = plain_number(cell.text, marks);
  if (!number) {
    report(cell.place, column.name, number.problem);
    return std::nullopt;
  }
  const auto value =
      parse_as(*number + (column.unit.empty() ? "" : " " + column.unit), column.si_unit);
  if (!value) report(cell.place, column.name, value.problem);
  return value.value;
}

/// Adds the row of a line.
void add_row(OpenTable& open, const std::vector<Cell>& cells, Where where,
             const ReportProblem& report) {
  BearingCoefficients row;
  double speed = 0.0, whirl = 0.0;
  bool has_place = true;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const CoefficientColumn& column = open.columns[i];
    if (column.is_remark) continue;
    const auto value = value_of(cells[i], column, open.marks, report);
    if (!value) {
      has_place = has_place && column.kind == Kind::entry;
      continue;
    }
    if (column.kind == Kind::speed) {
      speed = *value;
      where.column = cells[i].place;
      if (speed < 0.0) report(cells[i].place, "speed", "a speed is zero or more");
    } else if (column.kind == Kind::whirl) {
      whirl = *value;
      if (!open.has(Kind::speed)) where.column = cells[i].place;
      if (whirl < 0.0) {
        report(cells[i].place, "whirl", "a whirl frequency is zero or more, for either sense");
      }
    } else {
      (row.*column.matrix)(column.row, column.column) = *value;
    }
  }
  if (!has_place) return;
  if (open.has(Kind::speed)) open.table.speed.push_back(speed);
  if (open.has(Kind::whirl)) open.table.whirl.push_back(whirl);
  open.table.rows.push_back(row);
  open.places.push_back(where);
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
  std::vector<Where> places;
  for (const std::size_t i : order) {
    sorted.speed.push_back(t.speed[i]);
    sorted.whirl.push_back(t.whirl[i]);
    sorted.rows.push_back(t.rows[i]);
    places.push_back(open.places[i]);
  }
  open.table = std::move(sorted);
  open.places = std::move(places);
}

/// Reports rows that do not ascend, of a table over one of both, or that are there twice.
void check_order(OpenTable& open, std::vector<Problem>& problems) {
  const bool has_both = open.has(Kind::speed) && open.has(Kind::whirl);
  if (has_both) sort_rows(open);
  const CoefficientTable& t = open.table;
  for (std::size_t i = 1; i < t.rows.size(); ++i) {
    const Where& where = open.places[i];
    if (has_both) {
      if (t.speed[i] != t.speed[i - 1] || t.whirl[i] != t.whirl[i - 1]) continue;
      problems.push_back({where, "whirl",
                          fmt::format("this speed and whirl frequency are in line {} already",
                                      open.places[i - 1].line)});
    } else if (!t.speed.empty() && t.speed[i] <= t.speed[i - 1]) {
      problems.push_back({where, "speed", "speeds must ascend from line to line"});
    } else if (!t.whirl.empty() && t.whirl[i] <= t.whirl[i - 1]) {
      problems.push_back({where, "whirl", "whirl frequencies must ascend from line to line"});
    }
  }
}

/// Lines below the names as cells, and what the marks in their numbers say.
std::vector<TableRow> rows_of_numbers(OpenTable& open, const std::vector<TableLine>& lines) {
  std::vector<TableRow> rows = table_rows(lines, open.marks.delimiter, open.columns.size());
  for (const TableRow& row : rows) {
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      const bool is_number = i >= open.columns.size() || !open.columns[i].is_remark;
      if (is_number) open.marks.add(row.cells[i].text);
    }
  }
  return rows;
}

}  // namespace

CoefficientTable parse_bearing_table(const std::string& text, const std::string& file,
                                     std::vector<Problem>& problems, std::vector<Problem>* doubts) {
  OpenTable open;
  const std::size_t others = problems.size();  // of other tables
  const auto report_to = [&](std::vector<Problem>& to, const TableLine& line) -> ReportProblem {
    return [&to, &file, &line](int place, std::string key, std::string message) {
      to.push_back({{file, line.number, place + line.skipped}, std::move(key), std::move(message)});
    };
  };
  const std::vector<TableLine> lines = table_lines(text, coefficients_named_in);
  if (!lines.empty()) {
    const ReportProblem report = report_to(problems, lines[0]);
    open.marks.delimiter = delimiter_of(lines[0].text);
    open.columns = columns_named(lines[0].text, open.marks.delimiter, report);
    if (problems.size() > others) return open.table;  // what is wrong here is so in every row
    std::vector<TableRow> rows = rows_of_numbers(open, lines);
    if (!rows.empty()) {
      const bool has_units = is_line_of_units(rows[0].cells);
      if (has_units) take_units(open.columns, rows[0].cells, report_to(problems, *rows[0].line));
      check_columns(open.columns, report);
      if (problems.size() > others) return open.table;
      if (has_units) rows.erase(rows.begin());
    }
    for (const auto& [line, cells] : rows) {
      const ReportProblem report_row = report_to(problems, *line);
      if (cells.size() == open.columns.size()) {
        add_row(open, cells, {file, line->number, 1}, report_row);
      } else {
        report_count(cells, open.columns.size(), open.marks.delimiter, report_row);
      }
    }
    check_order(open, problems);
    if (doubts) doubt_columns(open.columns, report_to(*doubts, lines[0]));
  }
  if (open.table.rows.empty() && problems.size() == others) {
    problems.push_back({{file},
                        "",
                        "the table has no rows; expected a line of column names and one line per "
                        "speed or whirl frequency"});
  }
  tell_once(problems, others);
  return open.table;
}

}  // namespace whirl::inline io
