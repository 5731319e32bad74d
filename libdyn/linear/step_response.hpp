#pragma once
/// Step responses of the control loops of magnetic bearings.

#include <string>
#include <string_view>
#include <vector>

#include "libbase/numerics/constants.hpp"
#include "libbase/structs/column.hpp"
#include "libdyn/system/model.hpp"

namespace whirl::inline dyn {

/// How the place of a sensor answers a step at time 0, all loops closed: of the position that the
/// controller is asked to hold, and of a force at the actuator, along the axis.
struct LoopStep {
  std::string bearing;         ///< or support with sensors
  long axis = 1;               ///< number of the sensor, from 1
  Vec reference;               ///< displacement by a step of the reference of 1 [m/m]
  Vec force;                   ///< displacement by a step of the force of 1 N [m/N]
  double reference_end = nan;  ///< to which it tends [m/m]; NaN: to none
  double force_end = nan;      ///< likewise [m/N]
  double overshoot = nan;      ///< of the reference, beyond its end and over it
  double rise_time = nan;      ///< from 10 to 90 % of the end [s]
  double settling_time = nan;  ///< after which it stays within 2 % of the end [s]; NaN: not yet
  double force_largest = nan;  ///< largest displacement by the force [m/N]

  std::string label() const { return bearing + " " + std::to_string(axis); }

  static constexpr auto columns() {
    using L = LoopStep;
    return ColumnList{
        column("bearing", &L::bearing, "", "magnetic bearing, or support with sensors"),
        column("axis", &L::axis, "", "number of the sensor"),
        column("overshoot", &L::overshoot, "", "of a step of the reference, over its end"),
        column("rise_time", &L::rise_time, "s", "from 10 to 90 % of the end"),
        column("settling_time", &L::settling_time, "s", "until it stays within 2 % of the end"),
        column("reference_end", &L::reference_end, "", "displacement over reference in the end"),
        column("force_end", &L::force_end, "m/N", "displacement over force in the end"),
        column("force_largest", &L::force_largest, "m/N", "largest displacement over force"),
        column("reference", &L::reference, "", "displacement over a step of the reference")
            .along("step_times")
            .as("reference"),
        column("force", &L::force, "m/N", "displacement over a step of the force")
            .along("step_times")
            .as("force")};
  }
};

/// Step responses at a speed; group /step_response.
struct StepResponse {
  double speed = 0.0;         ///< [rad/s]
  std::vector<double> times;  ///< [s], from 0
  std::vector<LoopStep> steps;

  static constexpr std::string_view group = "/step_response";
  static constexpr auto columns() {
    using enum Written;
    return ColumnList{column("speed", &StepResponse::speed, "rad/s", "rotor speed").only(in_file),
                      column("time", &StepResponse::times, "s", "time after the step")
                          .axis("step_times+")
                          .within(valid::finite)
                          .as("times_s"),
                      rows(&StepResponse::steps, "steps+")};
  }
};

/// Step responses of all loops, of the rotor as the model reduces it, by the exponential of its
/// equations. Limits of currents and voltages are left out.
///
/// @param duration  above 0 [s]
/// @param count     instants after the step
/// @throws ModelError  for a model without sensors
StepResponse step_response(const Model& model, double duration, int count = 1000);

}  // namespace whirl::inline dyn
