#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"
#include "libio/model/read_supports.hpp"

namespace whirl::inline io {

namespace {

void read_seals(ModelReading& reading) {
  read_supports(reading, "seal", reading.model.structure.seals);
}

}  // namespace

ModelTable seal_table() {
  return {.name = "seal",
          .meaning = "seals with linear coefficients, likewise",
          .read = read_seals,
          .example =
              "body = \"b\"\n"
              "stiffness = 1\n",
          .switches = {{"kind"}},
          .notes = {{"kind", "how its coefficients are given; left out: told by the other keys"}}};
}

}  // namespace whirl::inline io
