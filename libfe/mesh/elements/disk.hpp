#pragma once

#include <numbers>

#include "libfe/mesh/elements/element.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline fe {

/// Matrices of a disk for the degrees of freedom (x, y, theta_x, theta_y) of its node.
///
///   Id theta_x'' + Omega Ip theta_y' = moment about x
///   Id theta_y'' - Omega Ip theta_x' = moment about y
///
/// @source [NelsonMcVaugh1976]; axes and signs as in docs/conventions.md.
inline ElementMatrices<4> matrices(const Disk& disk) {
  ElementMatrices<4> e;
  e.M.diagonal() << disk.m, disk.m, disk.Id, disk.Id;
  e.G(2, 3) = +disk.Ip;
  e.G(3, 2) = -disk.Ip;
  return e;
}

/// Sets mass and inertias of a disk from its shape: a hollow cylinder of density rho [kg/m^3].
///
///   m = rho pi w (do^2 - di^2) / 4,   Ip = m (do^2 + di^2) / 8,   Id = Ip / 2 + m w^2 / 12
inline void set_inertia_from_shape(Disk& disk, double rho) {
  const double o2 = disk.outer_diameter * disk.outer_diameter;
  const double i2 = disk.inner_diameter * disk.inner_diameter;
  disk.m = rho * std::numbers::pi * disk.width * (o2 - i2) / 4.0;
  disk.Ip = disk.m * (o2 + i2) / 8.0;
  disk.Id = disk.Ip / 2.0 + disk.m * disk.width * disk.width / 12.0;
}

}  // namespace whirl::inline fe
