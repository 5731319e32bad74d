#pragma once

#include <limits>

#include "libcontact/geometry.hpp"

namespace whirl::inline contact::geometry {

/// A limit of a signal, as of the current of a magnetic bearing: what is beyond it acts as the
/// force of a contact does, on what the signal would move. Two places, one above and one below.
///
///   depth = n . (d + v) - clearance,   n = (+-1, 0)
///
/// in which d + v is the signal, times clearance over limit: of displacements (d) and rates (v).
struct Saturation {
  static constexpr std::string_view name = "saturation";
  static constexpr Closing closing = Closing::lateral;
  static constexpr bool rubs_apart = true;
  static constexpr bool reads_rates = true;
  static constexpr bool may_stick = false;
  static constexpr bool takes_offset = false;
  static constexpr bool turns = false;
  static constexpr bool is_wall = false;

  double side = 1.0;  ///< n_x

  int places() const { return 2; }
  Saturation place(int i, const PartSpeeds&) const { return {i == 0 ? 1.0 : -1.0}; }
  double arm() const { return 1.0; }
  double tip_radius() const { return 0.0; }
  std::optional<double> rim_radius() const { return 0.0; }
  std::optional<Vec2> direction() const { return Vec2(side, 0.0); }
  bool operator==(const Saturation&) const = default;

  /// The rate is left out: no law of a limit asks for it.
  template <class T>
  ContactGap<T> gap(const ContactSpace& space, const Instant&, const GapMotion<T>& m) const {
    ContactGap<T> g;
    g.r = T(std::numeric_limits<double>::infinity());
    g.n = {T(side), T(0.0)};
    g.depth = side * (m.d[0] + m.v[0]) - space.clearance;
    g.rate = T(0.0);
    g.slip = T(0.0);
    return g;
  }
  double beyond(const ContactGap<double>& gap, const ContactSpace& space) const {
    return gap.depth / space.clearance;
  }
  /// A path of displacements does not tell the signal.
  std::optional<Polynomial> beyond(const PathPowers&, const PathPowers&) const {
    return std::nullopt;
  }
};

}  // namespace whirl::inline contact::geometry
