#include <fmt/format.h>

#include <numbers>

#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"
#include "libio/model/read_parts.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

namespace {

void read_unbalances(ModelReading& reading) {
  reading.for_each("unbalance", [&](TableReader& table, std::size_t) {
    const auto name = table.string("name");
    const Beginning begins = read_beginning(table);
    const auto at = reading.station(table);
    std::optional<double> mass;
    if (const Body* body = at ? reading.body_at(*at) : nullptr) {
      mass = body->m.x;
      if (!body->spins)
        table.problem("body", "this body does not spin and has no unbalance; give it spins = true");
    }
    auto u = read_unbalance(table, at.value_or(Station{}), mass);
    if (!at || !u) return;
    u->begins = begins;
    u->name = name.value_or("");
    reading.model.structure.unbalances.push_back(*u);
  });
}

}  // namespace

ModelTable unbalance_table() {
  return {.name = "unbalance",
          .meaning = "masses off the axis",
          .read = read_unbalances,
          .example =
              "body = \"b\"\n"
              "moment = 1\n",
          .notes = {{"begins",
                     "time or revolutions after the start of the recording of a simulation, "
                     "\"0.5 s\" or \"20 rev\"; left out: it is always there"}}};
}

}  // namespace whirl::inline io
