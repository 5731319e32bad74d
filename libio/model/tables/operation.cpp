#include <fmt/format.h>

#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"

namespace whirl::inline io {

namespace {

/// Speeds of a machine: none may be above the next one.
void read_machine_speeds(TableReader& table, MachineSpeeds& s) {
  s = {};
  table.read(s);
  const auto check = [&](const char* key, double low, double high, const char* above) {
    if (low > 0.0 && high > 0.0 && low > high) {
      table.problem(key, fmt::format("is above {}", above));
    }
  };
  check("minimum_speed", s.minimum, s.maximum, "maximum_speed");
  check("minimum_speed", s.minimum, s.trip, "trip_speed");
  check("maximum_speed", s.maximum, s.trip, "trip_speed");
}

void read_operation(ModelReading& reading) {
  TableReader table = reading.table("operation");
  if (const auto speed = table.quantity("speed", "rad/s", Range::nonnegative)) {
    reading.model.speed = *speed;
    reading.model.has_speed = true;
  }
  read_machine_speeds(table, reading.model.machine);
  table.finish();
}

}  // namespace

ModelTable operation_table() {
  return {.name = "operation",
          .meaning = "how the rotor is run",
          .form = ModelTable::Form::one,
          .read = read_operation,
          .is_of_rotor = false,
          .notes = {{"speed", "spin about +z"}}};
}

}  // namespace whirl::inline io
