#pragma once

#include "libbase/linalg.hpp"

namespace whirl::inline fe {

/// Linear coefficients of a bearing or link.
///
///   force on `from`  = -K (u_from - u_to) - C (u_from' - u_to'),            u = (x, y)
///   moment on `from` = -Kt (t_from - t_to) - Ct (t_from' - t_to'),          t = (theta_x, theta_y)
struct BearingCoefficients {
  Mat2 K = Mat2::Zero();   ///< stiffness [N/m]
  Mat2 C = Mat2::Zero();   ///< damping [N.s/m]
  Mat2 Kt = Mat2::Zero();  ///< tilt stiffness [N.m/rad]
  Mat2 Ct = Mat2::Zero();  ///< tilt damping [N.m.s/rad]
};

}  // namespace whirl::inline fe
