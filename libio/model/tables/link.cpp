#include <fmt/format.h>

#include <utility>

#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"
#include "libio/model/read_parts.hpp"
#include "libio/model/read_connections.hpp"

namespace whirl::inline io {

namespace {

void read_links(ModelReading& reading) {
  reading.for_each("link", [&](TableReader& table, std::size_t i) {
    Connection c;
    c.where = table.where();
    c.name = table.string("name").value_or(fmt::format("link {}", i + 1));
    for (const auto& [key, end] : {std::pair("from", &c.from), std::pair("to", &c.to)}) {
      if (const auto station = station_at(reading, table, key, true)) *end = *station;
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
