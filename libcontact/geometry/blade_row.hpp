#pragma once

#include <numbers>

#include "libcontact/geometry.hpp"

namespace whirl::inline contact::geometry {

/// Tips of blades that turn with their shaft, in a circle; one place for each blade.
///
/// A tip is at u + tip (cos, sin)(Omega t + angle): its own velocity is in that of the gap, so that
/// the rim speed in the slip is that of what it touches, sign reversed.
struct BladeRow {
  static constexpr std::string_view name = "blades";
  static constexpr Closing closing = Closing::lateral;
  static constexpr bool rubs_apart = false;
  static constexpr bool may_stick = false;
  static constexpr bool takes_offset = true;
  static constexpr bool turns = true;
  static constexpr bool is_wall = false;

  int blades = 1;
  double tip = 0.0;  ///< from the rotor's axis to the tips [m]

  // of one blade, at a spin
  double cosine = 1.0, sine = 0.0;  ///< of its angle
  double ratio = 0.0;               ///< of its speed to the rate of the phase
  double speed = 0.0;               ///< Omega tip [m/s]

  int places() const { return blades; }
  BladeRow place(int i, const PartSpeeds& s) const {
    const double angle = 2.0 * std::numbers::pi * i / blades;
    return {blades, tip, std::cos(angle), std::sin(angle), s.at / s.phase_rate, s.at * tip};
  }
  double arm() const { return 1.0; }
  double tip_radius() const { return tip; }
  std::optional<double> rim_radius() const { return tip; }
  std::optional<Vec2> direction() const { return std::nullopt; }

  /// From the rotor's axis to the tip.
  Vec2 axis(const Instant& at) const {
    const double turned = angle_at(ratio, at), c = std::cos(turned), s = std::sin(turned);
    return {c * cosine - s * sine, s * cosine + c * sine};
  }

  bool operator==(const BladeRow&) const = default;

  template <class T>
  ContactGap<T> gap(const ContactSpace& space, const Instant& at, const GapMotion<T>& m) const {
    const Vec2 e = axis(at), along(-e(1), e(0));
    GapMotion<T> of_tip = m;
    for (std::size_t i = 0; i < 2; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      of_tip.d[i] = m.d[i] + tip * e(k);
      of_tip.w[i] = m.w[i] + speed * along(k);
    }
    of_tip.v = of_tip.w;
    return gap_to_circle(of_tip, space.clearance + tip, space.rim_speed);
  }
  double beyond(const ContactGap<double>& gap, const ContactSpace& space) const {
    const double circle = space.clearance + tip;
    return gap.depth * (gap.r + circle) / (space.clearance * circle);
  }
  std::optional<Polynomial> beyond(const PathPowers&, const PathPowers&) const {
    return std::nullopt;  // it turns
  }
};

}  // namespace whirl::inline contact::geometry
