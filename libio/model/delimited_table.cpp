#include "libio/model/delimited_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "libio/text/delimited.hpp"
#include "libio/text/nearest.hpp"
#include "libio/text/units.hpp"
#include "libio/text/vendor_units.hpp"

namespace whirl::inline io {

std::optional<double> DelimitedRow::number(std::string_view column) const {
  const auto found = numbers.find(column);
  return found == numbers.end() ? std::nullopt : std::optional(found->second);
}

int DelimitedRow::place(std::string_view column) const {
  const auto found = places.find(column);
  return found == places.end() ? 1 : found->second;
}

bool DelimitedTable::has(std::string_view column) const {
  return std::find(columns.begin(), columns.end(), column) != columns.end();
}

namespace {

/// A column that is there: what it is, and the unit of its cells.
struct NamedColumn {
  const ColumnKind* kind = nullptr;  ///< null: not known
  std::string unit;
};

/// The delimiter that the line of names has; names have blanks in them, which delimit nothing.
Delimiter delimiter_in(std::string_view names) {
  const Delimiter found = delimiter_of(names);
  return found == Delimiter::blanks ? Delimiter::comma : found;
}

/// What nobody reads.
const ColumnKind remarks{.name = "", .is_text = true};

const ColumnKind* kind_named(const std::string& name, const std::vector<ColumnKind>& kinds) {
  const std::string plain = plain_name(name);
  for (const ColumnKind& kind : kinds) {
    const auto& others = kind.synonyms;
    const bool is_it = plain_name(kind.name) == plain;
    if (is_it || std::find(others.begin(), others.end(), plain) != others.end()) return &kind;
  }
  return nullptr;
}

/// Name and unit of a cell of the line of names.
NameAndUnit said_in(const std::string& cell, const std::vector<ColumnKind>& kinds) {
  return name_and_unit(cell, [&](const std::string& name, const std::string& unit) {
    const ColumnKind* kind = kind_named(name, kinds);
    if (!kind || unit.empty()) return kind != nullptr;
    return !kind->is_text && unit_in_table(unit, kind->unit);
  });
}

/// How many columns a line names.
std::size_t known_names_in(const std::string& line, const std::vector<ColumnKind>& kinds) {
  std::size_t known = 0;
  for (const Cell& cell : cells_of(line, delimiter_in(line))) {
    if (kind_named(said_in(cell.text, kinds).name, kinds)) ++known;
  }
  return known;
}

void report_unknown(const std::string& name, int place, const std::vector<ColumnKind>& kinds,
                    const ReportProblem& report) {
  std::vector<std::string> names;
  for (const ColumnKind& kind : kinds) {
    if (kind.problem.empty()) names.push_back(kind.name);
  }
  std::string written = name;
  for (char& c : written) {
    c = c == ' ' || c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  const auto near = nearest(written, names);
  report(place, name,
         near ? fmt::format("unknown column, did you mean \"{}\"?", *near)
              : fmt::format("unknown column, known are {}", fmt::join(names, ", ")));
}

/// Gives a column the unit that a cell says; whether it fits.
bool take_unit(NamedColumn& column, const std::string& unit, int place,
               const ReportProblem& report) {
  if (unit.empty() || unit == "-") return true;
  const ColumnKind& kind = *column.kind;
  if (kind.is_text) {
    report(place, kind.name,
           kind.unit_problem.empty() ? "a column of words has no unit" : kind.unit_problem);
    return false;
  }
  const auto meant = unit_in_table(unit, kind.unit);
  if (!meant) {
    report(place, kind.name, fmt::format("the unit [{}] does not fit: {}", unit, meant.problem));
    return false;
  }
  column.unit = *meant;
  return true;
}

/// The column of a cell of the line of names.
NamedColumn column_named(const Cell& cell, const std::vector<ColumnKind>& kinds,
                         const ReportProblem& report) {
  const NameAndUnit said = said_in(cell.text, kinds);
  NamedColumn column{kind_named(said.name, kinds), ""};
  if (!column.kind && names_remarks(said.name)) return {&remarks, ""};
  if (!column.kind) {
    report_unknown(said.name, cell.place, kinds, report);
  } else if (!column.kind->problem.empty()) {
    report(cell.place, said.name, column.kind->problem);
  } else if (said.has_unit) {
    take_unit(column, said.unit, cell.place, report);
  }
  return column;
}

std::vector<NamedColumn> columns_of(std::vector<Cell> cells, const std::vector<ColumnKind>& kinds,
                                    const ReportProblem& report) {
  while (cells.size() > 1 && cells.back().text.empty()) cells.pop_back();
  if (begins_as_number(cells.front().text)) {
    std::vector<std::string> names;
    for (const ColumnKind& kind : kinds) {
      if (kind.problem.empty()) names.push_back(kind.name);
    }
    report(cells.front().place, "",
           fmt::format("found numbers, expected a line with the names of the columns first: {}",
                       fmt::join(names, ", ")));
    return {};
  }
  std::vector<NamedColumn> columns;
  for (const Cell& cell : cells) {
    const NamedColumn column = column_named(cell, kinds, report);
    const bool is_double = column.kind && column.kind != &remarks &&
                           std::any_of(columns.begin(), columns.end(),
                                       [&](const NamedColumn& c) { return c.kind == column.kind; });
    if (is_double) report(cell.place, column.kind->name, "this column is there already");
    columns.push_back(column);
  }
  return columns;
}

/// Takes the units of a line that has nothing else; whether it is one.
bool take_units(std::vector<NamedColumn>& columns, const std::vector<Cell>& cells) {
  if (cells.size() > columns.size() || !is_line_of_units(cells)) return false;
  const ReportProblem nobody = [](int, const std::string&, const std::string&) {};
  std::vector<NamedColumn> with_units = columns;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    std::string unit = cells[i].text;
    const bool is_bracketed = !unit.empty() && (unit.front() == '[' || unit.front() == '(');
    if (is_bracketed) unit = trimmed(std::string_view(unit).substr(1, unit.find_last_of("])") - 1));
    if (!take_unit(with_units[i], unit, cells[i].place, nobody)) return false;
  }
  columns = std::move(with_units);
  return true;
}

/// Reads a cell with something in it.
void read_cell(const NamedColumn& column, const Cell& cell, const NumberMarks& marks,
               DelimitedRow& row, const ReportProblem& report) {
  const ColumnKind& kind = *column.kind;
  if (kind.is_text) {
    row.texts[kind.name] = cell.text;
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
      if (!columns[i].kind->is_text) marks.add(row.cells[i].text);
    }
  }
  return marks;
}

}  // namespace

DelimitedTable parse_delimited(const std::string& text, const std::string& file,
                               const std::vector<ColumnKind>& kinds,
                               std::vector<Problem>& problems) {
  DelimitedTable table;
  const std::size_t before = problems.size();
  const auto report_in = [&](const TableLine& line) -> ReportProblem {
    return [&problems, &file, number = line.number, skipped = line.skipped](
               int place, std::string key, std::string message) {
      problems.push_back({{file, number, place + skipped}, std::move(key), std::move(message)});
    };
  };
  const std::vector<TableLine> lines =
      table_lines(text, [&](const std::string& line) { return known_names_in(line, kinds); });
  if (lines.empty()) return table;
  const Delimiter delimiter = delimiter_in(lines[0].text);
  table.header = lines[0].number;
  std::vector<NamedColumn> columns =
      columns_of(cells_of(lines[0].text, delimiter), kinds, report_in(lines[0]));
  for (const NamedColumn& c : columns) table.columns.push_back(c.kind ? c.kind->name : "");
  if (problems.size() > before) return table;

  std::vector<TableRow> rows = table_rows(lines, delimiter, columns.size());
  if (!rows.empty() && take_units(columns, rows.front().cells)) rows.erase(rows.begin());
  const NumberMarks marks = marks_in(rows, columns, delimiter);
  for (const auto& [line, cells] : rows) {
    const ReportProblem report = report_in({line->number});
    if (cells.size() != columns.size()) {
      report_count(cells, columns.size(), delimiter, report);
      continue;
    }
    DelimitedRow& row = table.rows.emplace_back();
    row.line = line->number;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      row.places[columns[i].kind->name] = cells[i].place;
      if (!cells[i].text.empty()) read_cell(columns[i], cells[i], marks, row, report);
    }
  }
  tell_once(problems, before);
  return table;
}

}  // namespace whirl::inline io
