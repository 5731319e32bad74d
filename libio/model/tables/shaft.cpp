#include <fmt/format.h>
#include <fmt/ranges.h>

#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"
#include "libio/model/read_parts.hpp"
#include "libio/model/shaft_table.hpp"
#include "libio/text/delimited.hpp"
#include "libio/text/nearest.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

namespace {

/// The shaft that segments are added to: the first one, or that of a rotor.
struct ShaftToFill {
  std::vector<Segment>& segments;
  std::string rotor;  ///< empty: the first one
  double start = 0.0;

  double end() const {
    double z = start;
    for (const Segment& segment : segments) z += segment.length;
    return z;
  }
};

ShaftToFill shaft_to_fill(Structure& s, const std::string& rotor) {
  const auto named = std::ranges::find(s.rotors, rotor, &Rotor::name);
  if (named == s.rotors.end()) return {s.shaft, ""};
  return {named->shaft, rotor, named->z};
}

/// Adds what is at the left end of a row: a disk, an unbalance, and which parts are there.
void add_station(ModelReading& reading, const StationCells& cells, const ShaftToFill& shaft,
                 const Where& where) {
  Structure& s = reading.model.structure;
  const Station at{.kind = Station::Kind::position,
                   .z = shaft.end(),
                   .rotor = shaft.rotor,
                   .where = where,
                   .key = "station"};
  const std::string number =
      cells.station.empty() ? fmt::format("of line {}", where.line) : cells.station;
  if (cells.has_disk) {
    s.disks.push_back({.name = cells.name.empty() ? "station " + number : cells.name,
                       .at = at,
                       .m = cells.mass,
                       .Id = cells.diametral_inertia,
                       .Ip = cells.polar_inertia});
  }
  if (cells.unbalance > 0.0) s.unbalances.push_back({at, cells.unbalance, cells.unbalance_angle});
  for (const auto& [kind, name, place] : cells.named) {
    Where there = where;
    there.column = place;
    reading.named_places.push_back({kind, name, at, there});
  }
}

/// The material of a row; what is wrong with it is reported.
Material material_of(const ModelReading& reading, const ShaftRow& row, const Segment& common,
                     bool has_common, const Where& where, std::vector<Problem>& wrong) {
  const auto found = reading.materials.find(row.material);
  if (found != reading.materials.end()) return found->second;
  if (!row.material.empty()) {
    const auto near = nearest(row.material, reading.material_names());
    wrong.push_back({where, "material",
                     fmt::format("found {}, expected one of {}{}", in_quotes(row.material),
                                 fmt::join(reading.material_names(), ", "),
                                 near ? fmt::format("; did you mean \"{}\"?", *near) : "")});
  } else if (!has_common) {
    wrong.push_back({where, "material", "missing, expected the name of a material"});
  }
  return common.material;
}

/// Adds the segments and layers of a table.
/// @param common  what holds for rows that do not say otherwise
void add_rows(ModelReading& reading, TableReader& table, const Segment& common,
              const ShaftToFill& shaft, std::size_t number) {
  std::vector<Problem> wrong;
  std::vector<ShaftRow> rows;
  const auto from = reading.text_of(table, "table", "shaft", number, shaft_columns_named_in);
  if (from) rows = parse_shaft_table(from->text, from->name, wrong, &reading.doubts);
  for (const ShaftRow& row : rows) {
    const Where where{from->name, row.line, 1};
    if (row.layer == 1) add_station(reading, row.at_left, shaft, where);
    if (row.is_end) break;
    const Material material = material_of(reading, row, common, table.has("material"),
                                          {from->name, row.line, row.material_place}, wrong);
    const Rayleigh damping = row.has_damping ? row.damping : common.damping;
    if (row.layer == 1) {
      Segment segment = common;
      segment.material = material;
      segment.length = row.length;
      segment.left = row.left;
      segment.right = row.right;
      if (row.elements > 0) segment.elements = row.elements;
      segment.damping = damping;
      segment.where = where;
      shaft.segments.push_back(segment);
      continue;
    }
    Layer layer{.name = fmt::format("layer {} of row {}", row.layer, row.line),
                .material = material,
                .left = row.left,
                .right = row.right,
                .carries = row.carries,
                .theory = common.theory,
                .shear = common.shear,
                .damping = damping,
                .where = {from->name, row.line, row.inner_place}};
    const double end = shaft.end();
    layer.to = {.kind = Station::Kind::position,
                .z = end,
                .rotor = shaft.rotor,
                .where = where,
                .key = "layer"};
    layer.from = layer.to;
    if (!shaft.segments.empty()) layer.from.z = end - shaft.segments.back().length;
    reading.model.structure.layers.push_back(layer);
  }
  tell_once(wrong, 0);
  // nothing is said of stations on a shaft that is not whole
  if (!wrong.empty() || rows.empty()) shaft.segments.push_back({});
  reading.add_problems(wrong);
}

void read_shaft(ModelReading& reading) {
  reading.for_each("shaft", [&](TableReader& table, std::size_t number) {
    table.string("name");
    Segment segment;
    segment.where = table.where();
    const ShaftToFill shaft =
        shaft_to_fill(reading.model.structure, reading.rotor_at(table, "rotor"));
    const bool has_table = table.has("table");
    table.node("table");
    if (table.has("material")) {
      if (const auto m = reading.material(table)) segment.material = *m;
    } else {
      table.string("material");
      if (!has_table) table.missing("material", "a text", {"table"});
    }
    table.read(segment);
    if (!has_table && !table.has("length")) {
      table.missing("length", expected_quantity("m"), {"table"});
    }
    read_shear(table, segment.shear);
    read_rayleigh(reading, table, segment.damping);
    constexpr int most_elements = 100'000;
    table.at_most("elements", segment.elements, most_elements);
    if (segment.elements > most_elements) segment.elements = 1;
    table.at_most("internal_functions", segment.internal_functions, 4);
    if (has_table) {
      for (const char* key : {"length", "outer_diameter", "inner_diameter"}) {
        if (table.node(key)) table.problem(key, "stands in the table; leave it out");
      }
      add_rows(reading, table, segment, shaft, number);
      return;
    }
    table.string("table");
    read_diameters(table, segment.left, segment.right, {"table"}, false);
    shaft.segments.push_back(segment);
  });
}

}  // namespace

ModelTable shaft_table() {
  return {.name = "shaft",
          .meaning = "segments of the shaft, one after another from z = 0",
          .read = read_shaft,
          .example =
              "material = \"steel\"\n"
              "length = 1\n"
              "outer_diameter = 1\n",
          .as_tables =
              "outer_diameter = [1, 1]\n"
              "inner_diameter = [0, 0]\n"
              "shear_coefficient = \"cowper\"\n",
          .as_values =
              "outer_diameter = 1\n"
              "inner_diameter = 0\n"
              "shear_coefficient = 1\n",
          .notes = {
              {"material", "name of a [material.NAME]"},
              {"table", "file with segments and layers row by row (CSV), beside the model"},
              {"outer_diameter", "one value, or [left, right] of a cone"},
              {"inner_diameter", "one value, or [left, right] of a cone; left out: solid", "0"},
              {"shear_coefficient", "formula of the shear coefficient, or a number", "\"cowper\""},
              {"rayleigh", "adds mass M + stiffness K of this segment to C"}}};
}

}  // namespace whirl::inline io
