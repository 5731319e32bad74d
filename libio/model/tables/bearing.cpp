#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"
#include "libio/model/read_supports.hpp"

namespace whirl::inline io {

namespace {

void read_bearings(ModelReading& reading) {
  read_supports(reading, "bearing", reading.model.structure.bearings);
}

}  // namespace

ModelTable bearing_table() {
  return {.name = "bearing",
          .meaning = "linear bearings, from a station to the ground or to a body",
          .read = read_bearings,
          .example =
              "body = \"b\"\n"
              "stiffness = 1\n",
          .switches = {{"kind"}},
          .notes = {{"kind", "how its coefficients are given; left out: told by the other keys"}}};
}

}  // namespace whirl::inline io
