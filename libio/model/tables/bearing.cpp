#include "libio/model/read_connections.hpp"

namespace whirl::inline io {

namespace {

void read_bearings(ModelReading& reading) {
  read_connections(reading, "bearing", reading.model.structure.bearings);
}

}  // namespace

ModelTable bearing_table() {
  return connection_table("bearing", "linear bearings, from a station to the ground or to a body",
                          read_bearings);
}

}  // namespace whirl::inline io
