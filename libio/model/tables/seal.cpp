#include "libio/model/read_connections.hpp"

namespace whirl::inline io {

namespace {

void read_seals(ModelReading& reading) {
  read_connections(reading, "seal", reading.model.structure.seals);
}

}  // namespace

ModelTable seal_table() {
  return connection_table("seal", "seals with linear coefficients, likewise", read_seals);
}

}  // namespace whirl::inline io
