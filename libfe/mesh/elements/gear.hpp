#pragma once

#include <cmath>

#include "libfe/mesh/elements/element.hpp"
#include "libfe/parts/gear.hpp"

namespace whirl::inline fe {

/// Matrices of a pair of gears for the degrees of freedom (x, y, theta_x, theta_y) of the driving
/// and of the driven gear. With c the direction of the centers, t = z x c, and s = 1 where the
/// driving gear turns about +z, -1 where it turns about -z,
///
///   n = s cos(alpha) (cos(beta) t - sin(beta) z) + sin(alpha) c
///
/// points from the driving into the driven tooth. The teeth approach by w . q = n . (u_1 - u_2) at
/// the pitch point, and K = k w w^T, C = d w w^T. The tilts move the pitch point along z: by
/// r_1 (theta_x c_y - theta_y c_x) of the driving, -r_2 times the same of the driven gear.
///
/// Neither torsion nor axial motion are in it: wheels turn as their shafts are driven, however the
/// teeth push them.
///
/// @param sense  s
inline ElementMatrices<8> matrices(const GearPair& gears, double sense) {
  const double cx = std::cos(gears.centers), cy = std::sin(gears.centers);
  const double tangential = sense * std::cos(gears.pressure_angle) * std::cos(gears.helix_angle);
  const double radial = std::sin(gears.pressure_angle);
  const double axial = -sense * std::cos(gears.pressure_angle) * std::sin(gears.helix_angle);
  const double nx = radial * cx - tangential * cy, ny = radial * cy + tangential * cx;
  const double r1 = axial * gears.driving_radius, r2 = axial * gears.driven_radius;
  Eigen::Matrix<double, 8, 1> w;
  w << nx, ny, r1 * cy, -r1 * cx, -nx, -ny, r2 * cy, -r2 * cx;
  ElementMatrices<8> e;
  e.K = gears.stiffness * w * w.transpose();
  e.C = gears.damping * w * w.transpose();
  return e;
}

}  // namespace whirl::inline fe
