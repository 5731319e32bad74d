#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"
#include "libio/model/read_parts.hpp"

namespace whirl::inline io {

namespace {

void read_gears(ModelReading& reading) {
  reading.for_each("gear", [&](TableReader& table, std::size_t i) {
    GearPair gears;
    gears.where = table.where();
    gears.name = table.string("name").value_or(fmt::format("gear {}", i + 1));
    const auto driving = station_at(reading, table, "driving", false);
    const auto driven = station_at(reading, table, "driven", false);
    table.read(gears);
    constexpr double right_angle = 0.5 * std::numbers::pi;
    for (const auto& [key, angle] : {std::pair("pressure_angle", gears.pressure_angle),
                                     std::pair("helix_angle", gears.helix_angle)}) {
      if (std::abs(angle) >= right_angle) table.problem(key, "expected less than 90 deg");
    }
    if (!driving || !driven) return;
    gears.driving = *driving;
    gears.driven = *driven;
    reading.model.structure.gears.push_back(gears);
  });
}

}  // namespace

ModelTable gear_table() {
  return {.name = "gear",
          .meaning = "pairs of gears between two shafts, without torsion",
          .read = read_gears,
          .example =
              "driving = \"b\"\n"
              "driven = { node = 1 }\n"
              "stiffness = 1\n"
              "driving_radius = 1\n"
              "driven_radius = 1\n",
          .as_tables =
              "driving = {}\n"
              "driven = {}\n",
          .as_values =
              "driving = \"\"\n"
              "driven = \"\"\n",
          .notes = {{"driving", "the gear that drives: name of a body, or a table with a station"},
                    {"driven", "the other gear, on another shaft"}}};
}

}  // namespace whirl::inline io
