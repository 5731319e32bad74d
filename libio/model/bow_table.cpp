#include "libio/model/bow_table.hpp"

#include <cmath>

#include "libio/model/delimited_table.hpp"
#include "libio/text/delimited.hpp"

namespace whirl::inline io {

namespace {

const std::vector<ColumnKind>& bow_columns() {
  static const std::vector<ColumnKind> columns{
      {"position", "m"}, {"x", "m"}, {"y", "m"}, {"deflection", "m"}, {"angle", "rad"}};
  return columns;
}

}  // namespace

std::size_t bow_columns_named_in(const std::string& line) {
  return columns_named_in(line, bow_columns());
}

Bow parse_bow_table(const std::string& text, const std::string& file,
                    std::vector<Problem>& problems, std::vector<Problem>* doubts) {
  Bow bow;
  const std::size_t before = problems.size();
  const DelimitedTable table = parse_delimited(text, file, bow_columns(), problems, doubts);
  const auto report = [&](int line, int place, std::string key, std::string message) {
    problems.push_back({{file, line, line > 0 ? place : 0}, std::move(key), std::move(message)});
  };
  const bool is_polar = table.has("deflection") || table.has("angle");
  const bool is_cartesian = table.has("x") || table.has("y");
  if (table.header > 0 && problems.size() == before) {
    if (!table.has("position")) {
      report(table.header, 1, "position", "missing, expected positions (m)");
    }
    if (is_polar && (is_cartesian || !table.has("deflection"))) {
      report(table.header, 1, "deflection", "expected x and y, or deflection and angle");
    } else if (!is_polar && !is_cartesian) {
      report(table.header, 1, "x", "missing, expected x and y, or deflection and angle");
    }
  }
  if (problems.size() > before) return bow;
  if (table.rows.size() < 2) {
    report(0, 0, "", "expected a line of column names and two rows at least");
    return bow;
  }
  for (const DelimitedRow& row : table.rows) {
    const auto z = row.number("position");
    const int place = row.place("position");
    if (!z) {
      report(row.line, place, "position", "missing, expected a length (m)");
    } else if (!bow.z.empty() && *z <= bow.z.back()) {
      report(row.line, place, "position", "positions must ascend from line to line");
    }
    const double r = row.number("deflection").value_or(0.0);
    const double angle = row.number("angle").value_or(0.0);
    bow.z.push_back(z.value_or(0.0));
    bow.x.push_back(is_polar ? r * std::cos(angle) : row.number("x").value_or(0.0));
    bow.y.push_back(is_polar ? r * std::sin(angle) : row.number("y").value_or(0.0));
  }
  if (problems.size() == before) return bow;
  tell_once(problems, before);
  return {};
}

}  // namespace whirl::inline io
