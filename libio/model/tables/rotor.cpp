#include <fmt/format.h>

#include <cmath>

#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

namespace {

void read_rotors(ModelReading& reading) {
  reading.for_each("rotor", [&](TableReader& table, std::size_t) {
    Rotor rotor;
    rotor.where = table.where();
    if (const auto name = table.string("name", true)) rotor.name = *name;
    if (table.has("name") &&
        (rotor.name.empty() || rotor.name == "ground" || rotor.name == first_shaft_name)) {
      table.problem("name", fmt::format("found {}, expected a name that is neither empty nor "
                                        "\"ground\" nor \"{}\", which is the first shaft",
                                        in_quotes(rotor.name), first_shaft_name));
    }
    table.read(rotor);
    if (std::abs(rotor.ratio) > 1000.0) {
      table.problem("ratio", fmt::format("found {:g}, expected -1000 to 1000", rotor.ratio));
    }
    reading.model.structure.rotors.push_back(std::move(rotor));
  });
}

}  // namespace

ModelTable rotor_table() {
  return {.name = "rotor",
          .meaning = "further shafts, whose speed has a given ratio to that of the first one",
          .read = read_rotors,
          .turn = ModelTable::Turn::early,
          .example =
              "name = \"outer\"\n"
              "ratio = 1.5\n"};
}

}  // namespace whirl::inline io
