#include <fmt/format.h>

#include <utility>

#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"
#include "libio/model/read_parts.hpp"

namespace whirl::inline io {

namespace {

/// What a force is given by.
struct ForceSize {
  const char* key;
  const char* unit;
  ForceKind kind;
};
constexpr ForceSize force_sizes[] = {{"force", "N", ForceKind::force},
                                     {"moment", "N.m", ForceKind::moment},
                                     {"base_acceleration", "m/s^2", ForceKind::base_acceleration}};

/// @return  false: there is none, or more than one, or it is wrong
bool read_force_size(TableReader& table, Force& to) {
  constexpr auto expected = "one of force (N), moment (N.m) and base_acceleration (m/s^2)";
  const char* found = nullptr;
  bool is_good = true;
  for (const ForceSize& size : force_sizes) {
    const auto value = table.quantity(size.key, size.unit, Range::any);
    if (!table.has(size.key)) continue;
    if (found) {
      table.problem(size.key, fmt::format("found {} too, expected {}", found, expected));
      is_good = false;
    }
    found = size.key;
    to.kind = size.kind;
    to.size = value.value_or(0.0);
    is_good = is_good && value.has_value();
  }
  if (!found) table.missing("force", expected, {"moment", "base_acceleration"});
  return found && is_good;
}

/// How it changes with time.
void read_force_frequency(TableReader& table, Force& to) {
  const auto order = table.quantity("order", "", Range::positive);
  const auto frequency = table.quantity("frequency", "rad/s", Range::positive);
  const auto phase = table.quantity("phase", "rad", Range::any);
  const auto angle = table.quantity("angle", "rad", Range::any);
  const auto turning = table.choice<Turning>("whirl");
  if (table.has("order") && table.has("frequency")) {
    table.problem("frequency",
                  "found order too, expected one of order (of the speed) and frequency (its own)");
  }
  if (!table.has("order") && !table.has("frequency")) {
    for (const char* key : {"phase", "whirl"}) {
      if (table.has(key)) {
        table.problem(key, "a force without order and frequency is constant; give one of them");
      }
    }
  }
  if (table.has("whirl") && table.has("angle")) {
    table.problem("angle", "a force that whirls turns; phase says where it points at t = 0");
  }
  to.order = order.value_or(0.0);
  to.frequency = frequency.value_or(0.0);
  to.phase = phase.value_or(0.0);
  to.angle = angle.value_or(0.0);
  to.turning = turning.value_or(Turning::no);
}

void read_forces(ModelReading& reading) {
  reading.for_each("force", [&](TableReader& table, std::size_t i) {
    Force force{.name = table.string("name").value_or(fmt::format("force {}", i + 1))};
    const bool has_size = read_force_size(table, force);
    force.begins = read_beginning(table);
    read_force_frequency(table, force);
    const bool is_of_base = table.has("base_acceleration");
    std::optional<Station> at;
    if (!is_of_base) {
      at = reading.station(table, {"base_acceleration"});
    } else {
      for (const char* key : {"at", "node", "body"}) {
        if (table.node(key)) {
          table.problem(key, "the base moves under everything: it has no station");
        }
      }
    }
    if (at && force.kind == ForceKind::moment) need_tilts(reading, table, "moment", *at);
    if (at) force.at = *at;
    if (has_size && (at || is_of_base)) reading.model.structure.forces.push_back(std::move(force));
  });
}

}  // namespace

ModelTable force_table() {
  return {.name = "force",
          .meaning =
              "forces that do not follow from the motion: constant, of an order of the speed, or "
              "of a frequency of their own",
          .read = read_forces,
          .example =
              "body = \"b\"\n"
              "force = 1\n",
          .notes = {{"force", "its size"},
                    {"moment", "its size, of a moment about an axis across the shaft"},
                    {"base_acceleration", "of the ground; motions are relative to it"},
                    {"begins",
                     "time or revolutions after the start of the recording of a simulation, "
                     "\"0.5 s\" or \"20 rev\"; left out: it is always there"},
                    {"order", "its frequency over that of the speed"},
                    {"frequency", "of its own, as of a shaker; neither this nor order: constant"},
                    {"angle", "direction of force, axis or acceleration, from +x", "0"},
                    {"whirl", "it turns with the spin or against it; left out: along a direction"},
                    {"phase", "size cos(w t + phase); of one that whirls where it points at t = 0",
                     "0"}}};
}

}  // namespace whirl::inline io
