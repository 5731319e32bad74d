#include <fmt/format.h>

#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"
#include "libio/model/read_parts.hpp"

namespace whirl::inline io {

namespace {

/// A position, or { at = ... } or { node = ... }.
std::optional<Station> place_on_shaft(ModelReading& reading, TableReader& table,
                                      std::string_view key) {
  const ConfigNode* node = table.node(key);
  if (!node) {
    table.missing(key, "a place on the shaft: a position (m), { at = ... } or { node = ... }");
  }
  if (node && node->kind == ConfigNode::Kind::table) {
    TableReader inner = reading.inner(table, key);
    auto place = reading.station(inner);
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

void read_layers(ModelReading& reading) {
  reading.for_each("layer", [&](TableReader& table, std::size_t i) {
    Layer layer{.name = table.string("name").value_or(fmt::format("layer {}", i + 1)),
                .where = table.where()};
    const auto from = place_on_shaft(reading, table, "from"),
               to = place_on_shaft(reading, table, "to");
    if (const auto m = reading.material(table)) layer.material = *m;
    table.read(layer);
    read_shear(table, layer.shear);
    read_rayleigh(reading, table, layer.damping);
    read_diameters(table, layer.left, layer.right, {}, true);
    if (!from || !to) return;
    layer.from = *from;
    layer.to = *to;
    reading.model.structure.layers.push_back(layer);
  });
}

}  // namespace

ModelTable layer_table() {
  return {.name = "layer",
          .meaning = "sleeves, hubs and tubes that go with the shaft, beside its segments",
          .read = read_layers,
          .example =
              "from = 0\n"
              "to = 1\n"
              "material = \"steel\"\n"
              "outer_diameter = 2\n"
              "inner_diameter = 1\n",
          .as_tables =
              "from = {}\n"
              "to = {}\n"
              "outer_diameter = [1, 1]\n"
              "inner_diameter = [0, 0]\n"
              "shear_coefficient = \"cowper\"\n",
          .as_values =
              "from = 0\n"
              "to = 1\n"
              "outer_diameter = 1\n"
              "inner_diameter = 0\n"
              "shear_coefficient = 1\n",
          .notes = {
              {"material", "name of a [material.NAME]"},
              {"from", "where it begins: a position, or a table with at or node"},
              {"to", "where it ends, to the right of from"},
              {"outer_diameter", "one value, or [left, right] of a cone"},
              {"inner_diameter", "one value, or [left, right]; 0: solid"},
              {"shear_coefficient", "formula of the shear coefficient, or a number", "\"cowper\""},
              {"rayleigh", "adds mass M + stiffness K of this layer to C"}}};
}

}  // namespace whirl::inline io
