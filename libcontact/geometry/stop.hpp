#pragma once

#include <limits>
#include <tuple>

#include "libbase/structs/field.hpp"
#include "libcontact/geometry.hpp"

namespace whirl::inline contact::geometry {

/// A flat stop, as snubbers and bumpers are: a plane along the shaft, met in one direction.
///
///   depth = n . d - clearance,   n = (cos angle, sin angle),   slip = rim_speed + t . v
///
/// Its normal does not turn with the displacement: friction sticks on a straight line.
struct Stop {
  static constexpr std::string_view name = "stop";
  static constexpr Closing closing = Closing::lateral;
  static constexpr bool rubs_apart = false;
  static constexpr bool may_stick = true;
  static constexpr bool takes_offset = true;
  static constexpr bool turns = false;
  static constexpr bool is_wall = false;

  double angle = 0.0;  ///< of n, from +x to +y [rad]

  static constexpr auto fields() {
    using enum Range;
    return std::tuple{
        required("angle", &Stop::angle, "rad", any, "of a flat stop: where it is, from +x to +y")};
  }

  int places() const { return 1; }
  Stop place(int, const PartSpeeds&) const { return *this; }
  double arm() const { return 1.0; }
  double tip_radius() const { return 0.0; }
  std::optional<double> rim_radius() const { return std::nullopt; }
  std::optional<Vec2> direction() const { return Vec2(std::cos(angle), std::sin(angle)); }
  bool operator==(const Stop&) const = default;

  template <class T>
  ContactGap<T> gap(const ContactSpace& space, const Instant&, const GapMotion<T>& m) const {
    const Vec2 n = *direction();
    ContactGap<T> g;
    g.r = T(std::numeric_limits<double>::infinity());
    g.n = {T(n(0)), T(n(1))};
    const auto t = g.t();
    g.depth = (g.n[0] * m.d[0] + g.n[1] * m.d[1]) - space.clearance;
    g.rate = g.n[0] * m.w[0] + g.n[1] * m.w[1];
    g.slip = space.rim_speed + (t[0] * m.v[0] + t[1] * m.v[1]);
    return g;
  }
  double beyond(const ContactGap<double>& gap, const ContactSpace& space) const {
    return gap.depth / space.clearance;
  }
  std::optional<Polynomial> beyond(const PathPowers& x, const PathPowers& y) const {
    const Vec2 n = *direction();
    Polynomial g;
    g.degree = static_cast<int>(x.size()) - 1;
    for (int k = 0; k <= g.degree; ++k) {
      g.c[static_cast<std::size_t>(k)] = n(0) * x(k) + n(1) * y(k);
    }
    g.c[0] -= 1.0;
    return g;
  }
};

}  // namespace whirl::inline contact::geometry
