#pragma once

#include <span>
#include <string_view>
#include <tuple>

#include "libbase/structs/field.hpp"
#include "libfe/parts/bearings/coefficients.hpp"

namespace whirl::inline fe {

/// A bearing whose coefficients are the same at every speed.
struct ConstantBearing {
  static constexpr std::string_view name = "constant";
  static constexpr std::string_view told_by = "";

  Mat2 K = Mat2::Zero();   ///< stiffness [N/m]
  Mat2 C = Mat2::Zero();   ///< damping [N.s/m]
  Mat2 Kt = Mat2::Zero();  ///< tilt stiffness [N.m/rad]
  Mat2 Ct = Mat2::Zero();  ///< tilt damping [N.m.s/rad]
  Mat2 M = Mat2::Zero();   ///< added mass [kg]

  bool operator==(const ConstantBearing&) const = default;

  static constexpr auto fields() {
    using enum Range;
    constexpr std::string_view lateral = "one value, or xx, yy, xy, yx";
    constexpr std::string_view tilts = "of theta_x and theta_y: one value, or xx, yy, xy, yx";
    return std::tuple{
        optional("stiffness", &ConstantBearing::K, "N/m", nonnegative, lateral),
        optional("damping", &ConstantBearing::C, "N.s/m", nonnegative, lateral),
        optional("tilt_stiffness", &ConstantBearing::Kt, "N.m/rad", nonnegative, tilts),
        optional("tilt_damping", &ConstantBearing::Ct, "N.m.s/rad", nonnegative, tilts),
        optional("added_mass", &ConstantBearing::M, "kg", nonnegative,
                 "of the fluid, without weight: one value, or xx, yy, xy, yx")};
  }

  BearingCoefficients at(double /*Omega*/, double /*omega*/) const { return {K, C, Kt, Ct, M}; }
  bool depends_on_speed() const { return false; }
  bool depends_on_whirl() const { return false; }
  std::span<const double> speeds() const { return {}; }
  std::span<const double> whirls() const { return {}; }
};

/// The bearing that has these coefficients at every speed.
inline ConstantBearing constant_bearing(const BearingCoefficients& c) {
  return {c.K, c.C, c.Kt, c.Ct, c.M};
}

}  // namespace whirl::inline fe
