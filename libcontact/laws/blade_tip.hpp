#pragma once

#include <cmath>
#include <complex>
#include <string_view>
#include <tuple>

#include "libbase/structs/field.hpp"
#include "libcontact/geometry/blade_row.hpp"
#include "libcontact/law.hpp"

namespace whirl::inline contact {

/// The z of z + bend z^3 = d, in closed form.
///
///   z = 3 d sinh(asinh(x) / 3) / x,   x = (3 / 2) (3 bend)^(1/2) d,   bend >= 0
///
/// Like this, no digits cancel where either term is small; a step of Newton's method takes off what
/// the functions have rounded.
///
/// @source [AbramowitzStegun1964], 3.8.2: Cardano's formula with one real root
template <class T, class R>
T indentation_of(const T& d, const R& bend) {
  using std::asinh, std::sinh, std::sqrt;
  const T x = 1.5 * sqrt(3.0 * bend) * d;
  T z = d;
  if (x != T(0.0)) z = d * (3.0 * sinh(asinh(x) / 3.0) / x);
  const T square = bend * (z * z);
  return z - (z + square * z - d) / (1.0 + 3.0 * square);
}
WHIRL_INLINE double indentation(double d, double bend) {
  return indentation_of(d, bend);
}
inline std::complex<double> indentation(const std::complex<double>& d, double bend) {
  return indentation_of(d, bend);
}

/// Tips of blades on a rotor's disk against a ring: Hertz contact in series with the radial
/// shortening of a blade that friction bends.
///
///   d = (N / k)^(2/3) + c_b N^2 = z + b z^3,   N = k z^(3/2),   b = c_b k^2
///
/// c_b: libcontact/blade.hpp. N = 0 at d = 0 with N ~ k d^(3/2) there; far beyond z ~ b^(-1/2) the
/// blade is softer than the contact, N ~ (d / c_b)^(1/2).
///
/// @source [Johnson1985] for Hertz contact
template <class R = double>
struct BladeTip {
  static constexpr std::string_view name = "blade-tip";
  static constexpr bool is_analytic = false;

  int blades = 1;
  double tip_radius = 0.0;         ///< from the rotor's axis to the tips [m]
  double blade_length = 0.0;       ///< of the part that bends [m]
  double bending_stiffness = 0.0;  ///< E I of a blade, in the direction of its motion [N.m^2]
  double line_density = 0.0;       ///< mass per length of a blade [kg/m]
  R k{};                           ///< contact stiffness [N/m^1.5]
  R bend{};                        ///< b = c_b k^2 [1/m^2], from the others, friction and speed

  static constexpr auto fields() {
    using enum Range;
    return std::tuple{
        required("blades", &BladeTip::blades, "", positive, "how many, evenly spaced"),
        required("tip_radius", &BladeTip::tip_radius, "m", positive,
                 "from the rotor's axis to the tips"),
        required("blade_length", &BladeTip::blade_length, "m", positive,
                 "of the part of a blade that bends"),
        required("blade_bending_stiffness", &BladeTip::bending_stiffness, "N.m^2", positive,
                 "E I of a blade, along the circumference"),
        required("blade_line_density", &BladeTip::line_density, "kg/m", nonnegative,
                 "mass per length of a blade"),
        required("hertz_stiffness", &BladeTip::k, "N/m^1.5", positive,
                 "k in d = (N / k)^(2/3) + c N^2")};
  }
  /// What follows from the fields and the operation.
  static constexpr auto derived() { return std::tuple{&BladeTip::bend}; }

  bool is_continuous() const { return true; }
  geometry::BladeRow own_geometry() const { return {.blades = blades, .tip = tip_radius}; }

  WHIRL_INLINE constexpr auto normal(const auto& d, const auto&) const {
    const auto z = indentation(d, bend);
    return k * (z * depth_root(z));
  }
};

}  // namespace whirl::inline contact
