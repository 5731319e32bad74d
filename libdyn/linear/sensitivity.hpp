#pragma once
/// Sensitivity of the control loops of magnetic bearings.

#include <string>
#include <string_view>
#include <vector>

#include "libbase/numerics/constants.hpp"
#include "libbase/structs/column.hpp"
#include "libfe/assembly/assemble.hpp"

namespace whirl::inline dyn {

/// The loop of one sensor, all other loops closed.
///
/// A disturbance d that is added to the signal x of the sensor makes the controller see e = d + x:
/// S = e / d is its sensitivity, and L = 1 / S - 1 its open loop, as it is measured.
struct LoopSensitivity {
  std::string bearing;      ///< or support with sensors
  long axis = 1;            ///< number of the sensor, from 1
  double largest = nan;     ///< of |S|
  double largest_at = nan;  ///< [rad/s]
  std::string zone;         ///< A, B, C or D, see sensitivity_zone
  CVec sensitivity;         ///< S
  CVec open_loop;           ///< L

  std::string label() const { return bearing + " " + std::to_string(axis); }

  static constexpr auto columns() {
    using L = LoopSensitivity;
    return ColumnList{
        column("bearing", &L::bearing, "", "magnetic bearing, or support with sensors"),
        column("axis", &L::axis, "", "number of the sensor"),
        column("largest", &L::largest, "", "largest size of the sensitivity"),
        column("largest_at", &L::largest_at, "rad/s", "its frequency").as("largest_at_rpm"),
        column("zone", &L::zone, "", "zone by the largest sensitivity"),
        column("sensitivity", &L::sensitivity, "", "what the controller sees by what is added")
            .along("frequencies")
            .as("sensitivity"),
        column("open_loop", &L::open_loop, "", "open loop, all others closed")
            .along("frequencies")
            .as("open_loop")};
  }
};

/// Sensitivities at a speed; group /sensitivity.
struct Sensitivity {
  double speed = 0.0;               ///< [rad/s]
  std::vector<double> frequencies;  ///< [rad/s]
  std::vector<LoopSensitivity> loops;

  static constexpr std::string_view group = "/sensitivity";
  static constexpr auto columns() {
    using enum Written;
    return ColumnList{
        column("speed", &Sensitivity::speed, "rad/s", "rotor speed").only(in_file),
        column("frequency", &Sensitivity::frequencies, "rad/s", "frequency of the disturbance")
            .axis("frequencies+")
            .within(valid::finite)
            .as("frequencies_rpm"),
        rows(&Sensitivity::loops, "loops+")};
  }
};

/// Upper limits of zones A, B and C of the largest sensitivity: 3, 4 and 5, that is 9.5, 12 and 14
/// dB. Newly commissioned machines are in A, machines that may run without end in A or B, those in
/// C only until they can be mended.
/// @source ISO 14839-3, as programs quote it: the standard itself was not at hand
inline constexpr double zone_limits[] = {3.0, 4.0, 5.0};
std::string sensitivity_zone(double largest);

/// Sensitivity of every loop over frequencies; its largest value is sought between them, too.
///
/// @param Omega        spin speed [rad/s]
/// @param frequencies  above 0, ascending [rad/s]
/// @throws ModelError  for a structure without sensors
Sensitivity loop_sensitivity(const Assembler& assembler, double Omega,
                             const std::vector<double>& frequencies);

}  // namespace whirl::inline dyn
