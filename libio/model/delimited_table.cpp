#include "libio/model/delimited_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "libio/text/nearest.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

std::string trimmed_cell(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1));
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> result;
  std::size_t start = 0;
  for (;;) {
    const auto comma = line.find_first_of(",;", start);
    result.push_back(trimmed_cell(std::string_view(line).substr(start, comma - start)));
    if (comma == std::string::npos) return result;
    start = comma + 1;
  }
}

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
                         const ReportOfLine& report) {
  const auto bracket = cell.find('[');
  const std::string name = trimmed_cell(std::string_view(cell).substr(0, bracket));
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
  column.unit =
      trimmed_cell(std::string_view(cell).substr(bracket + 1, cell.find(']') - bracket - 1));
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
                                    const ReportOfLine& report) {
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
void read_cell(const NamedColumn& column, const std::string& cell, DelimitedRow& row,
               const ReportOfLine& report) {
  const ColumnKind& kind = *column.kind;
  if (kind.is_text) {
    row.texts[kind.name] = cell;
    return;
  }
  const auto value = parse_as(cell + (column.unit.empty() ? "" : " " + column.unit), kind.unit);
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
  for (int number = 1; std::getline(lines, line); ++number) {
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // spreadsheets begin so
    const ReportOfLine report = [&](std::string key, std::string message) {
      problems.push_back({{file, number, 1}, std::move(key), std::move(message)});
    };
    if (trimmed_cell(line).empty() || trimmed_cell(line)[0] == '#') continue;
    std::vector<std::string> cells = cells_of(line);
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
      if (!cells[i].empty()) read_cell(columns[i], cells[i], row, report);
    }
  }
  return table;
}

}  // namespace whirl::inline io
