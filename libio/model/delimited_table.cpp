#include "libio/model/delimited_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "libio/text/delimited.hpp"
#include "libio/text/nearest.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

std::optional<double> DelimitedRow::number(std::string_view column) const {
  const auto found = numbers.find(column);
  return found == numbers.end() ? std::nullopt : std::optional(found->second);
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

/// A name as names are compared.
std::string compared(std::string name) {
  for (char& c : name) {
    c = c == ' ' || c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return name;
}

const ColumnKind* kind_named(const std::string& name, const std::vector<ColumnKind>& kinds) {
  for (const ColumnKind& kind : kinds) {
    const auto& others = kind.synonyms;
    const bool is_it = kind.name == name;
    if (is_it || std::find(others.begin(), others.end(), name) != others.end()) return &kind;
  }
  return nullptr;
}

/// The column of a cell of the first line.
NamedColumn column_named(const std::string& cell, const std::vector<ColumnKind>& kinds,
                         const ReportProblem& report) {
  const auto bracket = cell.find('[');
  const std::string name = trimmed(std::string_view(cell).substr(0, bracket));
  NamedColumn column{kind_named(compared(name), kinds), ""};
  if (!column.kind) {
    std::vector<std::string> names;
    for (const ColumnKind& kind : kinds) names.push_back(kind.name);
    const auto near = nearest(compared(name), names);
    report(name, near ? fmt::format("unknown column, did you mean \"{}\"?", *near)
                      : fmt::format("unknown column, known are {}", fmt::join(names, ", ")));
    return column;
  }
  if (bracket == std::string::npos) return column;
  column.unit = trimmed(std::string_view(cell).substr(bracket + 1, cell.find(']') - bracket - 1));
  if (column.unit.empty()) return column;
  if (column.kind->is_text) {
    report(column.kind->name, "a column of words has no unit");
  } else if (const auto one = parse_as("1 " + column.unit, column.kind->unit); !one) {
    report(column.kind->name,
           fmt::format("the unit [{}] does not fit: {}", column.unit, one.problem));
  }
  return column;
}

std::vector<NamedColumn> columns_of(std::vector<std::string> cells,
                                    const std::vector<ColumnKind>& kinds,
                                    const ReportProblem& report) {
  while (cells.size() > 1 && cells.back().empty()) cells.pop_back();
  std::vector<NamedColumn> columns;
  for (const std::string& cell : cells) {
    const NamedColumn column = column_named(cell, kinds, report);
    const bool is_double =
        column.kind && std::any_of(columns.begin(), columns.end(),
                                   [&](const NamedColumn& c) { return c.kind == column.kind; });
    if (is_double) report(column.kind->name, "this column is there already");
    columns.push_back(column);
  }
  return columns;
}

/// Reads a cell with something in it.
void read_cell(const NamedColumn& column, const std::string& cell, Delimiter delimiter,
               DelimitedRow& row, const ReportProblem& report) {
  const ColumnKind& kind = *column.kind;
  if (kind.is_text) {
    row.texts[kind.name] = cell;
    return;
  }
  const auto number = plain_number(cell, delimiter);
  if (!number) return report(kind.name, number.problem);
  const auto value = parse_as(*number + (column.unit.empty() ? "" : " " + column.unit), kind.unit);
  if (!value) {
    report(kind.name, value.problem);
  } else if (kind.range == Range::positive && !(*value > 0.0)) {
    report(kind.name,
           fmt::format("found \"{}\", expected {} above zero", cell, expected_quantity(kind.unit)));
  } else if (kind.range == Range::nonnegative && !(*value >= 0.0)) {
    report(kind.name, fmt::format("found \"{}\", expected {} of zero or more", cell,
                                  expected_quantity(kind.unit)));
  } else {
    row.numbers[kind.name] = *value;
  }
}

}  // namespace

DelimitedTable parse_delimited(const std::string& text, const std::string& file,
                               const std::vector<ColumnKind>& kinds,
                               std::vector<Problem>& problems) {
  DelimitedTable table;
  std::vector<NamedColumn> columns;
  std::istringstream lines(text);
  std::string line;
  Delimiter delimiter = Delimiter::comma;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // spreadsheets begin so
    const ReportProblem report = [&](std::string key, std::string message) {
      problems.push_back({{file, number, 1}, std::move(key), std::move(message)});
    };
    if (trimmed(line).empty() || trimmed(line)[0] == '#') continue;
    if (table.header == 0) delimiter = delimiter_in(line);
    std::vector<std::string> cells = cells_of(line, delimiter);
    const auto is_empty = [](const std::string& cell) { return cell.empty(); };
    if (std::all_of(cells.begin(), cells.end(), is_empty)) continue;
    if (table.header == 0) {
      const std::size_t before = problems.size();
      columns = columns_of(cells, kinds, report);
      table.header = number;
      for (const NamedColumn& c : columns) table.columns.push_back(c.kind ? c.kind->name : "");
      if (problems.size() > before) return table;
      continue;
    }
    while (cells.size() > columns.size() && cells.back().empty()) cells.pop_back();
    if (cells.size() != columns.size()) {
      report("", fmt::format("found {} columns, expected {} as in the first line", cells.size(),
                             columns.size()));
      continue;
    }
    DelimitedRow& row = table.rows.emplace_back();
    row.line = number;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (!cells[i].empty()) read_cell(columns[i], cells[i], delimiter, row, report);
    }
  }
  return table;
}

}  // namespace whirl::inline io
