#pragma once

#include "libcontact/geometry.hpp"

namespace whirl::inline contact::geometry {

/// A disk's rim on a plane across the shaft: tilts times its radius against an axial clearance.
///
/// The normal force acts on the tilts; friction on the lateral displacement, whose rate is in the
/// slip.
///
/// @source a rigid disk and a plane, to first order in the tilts (libcontact/laws/face.hpp)
struct Face {
  static constexpr std::string_view name = "face";
  static constexpr Closing closing = Closing::tilts;
  static constexpr bool rubs_apart = true;
  static constexpr bool may_stick = false;
  static constexpr bool takes_offset = false;
  static constexpr bool turns = false;
  static constexpr bool is_wall = false;

  double radius = 0.0;  ///< of the rim [m]

  int places() const { return 1; }
  Face place(int, const PartSpeeds&) const { return *this; }
  double arm() const { return radius; }
  double tip_radius() const { return 0.0; }
  std::optional<double> rim_radius() const { return radius; }
  std::optional<Vec2> direction() const { return std::nullopt; }

  bool operator==(const Face&) const = default;

  template <class T>
  ContactGap<T> gap(const ContactSpace& space, const Instant&, const GapMotion<T>& m) const {
    return gap_to_circle(m, space.clearance, space.rim_speed);
  }
  double beyond(const ContactGap<double>& gap, const ContactSpace& space) const {
    return (gap.r * gap.r) / (space.clearance * space.clearance) - 1.0;
  }
  std::optional<Polynomial> beyond(const PathPowers& x, const PathPowers& y) const {
    return beyond_unit_circle(x, y);
  }
};

}  // namespace whirl::inline contact::geometry
