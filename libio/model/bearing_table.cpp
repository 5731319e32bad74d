#include "libio/model/bearing_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "libio/model/delimited_table.hpp"
#include "libio/text/delimited.hpp"

namespace whirl::inline io {

namespace {

/// An entry of a matrix and its column.
struct Entry {
  std::string column;
  Mat2 BearingCoefficients::*matrix;
  int row, col;
  const char* unit;
};

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = [] {
    std::vector<Entry> made;
    const std::tuple<const char*, const char*, Mat2 BearingCoefficients::*> groups[] = {
        {"k", "N/m", &BearingCoefficients::K},
        {"c", "N.s/m", &BearingCoefficients::C},
        {"m", "kg", &BearingCoefficients::M},
        {"kt", "N.m/rad", &BearingCoefficients::Kt},
        {"ct", "N.m.s/rad", &BearingCoefficients::Ct}};
    for (const auto& [prefix, unit, matrix] : groups) {
      for (const int i : {0, 1}) {
        for (const int j : {0, 1}) {
          made.push_back({std::string(prefix) + "xy"[i] + "xy"[j], matrix, i, j, unit});
        }
      }
    }
    return made;
  }();
  return all;
}

const std::vector<ColumnKind>& coefficient_columns() {
  static const std::vector<ColumnKind> columns = [] {
    std::vector<ColumnKind> made;
    for (const char* place : {"speed", "whirl"}) {
      made.push_back({.name = place,
                      .unit = "rad/s",
                      .range = Range::nonnegative,
                      .must_be_filled = true,
                      .others_need_unit = true});
    }
    for (const Entry& entry : entries()) {
      made.push_back({.name = entry.column, .unit = entry.unit, .must_be_filled = true});
    }
    return made;
  }();
  return columns;
}

/// A table while its lines are read.
struct OpenTable {
  CoefficientTable table{};
  std::vector<Where> places{};  ///< where its rows stand: the cell of the speed, or whirl frequency
};

/// Adds a row whose speed and whirl frequency are known.
void add_row(OpenTable& open, const DelimitedTable& from, const DelimitedRow& row,
             const std::string& file) {
  const bool has_speed = from.has("speed"), has_whirl = from.has("whirl");
  const auto speed = row.number("speed"), whirl = row.number("whirl");
  if ((has_speed && !speed) || (has_whirl && !whirl)) return;
  if (has_speed) open.table.speed.push_back(*speed);
  if (has_whirl) open.table.whirl.push_back(*whirl);
  BearingCoefficients& to = open.table.rows.emplace_back();
  for (const Entry& entry : entries()) {
    (to.*entry.matrix)(entry.row, entry.col) = row.number(entry.column).value_or(0.0);
  }
  open.places.push_back({file, row.line, row.place(has_speed ? "speed" : "whirl")});
}

/// Puts rows in another order.
void reorder(OpenTable& open, const std::vector<std::size_t>& order) {
  OpenTable sorted;
  for (const std::size_t i : order) {
    if (!open.table.speed.empty()) sorted.table.speed.push_back(open.table.speed[i]);
    if (!open.table.whirl.empty()) sorted.table.whirl.push_back(open.table.whirl[i]);
    sorted.table.rows.push_back(open.table.rows[i]);
    sorted.places.push_back(open.places[i]);
  }
  open = std::move(sorted);
}

/// Rows of a table over both in the order of speeds, at one speed in that of frequencies; rows over
/// one of both that descend from line to line from the last to the first.
void sort_rows(OpenTable& open) {
  const CoefficientTable& t = open.table;
  std::vector<std::size_t> order(t.rows.size());
  std::iota(order.begin(), order.end(), 0);
  const bool has_both = !t.speed.empty() && !t.whirl.empty();
  const std::vector<double>& one = t.speed.empty() ? t.whirl : t.speed;
  if (has_both) {
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::pair(t.speed[a], t.whirl[a]) < std::pair(t.speed[b], t.whirl[b]);
    });
  } else if (std::is_sorted(one.rbegin(), one.rend(), std::less_equal<>())) {
    std::reverse(order.begin(), order.end());
  }
  reorder(open, order);
}

/// Reports rows that neither ascend nor descend, of a table over one of both, or that are there
/// twice.
void check_order(const OpenTable& open, std::vector<Problem>& problems) {
  const CoefficientTable& t = open.table;
  const bool has_both = !t.speed.empty() && !t.whirl.empty();
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

/// Reports the first thing that is missing in a table: a kind of column, or rows.
void check_whole(const DelimitedTable& table, const std::string& file,
                 std::vector<Problem>& problems) {
  const bool has_coefficients =
      std::any_of(entries().begin(), entries().end(),
                  [&](const Entry& entry) { return table.has(entry.column); });
  if (table.header > 0 && !table.has("speed") && !table.has("whirl")) {
    problems.push_back(
        {{file, table.header, 1},
         "",
         "a column of speeds or of whirl frequencies is missing: name it speed or whirl"});
  } else if (table.header > 0 && !has_coefficients) {
    problems.push_back({{file, table.header, 1},
                        "",
                        "a column of coefficients is missing, such as kxx [N/m] or cxx [N.s/m]"});
  } else if (table.rows.empty()) {
    problems.push_back({{file},
                        "",
                        "the table has no rows; expected a line of column names and one line per "
                        "speed or whirl frequency"});
  }
}

/// Reports what may be forgotten: one of kxx and kyy, of kxy and kyx, ...
void doubt_columns(const DelimitedTable& table, const std::string& file,
                   std::vector<Problem>& doubts) {
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const std::string& name = table.columns[i];
    if (name.empty() || name == "speed" || name == "whirl") continue;
    std::string other = name;
    for (char& c : other) c = c == 'x' ? 'y' : c == 'y' ? 'x' : c;
    if (table.has(other)) continue;
    doubts.push_back(
        {{file, table.header, table.places[i]},
         other,
         fmt::format("this table has no such column beside {}: it is taken as zero", name)});
  }
}

}  // namespace

std::size_t coefficients_named_in(const std::string& line) {
  return columns_named_in(line, coefficient_columns());
}

CoefficientTable parse_bearing_table(const std::string& text, const std::string& file,
                                     std::vector<Problem>& problems, std::vector<Problem>* doubts) {
  OpenTable open;
  const std::size_t others = problems.size();  // of other tables
  const DelimitedTable table = parse_delimited(text, file, coefficient_columns(), problems, doubts);
  if (problems.size() == others) check_whole(table, file, problems);
  for (const DelimitedRow& row : table.rows) add_row(open, table, row, file);
  sort_rows(open);
  check_order(open, problems);
  if (doubts) doubt_columns(table, file, *doubts);
  tell_once(problems, others);
  return open.table;
}

}  // namespace whirl::inline io
