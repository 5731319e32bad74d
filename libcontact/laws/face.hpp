#pragma once

#include <string_view>
#include <tuple>

#include "libbase/structs/field.hpp"
#include "libcontact/geometry/face.hpp"
#include "libcontact/law.hpp"

namespace whirl::inline contact {

/// Axial contact of a disk's rim with a plane across the shaft.
///
///   N = k d,   d = radius |theta| - clearance
///
/// The rim's largest axial displacement is where a = radius (-theta_y, theta_x) points; N presses
/// there, along z, and so acts on the tilts as the moment that turns them back. Friction acts on
/// the rim there, against the spin: -mu N t on the lateral displacement, t = (-a_y, a_x) / |a|. Its
/// moment about z is left to the drive. The rotor does not move along z.
///
/// @source a rigid disk and a plane, to first order in the tilts
template <class R = double>
struct Face {
  static constexpr std::string_view name = "face";
  static constexpr bool is_analytic = true;

  R k{};                ///< contact stiffness [N/m]
  double radius = 0.0;  ///< of the rim that touches [m]

  static constexpr auto fields() {
    using enum Range;
    return std::tuple{required("stiffness", &Face::k, "N/m", positive, "k in N = k d, axial"),
                      required("face_radius", &Face::radius, "m", positive,
                               "of the rim that touches, r in d = r |theta| - clearance")};
  }

  bool is_continuous() const { return true; }
  geometry::Face own_geometry() const { return {radius}; }

  WHIRL_INLINE constexpr auto normal(const auto& d, const auto&) const { return k * d; }
};

}  // namespace whirl::inline contact
