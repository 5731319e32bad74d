#pragma once
/// Ball and roller bearings, as the model file says them, and what their elements are pressed with.

#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

#include "libbase/structs/field.hpp"
#include "libcontact/contact.hpp"

namespace whirl::inline contact {

enum class ElementKind { ball, roller };
constexpr auto choices(ElementKind) {
  return std::array{Choice<ElementKind>{"ball", ElementKind::ball},
                    Choice<ElementKind>{"roller", ElementKind::roller}};
}

enum class Race { inner, outer };
constexpr auto choices(Race) {
  return std::array{Choice<Race>{"inner", Race::inner}, Choice<Race>{"outer", Race::outer}};
}

/// Waves around a race.
struct RaceWaves {
  Race race = Race::inner;
  double order = 0.0;   ///< how many there are around the race
  double height = 0.0;  ///< amplitude [m]
  double angle = 0.0;   ///< of a top, at time 0 [rad]

  static constexpr auto fields() {
    using enum Range;
    return std::tuple{
        required("race", &RaceWaves::race, "", any, "which has the waves"),
        required("order", &RaceWaves::order, "", positive, "how many around the race"),
        required("height", &RaceWaves::height, "m", positive, "their amplitude"),
        optional("angle", &RaceWaves::angle, "rad", any, "of a top at time 0, from +x to +y")};
  }
};

/// A place of a race whose surface has broken out.
struct RaceSpall {
  Race race = Race::outer;
  double angle = 0.0;  ///< of its middle at time 0 [rad]
  double width = 0.0;  ///< angle between the places of half its depth [rad]
  double depth = 0.0;  ///< [m]

  static constexpr auto fields() {
    using enum Range;
    return std::tuple{
        required("race", &RaceSpall::race, "", any, "which has the spall"),
        required("width", &RaceSpall::width, "rad", positive,
                 "angle between the places where half of its depth is left, up to 90 deg"),
        required("depth", &RaceSpall::depth, "m", positive, "of its middle"),
        optional("angle", &RaceSpall::angle, "rad", any, "of its middle at time 0, from +x to +y")};
  }
};

/// A rolling bearing. The inner ring is at `at`.
struct RollingBearing {
  ElementKind kind = ElementKind::ball;
  int elements = 0;
  double pitch_diameter = 0.0;    ///< of the circle on which the elements are [m]
  double element_diameter = 0.0;  ///< [m]
  double contact_angle = 0.0;     ///< [rad]
  double clearance = 0.0;         ///< diametral [m]
  double preload = 0.0;           ///< interference on the diameter [m]
  double cage_ratio = 0.0;        ///< 0: that of pure rolling
  double cage_angle = 0.0;        ///< of an element at time 0 [rad]
  double damping = 0.0;           ///< between the rings, in x and in y [N.s/m]

  // stiffness of an element between both races
  double hertz_stiffness = 0.0;  ///< of balls [N/m^1.5]
  double line_stiffness = 0.0;   ///< of rollers, at 1 um [N/m]
  double inner_groove = 0.0;     ///< radius of curvature across the race of balls [m]
  double outer_groove = 0.0;     ///< the same
  double roller_length = 0.0;    ///< [m]
  double young = 207e9, poisson = 0.3;

  static constexpr auto fields() {
    using enum Range;
    using B = RollingBearing;
    return std::tuple{
        optional("kind", &B::kind, "", any, "what rolls"),
        required("elements", &B::elements, "", positive, "how many balls or rollers, 3 to 200"),
        alternative("pitch_diameter", &B::pitch_diameter, "m", positive,
                    "of the circle of the elements' centers"),
        alternative("element_diameter", &B::element_diameter, "m", positive, "of a ball or roller"),
        optional("contact_angle", &B::contact_angle, "rad", nonnegative,
                 "from the plane of the bearing to the line on which a ball is pressed, below 80 "
                 "deg"),
        optional("clearance", &B::clearance, "m", nonnegative,
                 "that the inner ring has, on the diameter"),
        optional("preload", &B::preload, "m", nonnegative,
                 "interference of elements and races on the diameter, in place of a clearance"),
        alternative("cage_ratio", &B::cage_ratio, "", positive,
                    "speed of the cage past the outer ring over that of the inner ring past it, "
                    "below 1; left out: that of pure rolling"),
        optional("cage_angle", &B::cage_angle, "rad", any,
                 "of an element at time 0, from +x to +y"),
        optional("damping", &B::damping, "N.s/m", nonnegative, "between the rings, in x and in y"),
        alternative("hertz_stiffness", &B::hertz_stiffness, "N/m^1.5", positive,
                    "k in Q = k d^1.5 of a ball between both races"),
        alternative("line_stiffness", &B::line_stiffness, "N/m", positive,
                    "k in Q = k d (d / 1 um)^(1/9) of a roller between both races"),
        alternative("inner_groove", &B::inner_groove, "m", positive,
                    "radius of the inner race across its groove, more than half a ball"),
        alternative("outer_groove", &B::outer_groove, "m", positive,
                    "radius of the outer race across its groove, more than half a ball"),
        alternative("roller_length", &B::roller_length, "m", positive,
                    "of rollers of steel, without their rounded ends"),
        optional("E", &B::young, "Pa", positive, "Young's modulus of balls and races"),
        optional("nu", &B::poisson, "", nonnegative, "Poisson's ratio of balls and races")};
  }

  /// q = D cos(alpha) / D_p.
  double diameter_ratio() const {
    return element_diameter * std::cos(contact_angle) / pitch_diameter;
  }
  bool has_cage_ratio() const { return cage_ratio > 0.0; }
};

/// Speed of the cage past the outer ring over that of the inner ring past it.
/// @source [Harris2006], ch. 10
inline double cage_ratio(const RollingBearing& b) {
  return b.has_cage_ratio() ? b.cage_ratio : 0.5 * (1.0 - b.diameter_ratio());
}

/// Ratios of frequencies of a rolling bearing to the speed of the inner ring past the outer one.
struct BearingFrequencies {
  double cage = 0.0;   ///< that of the cage past the outer ring
  double outer = 0.0;  ///< elements that pass a place of the outer race
  double inner = 0.0;  ///< elements that pass a place of the inner race
  double spin = 0.0;   ///< of an element about its own axis; 0: its diameters are not known
};
/// @source [Harris2006], ch. 10
inline BearingFrequencies bearing_frequencies(const RollingBearing& b) {
  const double cage = cage_ratio(b);
  BearingFrequencies f{cage, b.elements * cage, b.elements * (1.0 - cage), 0.0};
  if (b.pitch_diameter > 0.0 && b.element_diameter > 0.0) {
    const double q = b.diameter_ratio();
    f.spin = 0.5 * b.pitch_diameter / b.element_diameter * (1.0 - q * q);
  }
  return f;
}

/// Hertz stiffness k in Q = k d^1.5 of a ball on a race, both of one material [N/m^1.5].
///
///   d = d* (3 Q (1 - nu^2) / (S E))^(2/3) S / 2,   d* = (2 K / pi) (pi / (2 a^2 E_))^(1/3)
///
/// with the sum S of the curvatures and the complete elliptic integrals K and E_ of the modulus
/// (1 - 1 / a^2)^(1/2), where a, the ratio of the axes of the contact, follows from the difference
/// of the curvatures.
///
/// @param along   curvature of the race in the direction of rolling, below zero where hollow [1/m]
/// @param groove  radius of the race across it [m]
/// @source [Harris2006], ch. 6
inline double ball_on_race(double diameter, double along, double groove, double young,
                           double poisson) {
  const double ball = 2.0 / diameter, across = -1.0 / groove;
  const double sum = 2.0 * ball + along + across;
  const double difference = std::abs(along - across) / sum;
  const auto difference_of = [](double a) {  // of an ellipse whose axes have the ratio a > 1
    const double modulus = std::sqrt(1.0 - 1.0 / (a * a));
    const double K = std::comp_ellint_1(modulus), E = std::comp_ellint_2(modulus);
    return ((a * a + 1.0) * E - 2.0 * K) / ((a * a - 1.0) * E);
  };
  double low = 1.0 + 1e-7, high = 1e4;
  for (int i = 0; i < 200 && high - low > 1e-15 * high; ++i) {
    const double middle = std::sqrt(low * high);
    (difference_of(middle) < difference ? low : high) = middle;
  }
  const double modulus = std::sqrt(1.0 - 1.0 / (low * low));
  const double K = std::comp_ellint_1(modulus), E = std::comp_ellint_2(modulus);
  const double star =
      2.0 * K / std::numbers::pi * std::cbrt(std::numbers::pi / (2.0 * low * low * E));
  const double per_two_thirds =
      star * 0.5 * sum * std::cbrt(std::pow(3.0 * (1.0 - poisson * poisson) / (sum * young), 2));
  return std::pow(per_two_thirds, -1.5);
}

/// Force per depth of an element between both races: Q = k d^1.5 of balls [N/m^1.5], k of `Line` of
/// rollers [N/m].
///
///   k = (k_i^(-1/n) + k_o^(-1/n))^(-n),   n = 3/2, 10/9
///
/// A roller of steel on a race gives d = 3.84e-5 Q^0.9 / l^0.8, in N and mm.
///
/// @source [Harris2006], ch. 6 and 7; [Palmgren1959] for rollers
inline double element_stiffness(const RollingBearing& b) {
  if (b.kind == ElementKind::ball) {
    if (b.hertz_stiffness > 0.0) return b.hertz_stiffness;
    const double q = b.diameter_ratio(), size = 2.0 / b.element_diameter;
    const double inner =
        ball_on_race(b.element_diameter, size * q / (1.0 - q), b.inner_groove, b.young, b.poisson);
    const double outer =
        ball_on_race(b.element_diameter, -size * q / (1.0 + q), b.outer_groove, b.young, b.poisson);
    return std::pow(std::pow(inner, -2.0 / 3.0) + std::pow(outer, -2.0 / 3.0), -1.5);
  }
  if (b.line_stiffness > 0.0) return b.line_stiffness;
  const double both = 2.0 * 3.84e-5 / std::pow(1e3 * b.roller_length, 0.8);  // mm per N^0.9
  return std::pow(1e-3 / both, 10.0 / 9.0) / 1e-6;
}

/// What the inner ring feels of a rolling bearing, in the plane: a ball that is pressed with Q at a
/// contact angle pushes with Q cos(alpha), and by a displacement u is pressed by u cos(alpha).
inline Contact contact_of(const RollingBearing& b, const std::vector<RaceWaves>& waves,
                          const std::vector<RaceSpall>& spalls) {
  constexpr double least_length = 1e-6;  // that lengths are compared with where there is no slack
  geometry::RollingElements row{.elements = b.elements,
                                .play = 0.5 * (b.clearance - b.preload),
                                .cage = cage_ratio(b),
                                .first = b.cage_angle};
  for (const RaceWaves& w : waves) {
    row.shapes.push_back({.is_inner = w.race == Race::inner,
                          .height = w.height,
                          .order = w.order,
                          .angle = w.angle});
  }
  for (const RaceSpall& s : spalls) {
    row.shapes.push_back({.is_inner = s.race == Race::inner,
                          .height = -s.depth,
                          .angle = s.angle,
                          .sharpness = std::log(2.0) / (1.0 - std::cos(0.5 * s.width))});
  }
  Contact contact;
  contact.clearance = std::max(std::abs(slack_of(row)), least_length);
  const double k = element_stiffness(b), c = std::cos(b.contact_angle);
  if (b.kind == ElementKind::ball) {
    contact.law = Hertz<>{.k = k * std::pow(c, 2.5)};
  } else {
    contact.law = Line<>{.k = k * c * std::pow(c, 10.0 / 9.0)};
  }
  contact.geometry = std::move(row);
  return contact;
}

}  // namespace whirl::inline contact
