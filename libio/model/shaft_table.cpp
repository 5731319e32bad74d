#include "libio/model/shaft_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "libio/model/delimited_table.hpp"
#include "libio/text/delimited.hpp"
#include "libio/text/nearest.hpp"

namespace whirl::inline io {

namespace {

constexpr double same_length = 1e-9;  ///< relative: rounding of units
constexpr double most_in_row = 100'000, most_layers = 1000;

const std::vector<ColumnKind>& shaft_columns() {
  using enum Range;
  static const std::vector<ColumnKind> columns{
      {.name = "length", .unit = "m", .range = nonnegative},
      {.name = "outer_diameter", .unit = "m", .range = nonnegative},
      {.name = "outer_left", .unit = "m", .range = nonnegative},
      {.name = "outer_right", .unit = "m", .range = nonnegative},
      {.name = "inner_diameter", .unit = "m", .range = nonnegative},
      {.name = "inner_left", .unit = "m", .range = nonnegative},
      {.name = "inner_right", .unit = "m", .range = nonnegative},
      {.name = "material", .is_text = true},
      {.name = "layer", .range = positive},
      {.name = "elements", .range = positive},
      {.name = "carries", .is_text = true},
      {.name = "rayleigh_mass", .unit = "1/s", .range = nonnegative},
      {.name = "rayleigh_stiffness", .unit = "s", .range = nonnegative},
      {.name = "station",
       .is_text = true,
       .unit_problem = "numbers of stations have no unit; positions stand in a column position, "
                       "such as position [mm]"},
      {.name = "position", .unit = "m"},
      {.name = "name", .is_text = true},
      {.name = "added_mass", .unit = "kg", .range = nonnegative},
      {.name = "polar_inertia", .unit = "kg.m^2", .range = nonnegative},
      {.name = "diametral_inertia", .unit = "kg.m^2", .range = nonnegative},
      {.name = "unbalance", .unit = "kg.m", .range = nonnegative},
      {.name = "unbalance_angle", .unit = "rad"},
      {.name = "bearing", .is_text = true},
      {.name = "seal", .is_text = true},
      {.name = "probe", .is_text = true}};
  return columns;
}

/// Columns that are needed, and those that say the same twice.
void check_columns(const DelimitedTable& table, const std::string& file,
                   std::vector<Problem>& problems) {
  const Where where{file, table.header, 1};
  const auto missing = [&](const char* column, const char* expected) {
    problems.push_back({where, column, fmt::format("missing, expected {}", expected)});
  };
  if (!table.has("length") && !table.has("position")) {
    missing("length", "a column of lengths, as length [mm]");
  }
  for (const std::string side : {"outer", "inner"}) {
    const bool has_both = table.has(side + "_diameter"), has_left = table.has(side + "_left"),
               has_right = table.has(side + "_right");
    if (has_both && (has_left || has_right)) {
      problems.push_back({where, side + "_diameter",
                          fmt::format("found {0}_diameter and {0}_left or {0}_right, expected one "
                                      "value or one for each end",
                                      side)});
    } else if (has_left != has_right) {
      missing((side + (has_left ? "_right" : "_left")).c_str(), "a column for the other end, too");
    } else if (!has_both && !has_left && side == "outer") {
      missing("outer_diameter", "a column outer_diameter, or outer_left and outer_right");
    }
  }
}

/// A whole number from a cell.
std::optional<int> whole(const DelimitedRow& row, const char* column, double most,
                         const ReportProblem& report) {
  const auto value = row.number(column);
  if (!value) return std::nullopt;
  if (*value == std::floor(*value) && *value <= most) return static_cast<int>(*value);
  report(row.place(column), column,
         fmt::format("found {:g}, expected a whole number from 1 to {:g}", *value, most));
  return std::nullopt;
}

/// The diameters of a side: one column for both ends, or two.
std::pair<std::optional<double>, std::optional<double>> ends(const DelimitedRow& row,
                                                             const std::string& side) {
  const auto both = row.number(side + "_diameter");
  if (both) return {both, both};
  return {row.number(side + "_left"), row.number(side + "_right")};
}

/// Where the cell of a side's diameter is.
int place_of(const DelimitedRow& row, const std::string& side) {
  return std::max(row.place(side + "_diameter"), row.place(side + "_left"));
}

void read_diameters(const DelimitedRow& from, bool is_layer, ShaftRow& row,
                    const ReportProblem& report) {
  const auto outer = ends(from, "outer"), inner = ends(from, "inner");
  row.inner_place = place_of(from, "inner");
  if (!outer.first || !outer.second) {
    report(place_of(from, "outer"), "outer_diameter",
           "missing, expected an outer diameter (m) at both ends");
    return;
  }
  if (is_layer && (!inner.first || !inner.second)) {
    report(row.inner_place, "inner_diameter",
           "missing, expected the inner diameter (m) of the layer at both ends");
    return;
  }
  if (*outer.first == 0.0 || *outer.second == 0.0) {
    report(place_of(from, "outer"), "outer_diameter", "found 0, expected a length (m) above zero");
    return;
  }
  row.left = {*outer.first, inner.first.value_or(0.0)};
  row.right = {*outer.second, inner.second.value_or(0.0)};
  for (const Section& end : {row.left, row.right}) {
    if (end.inner < end.outer) continue;
    report(row.inner_place, "inner_diameter",
           fmt::format("found {:g} mm, expected less than the outer diameter of {:g} mm",
                       1e3 * end.inner, 1e3 * end.outer));
    return;
  }
}

/// What a row says of its left end.
StationCells station_cells(const DelimitedRow& from) {
  StationCells cells{.station = from.text("station"), .name = from.text("name")};
  const auto mass = from.number("added_mass"), polar = from.number("polar_inertia"),
             diametral = from.number("diametral_inertia");
  cells.mass = mass.value_or(0.0);
  cells.polar_inertia = polar.value_or(0.0);
  cells.diametral_inertia = diametral.value_or(0.0);
  cells.has_disk = cells.mass > 0.0 || cells.polar_inertia > 0.0 || cells.diametral_inertia > 0.0;
  cells.unbalance = from.number("unbalance").value_or(0.0);
  cells.unbalance_angle = from.number("unbalance_angle").value_or(0.0);
  for (const char* kind : {"bearing", "seal", "probe"}) {
    const std::string names = from.text(kind);
    for (std::size_t start = 0; start < names.size();) {
      const std::size_t end = std::min(names.find_first_of("/+,", start), names.size());
      const std::string name = trimmed(std::string_view(names).substr(start, end - start));
      if (!name.empty() && name != "-" && name != "0") {
        cells.named.push_back({kind, name, from.place(kind)});
      }
      start = end + 1;
    }
  }
  return cells;
}

/// Whether a row has no segment.
bool is_end(const DelimitedRow& from, const DelimitedTable& table) {
  if (&from != &table.rows.back() || table.rows.size() < 2) return false;
  if (!table.has("length")) return from.number("layer").value_or(1.0) == 1.0;
  const double length = from.number("length").value_or(0.0);
  const bool has_outer = from.number("outer_diameter").value_or(0.0) > 0.0 ||
                         from.number("outer_left").value_or(0.0) > 0.0;
  return length == 0.0 && (from.number("length") || !has_outer);
}

/// Gives rows that have positions their lengths: each reaches to the next one of layer 1.
void set_lengths(DelimitedTable& table, const std::string& file, std::vector<Problem>& problems) {
  DelimitedRow* last = nullptr;
  for (DelimitedRow& row : table.rows) {
    if (row.number("layer").value_or(1.0) != 1.0) continue;
    const Where where{file, row.line, row.place("position")};
    const auto z = row.number("position");
    if (!z) {
      problems.push_back({where, "position", "missing, expected a length (m)"});
      return;
    }
    if (last && !(*z > *last->number("position"))) {
      problems.push_back({where, "position", "positions must ascend from line to line"});
      return;
    }
    if (last) last->numbers["length"] = *z - *last->number("position");
    last = &row;
  }
}

/// What of a row does not go with its being a layer, or the shaft itself.
/// @param has_layers  whether the table says which rows are layers
void check_place(const DelimitedRow& from, const ShaftRow* base, bool has_layers, ShaftRow& row,
                 const ReportProblem& report) {
  const auto length = from.number("length");
  if (row.layer == 1) {
    if (!length) {
      report(from.place("length"), "length",
             base && !has_layers
                 ? "missing, expected a length (m); or, if this lies on the row before, a column "
                   "layer with 2 here"
                 : "missing, expected a length (m)");
    } else if (*length == 0.0) {
      report(from.place("length"), "length", "found 0, expected a length (m) above zero");
    }
    if (row.carries != Carries::both) {
      report(from.place("carries"), "carries",
             "the shaft itself carries both; layers have a number above 1");
    }
    row.length = length.value_or(0.0);
    return;
  }
  if (!base) {
    report(
        from.place("layer"), "layer",
        fmt::format("found {}, expected a row of layer 1 before it, on which it lies", row.layer));
    return;
  }
  if (row.elements > 0) {
    report(from.place("elements"), "elements",
           "a layer has the elements of the row that it lies on; leave them out");
  }
  row.length = length.value_or(base->length);
  if (std::abs(row.length - base->length) > same_length * base->length) {
    report(from.place("length"), "length",
           fmt::format("found {:.9g} mm, expected the {:.9g} mm of line {}, on which the "
                       "layer lies",
                       1e3 * row.length, 1e3 * base->length, base->line));
  }
}

void read_carries(const DelimitedRow& from, ShaftRow& row, const ReportProblem& report) {
  const auto found = from.texts.find("carries");
  if (found == from.texts.end()) return;
  for (const auto& [name, value] : choices(Carries{})) {
    if (name != found->second) continue;
    row.carries = value;
    return;
  }
  report(from.place("carries"), "carries",
         fmt::format("found \"{}\", expected one of both, stiffness, mass", found->second));
}

}  // namespace

std::size_t shaft_columns_named_in(const std::string& line) {
  return columns_named_in(line, shaft_columns());
}

std::vector<ShaftRow> parse_shaft_table(const std::string& text, const std::string& file,
                                        std::vector<Problem>& problems,
                                        std::vector<Problem>* doubts) {
  const std::size_t before = problems.size();
  DelimitedTable table = parse_delimited(text, file, shaft_columns(), problems, doubts);
  std::vector<ShaftRow> rows;
  if (table.header > 0 && problems.size() == before) check_columns(table, file, problems);
  if (problems.size() > before) return rows;
  const bool has_inertias = table.has("polar_inertia") || table.has("diametral_inertia");
  if (doubts && has_inertias && !table.has("added_mass")) {
    doubts->push_back({{file, table.header, 1},
                       "polar_inertia",
                       "moments of inertia without a column added_mass: they are taken as those of "
                       "disks at the stations, beside what the segments have themselves"});
  }
  if (table.rows.empty()) {
    problems.push_back(
        {{file}, "", "the table has no rows; expected a line of column names and one per segment"});
    return rows;
  }
  if (!table.has("length")) set_lengths(table, file, problems);
  if (problems.size() > before) return rows;
  std::optional<ShaftRow> base;
  for (const DelimitedRow& from : table.rows) {
    const ReportProblem report = [&](int place, std::string key, std::string message) {
      problems.push_back({{file, from.line, place}, std::move(key), std::move(message)});
    };
    ShaftRow row{.line = from.line};
    row.at_left = station_cells(from);
    row.is_end = is_end(from, table);
    if (row.is_end) {
      rows.push_back(row);
      break;
    }
    row.layer = whole(from, "layer", most_layers, report).value_or(1);
    row.elements = whole(from, "elements", most_in_row, report).value_or(0);
    row.material = from.text("material");
    row.material_place = from.place("material");
    row.damping = {from.number("rayleigh_mass").value_or(0.0),
                   from.number("rayleigh_stiffness").value_or(0.0)};
    row.has_damping = from.number("rayleigh_mass") || from.number("rayleigh_stiffness");
    read_carries(from, row, report);
    read_diameters(from, row.layer > 1, row, report);
    check_place(from, base ? &*base : nullptr, table.has("layer"), row, report);
    if (row.layer == 1) base = row;
    rows.push_back(row);
  }
  tell_once(problems, before);
  return rows;
}

}  // namespace whirl::inline io
