#pragma once

#include <array>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline fe {

/// Linear coefficients of a bearing, seal or link.
///
///   force on `from`  = -K (u_from - u_to) - C (u_from' - u_to') - M (u_from'' - u_to''),
///   moment on `from` = -Kt (t_from - t_to) - Ct (t_from' - t_to'),
///
///   u = (x, y),   t = (theta_x, theta_y)
struct BearingCoefficients {
  Mat2 K = Mat2::Zero();   ///< stiffness [N/m]
  Mat2 C = Mat2::Zero();   ///< damping [N.s/m]
  Mat2 Kt = Mat2::Zero();  ///< tilt stiffness [N.m/rad]
  Mat2 Ct = Mat2::Zero();  ///< tilt damping [N.m.s/rad]
  Mat2 M = Mat2::Zero();   ///< added mass of the fluid, which has no weight [kg]

  /// All matrices, as members.
  static constexpr auto parts() {
    using Self = BearingCoefficients;
    return std::array{&Self::K, &Self::C, &Self::Kt, &Self::Ct, &Self::M};
  }
  bool operator==(const BearingCoefficients&) const = default;
};

}  // namespace whirl::inline fe
