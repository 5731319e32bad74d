#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"
#include "libio/model/read_parts.hpp"

namespace whirl::inline io {

namespace {

void read_unbalances(ModelReading& reading) {
  reading.for_each("unbalance", [&](TableReader& table, std::size_t) {
    table.string("name");
    const auto at = reading.station(table);
    std::optional<double> mass;
    if (const Body* body = at ? reading.body_at(*at) : nullptr) {
      mass = body->m.x;
      if (!body->spins)
        table.problem("body", "this body does not spin and has no unbalance; give it spins = true");
    }
    const auto u = read_unbalance(table, at.value_or(Station{}), mass);
    if (at && u) reading.model.structure.unbalances.push_back(*u);
  });
}

}  // namespace

ModelTable unbalance_table() {
  return {.name = "unbalance",
          .meaning = "masses off the axis",
          .read = read_unbalances,
          .example =
              "body = \"b\"\n"
              "moment = 1\n"};
}

}  // namespace whirl::inline io
