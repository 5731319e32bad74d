#include <fmt/format.h>

#include <utility>

#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"
#include "libio/model/read_connections.hpp"
#include "libio/model/read_parts.hpp"

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
    read_link_keys(reading, table, "link", c);
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
