#pragma once

#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

#include "libcontact/geometry.hpp"

namespace whirl::inline contact::geometry {

/// Where a race is not round: how far it stands out towards the elements, over the angle a on it.
///
///   waves:  height cos(order (a - angle))
///   spall:  height exp(sharpness (cos(a - angle) - 1)),   height < 0
///
/// A spall has no edge, so that the force has a Taylor series everywhere; half its depth is left at
/// half its width w where sharpness = ln 2 / (1 - cos(w / 2)).
struct RaceShape {
  bool is_inner = false;   ///< of the race of `at`, else of that of `against`
  double height = 0.0;     ///< [m]
  double order = 1.0;      ///< waves around the race
  double angle = 0.0;      ///< of the top of a wave, or of the middle of a spall, at time 0 [rad]
  double sharpness = 0.0;  ///< of a spall; 0: waves

  // as one element sees it: order (a - angle) = start + what `ratio` times the phase is
  double start = 0.0;  ///< [rad]
  double ratio = 0.0;  ///< to the rate of the phase
  double speed = 0.0;  ///< [rad/s]

  bool is_spall() const { return sharpness > 0.0; }
  double angle_at(const Instant& at) const { return start + whirl::angle_at(ratio, at); }
  /// How far it may stand out [m].
  double top() const { return is_spall() ? std::max(height, 0.0) : std::abs(height); }
  bool operator==(const RaceShape&) const = default;
};

/// The gap to an element on round races, of numbers that may have slopes.
///
/// @param along    angle of the element [rad]
/// @param turning  speed of the cage [rad/s]
template <class T>
ContactGap<T> gap_to_element(const GapMotion<T>& m, const T& along, const T& turning,
                             const T& play) {
  using std::cos, std::sin;
  ContactGap<T> g;
  g.r = T(std::numeric_limits<double>::infinity());
  g.n = {cos(along), sin(along)};
  const auto t = g.t();
  g.depth = (g.n[0] * m.d[0] + g.n[1] * m.d[1]) - play;
  g.rate = (g.n[0] * m.w[0] + g.n[1] * m.w[1]) + turning * (t[0] * m.d[0] + t[1] * m.d[1]);
  g.slip = t[0] * m.v[0] + t[1] * m.v[1];
  return g;
}
/// Adds what stands out of a race, at the angle that its shape has under the element.
template <class T>
void add_shape(ContactGap<T>& g, const T& height, const T& at, const T& speed, const T& sharpness) {
  using std::cos, std::exp, std::sin;
  if (!(value_of(sharpness) > 0.0)) {
    g.depth = g.depth + height * cos(at);
    g.rate = g.rate - height * sin(at) * speed;
    return;
  }
  const T left = height * exp(sharpness * (cos(at) - T(1.0)));
  g.depth = g.depth + left;
  g.rate = g.rate - left * sharpness * sin(at) * speed;
}

/// Balls or rollers between two races, evenly spaced by a cage that turns; a place for each.
///
///   depth = n . d - play + heights,   n = (cos, sin)(cage angle + that of the element)
///
/// The elements have no inertia and roll: the force is along n. The cage turns with
///
///   w_cage = w_against + cage (w_at - w_against),   cage = (1 - q) / 2,   q = D_e cos(a) / D_p
///
/// in which D_e is the diameter of the elements, D_p that of their pitch circle, a the contact
/// angle. Both races stand at the angle 0 at time 0, element 0 at `first`.
///
/// @source [Harris2006], ch. 10 for the kinematics of rolling without slip
struct RollingElements {
  static constexpr std::string_view name = "rolling-elements";
  static constexpr Closing closing = Closing::lateral;
  static constexpr bool rubs_apart = false;
  static constexpr bool may_stick = false;
  static constexpr bool takes_offset = true;
  static constexpr bool turns = true;
  static constexpr bool is_wall = false;

  int elements = 1;
  double play = 0.0;   ///< that an element has, radially [m]; below zero: it is preloaded
  double cage = 0.5;   ///< speed of the cage past `against` over that of `at` past it
  double first = 0.0;  ///< angle of element 0 at time 0 [rad]
  std::vector<RaceShape> shapes{};

  // of one element, at a spin
  double angle = 0.0;  ///< at time 0 [rad]
  double ratio = 0.0;  ///< of the cage's speed to the rate of the phase
  double speed = 0.0;  ///< of the cage [rad/s]

  int places() const { return elements; }
  RollingElements place(int i, const PartSpeeds& s) const {
    RollingElements one = *this;
    const double turning = s.against + cage * (s.at - s.against);
    one.angle = first + 2.0 * std::numbers::pi * i / elements;
    one.ratio = turning / s.phase_rate;
    one.speed = turning;
    for (RaceShape& shape : one.shapes) {
      const double past = shape.order * (turning - (shape.is_inner ? s.at : s.against));
      shape.start = shape.order * (one.angle - shape.angle);
      shape.ratio = past / s.phase_rate;
      shape.speed = past;
    }
    return one;
  }
  double arm() const { return 1.0; }
  double tip_radius() const { return 0.0; }
  std::optional<double> rim_radius() const { return 0.0; }
  std::optional<Vec2> direction() const { return std::nullopt; }
  bool operator==(const RollingElements&) const = default;

  template <class T>
  ContactGap<T> gap(const ContactSpace&, const Instant& at, const GapMotion<T>& m) const {
    ContactGap<T> g = gap_to_element(m, T(angle + angle_at(ratio, at)), T(speed), T(play));
    for (const RaceShape& shape : shapes) {
      add_shape(g, T(shape.height), T(shape.angle_at(at)), T(shape.speed), T(shape.sharpness));
    }
    return g;
  }
  double beyond(const ContactGap<double>& gap, const ContactSpace& space) const {
    return gap.depth / space.clearance;
  }
  std::optional<Polynomial> beyond(const PathPowers&, const PathPowers&) const {
    return std::nullopt;  // it turns
  }
};

/// How far the inner race may move from the middle before any element is pressed [m]; at most zero
/// where one always may be.
inline double slack_of(const RollingElements& row) {
  double left = row.play;
  for (const RaceShape& shape : row.shapes) left -= shape.top();
  return left;
}

}  // namespace whirl::inline contact::geometry
