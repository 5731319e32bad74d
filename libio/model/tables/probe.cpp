#include <fmt/format.h>

#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"
#include "libio/model/read_parts.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

namespace {

void read_probes(ModelReading& reading) {
  reading.for_each("probe", [&](TableReader& table, std::size_t i) {
    Probe probe{.name = table.string("name").value_or(fmt::format("probe {}", i + 1))};
    if (table.has("name") && probe.name.empty()) {
      table.problem("name", "a probe needs a name that is not empty");
    }
    if (const auto at = reading.station(table)) probe.at = *at;
    table.read(probe);
    const auto unit = parse_as("1 " + probe.unit, "m");
    if (!unit || probe.unit.empty()) {
      table.problem("unit", fmt::format("found {}, expected a unit of length, such as \"um\", "
                                        "\"mil\" or \"mm\"",
                                        in_quotes(probe.unit)));
    }
    if (probe.is_axial()) need_tilts(reading, table, "face_radius", probe.at);
    reading.model.structure.probes.push_back(probe);
  });
}

}  // namespace

ModelTable probe_table() {
  return {.name = "probe",
          .meaning = "displacement probes, along which responses and motions are told",
          .read = read_probes,
          .example =
              "body = \"b\"\n"
              "angle = 0\n"};
}

}  // namespace whirl::inline io
