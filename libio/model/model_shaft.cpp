#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "libio/model/bow_table.hpp"
#include "libio/model/model_builder.hpp"
#include "libio/model/shaft_table.hpp"
#include "libio/text/delimited.hpp"
#include "libio/text/nearest.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

namespace {

/// A formula of the shear coefficient, or a number.
void read_shear(TableReader& table, ShearCoefficient& to) {
  const ConfigNode* shear = table.node("shear_coefficient");
  if (shear && shear->kind == ConfigNode::Kind::string) {
    if (const auto formula = table.choice<ShearFormula>("shear_coefficient")) {
      to.formula = *formula;
    }
  } else if (shear) {
    to.formula = ShearFormula::given;
    if (const auto value = table.quantity("shear_coefficient", "", Range::positive)) {
      to.value = *value;
    }
  }
}

}  // namespace

std::optional<std::pair<double, double>> ModelBuilder::diameters(TableReader& table,
                                                                 std::string_view key,
                                                                 Range range) {
  const ConfigNode* node = table.node(key);
  if (!node || node->kind != ConfigNode::Kind::array) {
    const auto both = table.quantity(key, "m", range);
    if (!both) return std::nullopt;
    return std::pair(*both, *both);
  }
  const auto ends = table.pair(key, "m", range, "one value, or [left, right]");
  if (!ends) return std::nullopt;
  return std::pair(ends->front(), ends->back());
}

/// Outer and inner diameters of a part of the shaft.
/// @param instead  keys in whose presence they may be left out
void ModelBuilder::read_diameters(TableReader& table, Section& left, Section& right,
                                  const std::vector<std::string>& instead, bool needs_inner) {
  const auto outer = diameters(table, "outer_diameter", Range::positive);
  if (!table.has("outer_diameter")) {
    table.missing("outer_diameter", expected_quantity("m"), instead);
  }
  const auto inner = diameters(table, "inner_diameter", Range::nonnegative);
  if (needs_inner && !table.has("inner_diameter")) {
    table.missing("inner_diameter", "a length (m): the outer diameter of what it lies on, or 0");
  }
  if (outer) {
    left.outer = outer->first;
    right.outer = outer->second;
  }
  if (inner) {
    left.inner = inner->first;
    right.inner = inner->second;
  }
  for (const auto& [in, out] :
       {std::pair(left.inner, left.outer), std::pair(right.inner, right.outer)}) {
    if (!outer || !inner || in < out) continue;
    table.problem("inner_diameter",
                  fmt::format("found {:g} mm, expected less than the outer diameter "
                              "of {:g} mm",
                              1e3 * in, 1e3 * out));
    break;
  }
}

void ModelBuilder::read_shaft() {
  for_each("shaft", [&](TableReader& table, std::size_t number) {
    table.string("name");
    Segment segment;
    segment.where = table.where();
    const bool has_table = table.has("table");
    table.node("table");
    if (table.has("material")) {
      if (const auto m = material(table)) segment.material = *m;
    } else {
      table.string("material");
      if (!has_table) table.missing("material", "a text", {"table"});
    }
    table.read(segment);
    if (!has_table && !table.has("length")) {
      table.missing("length", expected_quantity("m"), {"table"});
    }
    read_shear(table, segment.shear);
    read_rayleigh(table, segment.damping);
    constexpr int most_elements = 100'000;
    table.at_most("elements", segment.elements, most_elements);
    if (segment.elements > most_elements) segment.elements = 1;
    table.at_most("internal_functions", segment.internal_functions, 4);
    if (has_table) {
      for (const char* key : {"length", "outer_diameter", "inner_diameter"}) {
        if (table.node(key)) table.problem(key, "stands in the table; leave it out");
      }
      add_shaft_table(table, segment, number);
      return;
    }
    table.string("table");
    read_diameters(table, segment.left, segment.right, {"table"}, false);
    model_.structure.shaft.push_back(segment);
  });
}

/// Adds the segments and layers of a table.
/// @param common  what holds for rows that do not say otherwise
void ModelBuilder::add_shaft_table(TableReader& table, const Segment& common, std::size_t number) {
  Structure& s = model_.structure;
  std::vector<Problem> wrong;
  std::vector<ShaftRow> rows;
  const auto from = table_text(table, "table", "shaft", number);
  if (from) rows = parse_shaft_table(from->text, from->name, wrong);
  for (const ShaftRow& row : rows) {
    const Where where{from->name, row.line, 1};
    const Where at_material{from->name, row.line, row.material_place};
    Material material = common.material;
    if (const auto found = materials_.find(row.material); found != materials_.end()) {
      material = found->second;
    } else if (!row.material.empty()) {
      const auto near = nearest(row.material, material_names());
      wrong.push_back({at_material, "material",
                       fmt::format("found {}, expected one of {}{}", in_quotes(row.material),
                                   fmt::join(material_names(), ", "),
                                   near ? fmt::format("; did you mean \"{}\"?", *near) : "")});
    } else if (!table.has("material")) {
      wrong.push_back({at_material, "material", "missing, expected the name of a material"});
    }
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
      s.shaft.push_back(segment);
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
    const double end = s.length();
    layer.to = {.kind = Station::Kind::position, .z = end, .where = where, .key = "layer"};
    layer.from = layer.to;
    if (!s.shaft.empty()) layer.from.z = end - s.shaft.back().length;
    s.layers.push_back(layer);
  }
  tell_once(wrong, 0);
  // nothing is said of stations on a shaft that is not whole
  if (!wrong.empty() || rows.empty()) s.shaft.push_back({});
  problems_.insert(problems_.end(), wrong.begin(), wrong.end());
}

/// A position, or { at = ... } or { node = ... }.
std::optional<Station> ModelBuilder::place_on_shaft(TableReader& table, std::string_view key) {
  const ConfigNode* node = table.node(key);
  if (!node) {
    table.missing(key, "a place on the shaft: a position (m), { at = ... } or { node = ... }");
  }
  if (node && node->kind == ConfigNode::Kind::table) {
    TableReader inner(node, table.path(key), problems_, asked_);
    auto place = station(inner);
    if (place && place->kind == Station::Kind::body) {
      inner.problem("body", "a layer lies on the shaft, expected a position or a node");
      place.reset();
    }
    inner.finish();
    return place;
  }
  const auto z = table.quantity(key, "m", Range::any);
  if (!z) return std::nullopt;
  return Station{
      .kind = Station::Kind::position, .z = *z, .where = table.where(key), .key = table.path(key)};
}

void ModelBuilder::read_layers() {
  for_each("layer", [&](TableReader& table, std::size_t i) {
    Layer layer{.name = table.string("name").value_or(fmt::format("layer {}", i + 1)),
                .where = table.where()};
    const auto from = place_on_shaft(table, "from"), to = place_on_shaft(table, "to");
    if (const auto m = material(table)) layer.material = *m;
    table.read(layer);
    read_shear(table, layer.shear);
    read_rayleigh(table, layer.damping);
    read_diameters(table, layer.left, layer.right, {}, true);
    if (!from || !to) return;
    layer.from = *from;
    layer.to = *to;
    model_.structure.layers.push_back(layer);
  });
}

void ModelBuilder::read_bow() {
  TableReader table(root_.find("bow"), "bow", problems_, asked_);
  const auto from = table_text(table, "table", "bow", 0);
  if (root_.find("bow") && !table.has("table")) {
    table.missing("table", "a file with the shaft's deflections against position (CSV)");
  } else if (from) {
    std::vector<Problem> wrong;
    model_.structure.bow = parse_bow_table(from->text, from->name, wrong);
    problems_.insert(problems_.end(), wrong.begin(), wrong.end());
    if (!root_.find("shaft")) table.problem("table", "a bow is one of a shaft: there is none");
  }
  table.finish();
}

}  // namespace whirl::inline io
