#pragma once

#include <cmath>
#include <string>
#include <tuple>
#include <type_traits>

#include "libbase/structs/field.hpp"
#include "libfe/parts/station.hpp"

namespace whirl::inline fe {

/// A displacement probe: it reads the displacement of its station along a direction a across the
/// shaft, x cos a + y sin a. With a radius r it looks along the shaft at a face that turns with it
/// and reads how far the tilts move the face towards +z there: r (theta_x sin a - theta_y cos a).
struct Probe {
  std::string name;
  Station at;
  double angle = 0.0;  ///< of the direction or of the place on the face, from +x towards +y [rad]
  double face_radius = 0.0;  ///< of the place on the face [m]; 0: it looks across the shaft
  std::string unit = "um";   ///< a length, in which people are told what it reads

  bool is_axial() const { return face_radius > 0.0; }

  /// What it reads of a motion.
  /// @param of  gives the motion's component 0 to 3, of x, y, theta_x and theta_y: numbers, which
  ///            may be complex, or arrays of them; only those that the probe sees are asked for
  template <class Of>
  auto reading(const Of& of) const {
    using Value = std::decay_t<decltype(of(0))>;
    if (!is_axial()) return Value(of(0) * std::cos(angle) + of(1) * std::sin(angle));
    return Value(of(2) * (face_radius * std::sin(angle)) - of(3) * (face_radius * std::cos(angle)));
  }

  bool operator==(const Probe&) const = default;

  static constexpr auto fields() {
    using enum Range;
    return std::tuple{
        required("angle", &Probe::angle, "rad", any, "of its direction, from +x towards +y"),
        alternative("face_radius", &Probe::face_radius, "m", positive,
                    "where it looks along the shaft at a face that turns with it"),
        optional("unit", &Probe::unit, "", any, "length that people are told its readings in")};
  }
};

}  // namespace whirl::inline fe
