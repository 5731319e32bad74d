#pragma once

#include <tuple>

#include "libcontact/geometry.hpp"

namespace whirl::inline contact::geometry {

/// A circle in a circle: lateral displacement against a radial clearance.
struct Ring {
  static constexpr std::string_view name = "ring";
  static constexpr Closing closing = Closing::lateral;
  static constexpr bool rubs_apart = false;
  static constexpr bool may_stick = true;
  static constexpr bool takes_offset = true;
  static constexpr bool turns = false;
  static constexpr bool is_wall = false;

  static constexpr auto fields() { return std::tuple{}; }

  int places() const { return 1; }
  Ring place(int, const PartSpeeds&) const { return *this; }
  double arm() const { return 1.0; }
  double tip_radius() const { return 0.0; }
  std::optional<double> rim_radius() const { return std::nullopt; }
  std::optional<Vec2> direction() const { return std::nullopt; }

  bool operator==(const Ring&) const = default;

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
