#pragma once
/// A pair of gears between two shafts.

#include <numbers>
#include <string>
#include <tuple>

#include "libbase/error.hpp"
#include "libbase/structs/field.hpp"
#include "libfe/parts/station.hpp"

namespace whirl::inline fe {

/// External gears on two shafts, whose teeth are a spring and a damper along the line of action.
struct GearPair {
  std::string name;
  Station driving, driven;
  double stiffness = 0.0;  ///< of the mesh, normal to the teeth, mean over a pitch [N/m]
  double damping = 0.0;    ///< along the same line [N.s/m]
  double driving_radius = 0.0, driven_radius = 0.0;  ///< of the pitch circles [m]
  double centers = 0.0;  ///< direction from the driving to the driven center, from +x [rad]
  double pressure_angle = std::numbers::pi / 9.0;  ///< normal to the teeth [rad]
  double helix_angle = 0.0;                        ///< of the driving gear; > 0: right-handed [rad]
  Where where{};

  bool operator==(const GearPair&) const = default;

  static constexpr auto fields() {
    using enum Range;
    return std::tuple{
        required("stiffness", &GearPair::stiffness, "N/m", positive,
                 "of the mesh, normal to the teeth, mean over a pitch"),
        optional("damping", &GearPair::damping, "N.s/m", nonnegative, "along the same line"),
        required("driving_radius", &GearPair::driving_radius, "m", positive,
                 "of the driving gear's pitch circle"),
        required("driven_radius", &GearPair::driven_radius, "m", positive,
                 "of the driven gear's pitch circle"),
        optional("centers", &GearPair::centers, "rad", any,
                 "direction from the driving to the driven center, from +x to +y"),
        optional("pressure_angle", &GearPair::pressure_angle, "rad", nonnegative,
                 "normal to the teeth"),
        optional("helix_angle", &GearPair::helix_angle, "rad", any,
                 "of the driving gear at its pitch circle; > 0: right-handed")};
  }
};

}  // namespace whirl::inline fe
