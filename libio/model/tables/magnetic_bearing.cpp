#include <fmt/format.h>

#include <numbers>
#include <utility>

#include "libfe/parts/control.hpp"
#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"
#include "libio/model/read_laws.hpp"
#include "libio/model/read_parts.hpp"

namespace whirl::inline io {

namespace {

constexpr long most_pade_order = 20;

/// The actuator of an axis: a force ki i - ks x against the motion x.
struct Actuator {
  double current_stiffness = 0.0;   ///< ki [N/A]
  double negative_stiffness = 0.0;  ///< ks [N/m]
  double angle = 0.0;  ///< of the first axis from +x; the other one is at a right angle

  static constexpr auto fields() {
    using enum Range;
    using A = Actuator;
    return std::tuple{
        required("current_stiffness", &A::current_stiffness, "N/A", positive,
                 "force per control current, of an axis"),
        optional("negative_stiffness", &A::negative_stiffness, "N/m", nonnegative,
                 "force per displacement, away from the center, without control"),
        optional("angle", &A::angle, "rad", any,
                 "of the first axis, from +x to +y; the other one is at a right angle to it")};
  }
};

std::vector<TransferFunction> read_filters(ModelReading& reading, TableReader& table) {
  std::vector<TransferFunction> filters;
  reading.for_each_item(table, "filters", "a list of { kind = ..., frequency = ... }",
                        [&](TableReader& item) {
                          ControlFilter filter;
                          item.read(filter);
                          if (filter.frequency > 0.0) filters.push_back(transfer_function(filter));
                        });
  return filters;
}

/// What is read of the way from sensors to currents.
struct ControlLoop {
  StateSpace control;  ///< to currents, of one axis or of both; without the amplifier where limited
  double amplifier = 0.0;  ///< its bandwidth, where it is apart [rad/s]
  AmplifierLimits limits;
};

/// Whether a limit of voltage has what it needs; what is missing or too much is reported.
bool has_what_limits_need(TableReader& table, const AmplifierLimits& limits,
                          const LoopDynamics& loop) {
  const bool limits_voltage = limits.voltage_limit > 0.0;
  const bool has_coil = limits.inductance > 0.0, has_loop = loop.amplifier_bandwidth > 0.0;
  if (limits_voltage && !has_coil)
    table.missing("inductance", "the inductance of the coil, in H", {});
  if (limits_voltage && !has_loop) {
    table.missing("amplifier_bandwidth",
                  "the bandwidth of the current loop, which asks for the voltage", {});
  }
  for (const char* key : {"inductance", "resistance"}) {
    if (limits_voltage || !table.has(key)) continue;
    table.problem(key, "is needed under voltage_limit only; leave it out");
  }
  return !limits_voltage || (has_coil && has_loop);
}

/// The law from displacements of the sensors to currents [A/m]; nothing: it is wrong, which is
/// reported.
std::optional<ControlLoop> read_control(ModelReading& reading, TableReader& table,
                                        std::size_t item) {
  ControlLoop made;
  PidController pid;
  table.read(pid);
  LoopDynamics loop;
  table.read(loop);
  table.read(made.limits);
  const bool limits_are_complete = has_what_limits_need(table, made.limits, loop);
  if (made.limits.any()) made.amplifier = std::exchange(loop.amplifier_bandwidth, 0.0);
  table.at_most("pade_order", loop.pade_order, most_pade_order);
  const bool has_pid =
      table.has("proportional") || table.has("integral") || table.has("derivative");
  const auto law =
      read_law(reading, table, {"magnetic_bearing", item}, TransferForm::dynamic_stiffness);
  std::vector<TransferFunction> functions = read_filters(reading, table);
  if (loop.pade_order <= most_pade_order) {
    for (TransferFunction& f : transfer_functions(loop)) functions.push_back(std::move(f));
  }
  if (has_pid && has_law(table)) {
    table.problem("proportional",
                  "found a controller twice, expected one: proportional, integral "
                  "and derivative action, or a law");
    return std::nullopt;
  }
  if (!has_pid && !has_law(table)) {
    table.missing("proportional",
                  "a controller: proportional, integral and derivative action, or numerator and "
                  "denominator, poles and residues, A, B, C and D, or a state_space",
                  {"derivative", "numerator", "poles", "A", "state_space"});
  }
  if ((!has_pid && !law) || !limits_are_complete) return std::nullopt;
  try {
    if (law && !table.has("numerator")) {
      made.control = in_series(*law, chain(functions).repeated(law->outputs()));
    } else {
      functions.insert(functions.begin(), has_pid ? transfer_function(pid) : *read_function(table));
      made.control = chain(functions);
    }
    return made;
  } catch (const NumericalError& error) {
    table.problem(has_pid                    ? "proportional"
                  : table.has("state_space") ? "state_space"
                  : table.has("A")           ? "A"
                                             : "numerator",
                  error.what());
    return std::nullopt;
  }
}

/// The force against the motion at the actuator: of the currents, and of the motion itself.
StateSpace force_law(const StateSpace& control, const Actuator& actuator) {
  const auto axes = static_cast<Eigen::Index>(control.outputs());
  const double ki = actuator.current_stiffness;
  StateSpace law;
  law.A = control.A;
  law.B = Mat::Zero(control.states(), 2 * axes);
  law.B.leftCols(axes) = control.B;
  law.C = ki * control.C;
  law.D = Mat(axes, 2 * axes);
  law.D << ki * control.D, -actuator.negative_stiffness * Mat::Identity(axes, axes);
  if (control.D_rate.size() > 0) {
    law.D_rate = Mat::Zero(axes, 2 * axes);
    law.D_rate.leftCols(axes) = ki * control.D_rate;
  }
  return law;
}

/// A limit of currents as one of that law.
SignalLimit of_forces(SignalLimit limit, const Actuator& actuator) {
  const Eigen::Index axes = limit.over_displacements.size();
  for (Vec* row : {&limit.over_displacements, &limit.over_rates}) {
    row->conservativeResizeLike(Vec::Zero(2 * axes));
  }
  limit.to_forces *= actuator.current_stiffness;
  limit.force *= actuator.current_stiffness;
  return limit;
}

void read_magnetic_bearings(ModelReading& reading) {
  reading.for_each("magnetic_bearing", [&](TableReader& table, std::size_t i) {
    Support support;
    support.where = table.where();
    support.name = table.string("name").value_or(fmt::format("magnetic bearing {}", i + 1));
    const auto at = reading.station(table);
    const Station to = other_side(reading, table, at);
    std::optional<Station> sensor = at;
    if (table.node("sensor")) sensor = station_at(reading, table, "sensor", false);
    Actuator actuator;
    table.read(actuator);
    const auto loop = read_control(reading, table, i);
    if (!loop || !at || !sensor) return;
    StateSpace control = loop->control.inputs() == 1 ? loop->control.repeated(2) : loop->control;
    if (control.inputs() != 2 || control.outputs() != 2) {
      table.problem(table.has("state_space") ? "state_space" : "A",
                    fmt::format("the controller has {} displacements and {} currents, "
                                "expected 1 or 2 of both: the axes of the bearing",
                                control.inputs(), control.outputs()));
      return;
    }
    if (loop->limits.any()) {
      try {
        LimitedCurrents limited = limited_currents(control, loop->amplifier, loop->limits);
        control = std::move(limited.law);
        for (SignalLimit& limit : limited.limits) {
          support.limits.push_back(of_forces(std::move(limit), actuator));
        }
      } catch (const NumericalError& error) {
        table.problem("amplifier_bandwidth", error.what());
        return;
      }
    }
    const auto axes = [&](const Station& station) {
      return std::vector{interface_along(station, to, actuator.angle),
                         interface_along(station, to, actuator.angle + 0.5 * std::numbers::pi)};
    };
    support.acts_on = axes(*at);
    support.sees = axes(*sensor);
    support.sensors = 2;
    support.sees.insert(support.sees.end(), support.acts_on.begin(), support.acts_on.end());
    support.law = force_law(control, actuator);
    reading.model.structure.supports.push_back(std::move(support));
  });
}

}  // namespace

ModelTable magnetic_bearing_table() {
  return {
      .name = "magnetic_bearing",
      .meaning = "active magnetic bearings with their controllers",
      .read = read_magnetic_bearings,
      .example =
          "body = \"b\"\n"
          "current_stiffness = 200\n"
          "negative_stiffness = 1e6\n"
          "proportional = 1e4\n"
          "derivative = 20\n",
      .as_tables =
          "sensor = {}\n"
          "filters = [{}]\n",
      .as_values = "sensor = \"\"\n",
      .notes = {{"sensor", "name of a body, or a table with a station; left out: at the bearing"},
                {"filters", "in the loop, one after the other"},
                {"numerator",
                 "of a controller [A/m]: coefficients of powers of s in rad/s, of the "
                 "highest one first"},
                {"denominator", "likewise"},
                {"poles",
                 "of a controller: rows [real part, imaginary part] in rad/s, one of every "
                 "conjugate pair"},
                {"residues", "a row [real part, imaginary part] for each pole"},
                {"A", "of a controller: z' = A z + B u, with displacements u along the axes"},
                {"B", "of the states, a column for each axis"},
                {"C", "i = C z + D u, control currents that act against the motion"},
                {"D", "left out: zero"},
                {"state_space", "file with these matrices, beside the model"}}};
}

}  // namespace whirl::inline io
