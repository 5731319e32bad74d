#include <fmt/format.h>

#include <utility>

#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"
#include "libio/model/read_supports.hpp"

namespace whirl::inline io {

namespace {

void read_links(ModelReading& reading) {
  reading.for_each("link", [&](TableReader& table, std::size_t i) {
    Connection c;
    c.where = table.where();
    c.name = table.string("name").value_or(fmt::format("link {}", i + 1));
    for (const auto& [key, end] : {std::pair("from", &c.from), std::pair("to", &c.to)}) {
      const ConfigNode* node = table.node(key);
      if (!node) {
        table.missing(key, "a body's name, \"ground\", { at = position } or { node = number }");
      } else if (node->kind == ConfigNode::Kind::table) {
        TableReader inner = reading.inner(table, key);
        if (const auto s = reading.station(inner)) *end = *s;
        inner.finish();
      } else if (const auto name = table.string(key)) {
        if (const auto s = reading.named_station(*name, table, key)) *end = *s;
      }
    }
    const bool has_values = read_coefficients(reading, table, c.coefficients);
    c.is_clamped = table.boolean("clamped").value_or(false);
    c.is_rigid = table.boolean("rigid").value_or(false) || c.is_clamped;
    if (!has_values && !c.is_rigid) {
      table.missing(
          "stiffness", "a stiffness (N/m), damping, rigid = true or clamped = true",
          {"damping", "tilt_stiffness", "tilt_damping", "added_mass", "rigid", "clamped"});
    }
    if (has_values && c.is_rigid) {
      table.problem("rigid", "a rigid link has no stiffness or damping of its own; leave them out");
    }
    reading.model.structure.links.push_back(c);
  });
}

}  // namespace

ModelTable link_table() {
  return {.name = "link",
          .meaning = "linear springs and dampers between two stations",
          .read = read_links,
          .example =
              "from = \"b\"\n"
              "to = \"ground\"\n"
              "stiffness = 1\n",
          .as_tables =
              "from = {}\n"
              "to = {}\n",
          .as_values =
              "from = \"\"\n"
              "to = \"\"\n",
          .notes = {{"to", "name of a body, \"ground\", or a table with a station"}}};
}

}  // namespace whirl::inline io
