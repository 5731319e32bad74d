#include "libio/model/delimited_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "libio/model/named_columns.hpp"
#include "libio/text/delimited.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

std::optional<double> DelimitedRow::number(std::string_view column) const {
  const auto found = numbers.find(column);
  return found == numbers.end() ? std::nullopt : std::optional(found->second);
}

std::string DelimitedRow::text(std::string_view column) const {
  const auto found = texts.find(column);
  return found == texts.end() ? "" : found->second;
}

int DelimitedRow::place(std::string_view column) const {
  const auto found = places.find(column);
  return found == places.end() ? 1 : found->second;
}

bool DelimitedTable::has(std::string_view column) const {
  return std::find(columns.begin(), columns.end(), column) != columns.end();
}

namespace {

/// Reads a cell of a column that is known.
void read_cell(const NamedColumn& column, const Cell& cell, const NumberMarks& marks,
               DelimitedRow& row, const ReportProblem& report) {
  const ColumnKind& kind = *column.kind;
  if (cell.text.empty()) {
    if (kind.must_be_filled) {
      report(cell.place, kind.name,
             fmt::format("missing, expected {}", expected_quantity(kind.unit)));
    }
    return;
  }
  if (kind.is_text) {
    const auto number =
        kind.keeps_unit ? plain_number(cell.text, marks) : Parsed<std::string>::failed("words");
    const bool has_unit = number && !column.unit.empty();
    row.texts[kind.name] = (number ? *number : cell.text) + (has_unit ? " " + column.unit : "");
    return;
  }
  const auto number = plain_number(cell.text, marks);
  if (!number) return report(cell.place, kind.name, number.problem);
  const auto value = parse_as(*number + (column.unit.empty() ? "" : " " + column.unit), kind.unit);
  const auto beyond = [&](const char* range) {
    report(cell.place, kind.name,
           fmt::format("found {}, expected {} {}", in_quotes(cell.text),
                       expected_quantity(kind.unit), range));
  };
  if (!value) {
    report(cell.place, kind.name, value.problem);
  } else if (kind.range == Range::positive && !(*value > 0.0)) {
    beyond("above zero");
  } else if (kind.range == Range::nonnegative && !(*value >= 0.0)) {
    beyond("of zero or more");
  } else {
    row.numbers[kind.name] = *value;
  }
}

/// What the marks in all numbers say.
NumberMarks marks_in(const std::vector<TableRow>& rows, const std::vector<NamedColumn>& columns,
                     Delimiter delimiter) {
  NumberMarks marks{delimiter};
  for (const TableRow& row : rows) {
    for (std::size_t i = 0; i < std::min(columns.size(), row.cells.size()); ++i) {
      if (columns[i].kind && !columns[i].kind->is_text) marks.add(row.cells[i].text);
    }
  }
  return marks;
}

}  // namespace

DelimitedTable parse_delimited(const std::string& text, const std::string& file,
                               const std::vector<ColumnKind>& kinds, std::vector<Problem>& problems,
                               std::vector<Problem>* doubts) {
  DelimitedTable table;
  const std::size_t before = problems.size();
  const auto report_to = [&file](std::vector<Problem>& to, const TableLine& line) -> ReportProblem {
    return [&to, &file, number = line.number, skipped = line.skipped](int place, std::string key,
                                                                      std::string message) {
      to.push_back({{file, number, place + skipped}, std::move(key), std::move(message)});
    };
  };
  const std::vector<TableLine> lines =
      table_lines(text, [&](const std::string& line) { return columns_named_in(line, kinds); });
  if (lines.empty()) return table;
  const ReportProblem report_names = report_to(problems, lines[0]);
  const Delimiter delimiter = delimiter_of_names(lines[0].text, kinds);
  table.header = lines[0].number;
  std::vector<NamedColumn> columns =
      named_columns(lines[0].text, delimiter, kinds, report_names,
                    doubts ? report_to(*doubts, lines[0]) : ReportProblem());
  for (const NamedColumn& c : columns) {
    table.columns.push_back(c.kind ? c.kind->name : "");
    table.places.push_back(c.place + lines[0].skipped);
  }
  if (problems.size() > before) return table;  // what is wrong here is so in every row

  std::vector<TableRow> rows = table_rows(lines, delimiter, columns.size());
  const bool has_units = !rows.empty() && take_units(columns, rows.front().cells,
                                                     report_to(problems, *rows.front().line));
  if (has_units) rows.erase(rows.begin());
  for (const NamedColumn& c : columns) {
    if (!c.needs_unit) continue;
    report_names(c.place, c.kind->name,
                 "its unit is missing; write it behind the name, such as [rpm] or [Hz], or in a "
                 "line of units below");
  }
  if (problems.size() > before) return table;
  const NumberMarks marks = marks_in(rows, columns, delimiter);
  for (const auto& [line, cells] : rows) {
    const ReportProblem report = report_to(problems, *line);
    if (cells.size() != columns.size()) {
      report_count(cells, columns.size(), delimiter, report);
      continue;
    }
    DelimitedRow& row = table.rows.emplace_back();
    row.line = line->number;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (!columns[i].kind) continue;
      row.places[columns[i].kind->name] = cells[i].place;
      read_cell(columns[i], cells[i], marks, row, report);
    }
  }
  tell_once(problems, before);
  return table;
}

}  // namespace whirl::inline io
