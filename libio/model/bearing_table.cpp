#include "libio/model/bearing_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "libio/model/delimited_table.hpp"
#include "libio/text/nearest.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

namespace {

/// What a column means: an entry of a matrix, or the speed.
struct NumberColumn {
  std::string name, unit, si_unit;
  Mat2 BearingCoefficients::*matrix = nullptr;  ///< null: the speed
  int row = 0, column = 0;
};

const std::vector<NumberColumn>& known_columns() {
  static const std::vector<NumberColumn> columns = [] {
    std::vector<NumberColumn> all{{"speed", "", "rad/s"}};
    const std::tuple<const char*, const char*, Mat2 BearingCoefficients::*> groups[] = {
        {"k", "N/m", &BearingCoefficients::K},
        {"c", "N.s/m", &BearingCoefficients::C},
        {"kt", "N.m/rad", &BearingCoefficients::Kt},
        {"ct", "N.m.s/rad", &BearingCoefficients::Ct}};
    for (const auto& [prefix, unit, matrix] : groups) {
      for (const int i : {0, 1}) {
        for (const int j : {0, 1}) {
          all.push_back({std::string(prefix) + "xy"[i] + "xy"[j], "", unit, matrix, i, j});
        }
      }
    }
    return all;
  }();
  return columns;
}

/// The columns that the first line names.
std::vector<NumberColumn> named_columns(const std::vector<std::string>& parts,
                                        const ReportOfLine& report) {
  std::vector<std::string> names;
  for (const NumberColumn& c : known_columns()) names.push_back(c.name);
  std::vector<NumberColumn> columns;
  for (const std::string& part : parts) {
    const auto bracket = part.find('[');
    const std::string name = trimmed_cell(std::string_view(part).substr(0, bracket));
    const auto known = std::find(names.begin(), names.end(), name);
    NumberColumn column;
    if (known == names.end()) {
      const auto near = nearest(name, names);
      report(name, near ? fmt::format("unknown column, did you mean \"{}\"?", *near)
                        : fmt::format("unknown column, known are {}", fmt::join(names, ", ")));
    } else {
      column = known_columns()[static_cast<std::size_t>(known - names.begin())];
    }
    if (bracket != std::string::npos) {
      column.unit =
          trimmed_cell(std::string_view(part).substr(bracket + 1, part.find(']') - bracket - 1));
    }
    if (known != names.end() && !column.unit.empty()) {
      const auto one = parse_as("1 " + column.unit, column.si_unit);
      if (!one) {
        report(name, fmt::format("the unit [{}] does not fit: {}", column.unit, one.problem));
      }
    }
    const bool is_double = std::any_of(columns.begin(), columns.end(), [&](const NumberColumn& c) {
      return !c.name.empty() && c.name == column.name;
    });
    if (is_double) report(name, "this column is there already");
    columns.push_back(column);
  }
  if (columns.front().name != "speed") report("", "the first column must be speed");
  return columns;
}

/// Adds the row of a line.
void add_row(CoefficientTable& table, const std::vector<NumberColumn>& columns,
             const std::vector<std::string>& parts, const ReportOfLine& report) {
  if (parts.size() != columns.size()) {
    report("", fmt::format("found {} columns, expected {} as in the first line", parts.size(),
                           columns.size()));
    return;
  }
  BearingCoefficients row;
  double speed = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const NumberColumn& column = columns[i];
    const auto value =
        parse_as(parts[i] + (column.unit.empty() ? "" : " " + column.unit), column.si_unit);
    if (!value) {
      report(column.name, value.problem);
    } else if (!column.matrix) {
      speed = *value;
    } else {
      (row.*column.matrix)(column.row, column.column) = *value;
    }
  }
  if (!table.speed.empty() && speed <= table.speed.back()) {
    report("speed", "speeds must ascend from line to line");
  }
  table.speed.push_back(speed);
  table.rows.push_back(row);
}

}  // namespace

CoefficientTable parse_bearing_table(const std::string& text, const std::string& file,
                                     std::vector<Problem>& problems) {
  CoefficientTable table;
  std::istringstream lines(text);
  std::string line;
  std::vector<NumberColumn> columns;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // spreadsheets begin so
    const ReportOfLine report = [&](std::string key, std::string message) {
      problems.push_back({{file, number, 1}, std::move(key), std::move(message)});
    };
    if (trimmed_cell(line).empty() || trimmed_cell(line)[0] == '#') continue;
    if (!columns.empty()) {
      add_row(table, columns, cells_of(line), report);
      continue;
    }
    columns = named_columns(cells_of(line), report);
    if (!problems.empty()) return table;
  }
  if (table.rows.empty() && problems.empty()) {
    problems.push_back(
        {{file},
         "",
         "the table has no rows; expected a line of column names and one line per speed"});
  }
  return table;
}

}  // namespace whirl::inline io
