#pragma once

#include "libfe/mesh/mesh.hpp"

namespace whirl::inline fe {

/// What a rotor weighs: its shafts, disks and spinning bodies.
struct RotorProperties {
  double mass = 0.0;            ///< [kg]
  double center_of_mass = 0.0;  ///< of shaft and disks, along the shaft [m]
  double Ip = 0.0;              ///< polar moment of inertia [kg.m^2]
  /// Transverse moment of inertia of shaft and disks about their center of mass [kg.m^2].
  double Id = 0.0;
};

/// Integrates along the shaft; exact for cylinders and cones.
RotorProperties rotor_properties(const Structure& structure, const Mesh& mesh);

/// Mass of a shaft and its disks that lies beyond a position, to its right or to its left [kg]. A
/// disk at the position does not count.
/// @param shaft  its number, from 0
double mass_beyond(const Structure& structure, const Mesh& mesh, double z, bool to_the_right,
                   int shaft = 0);

}  // namespace whirl::inline fe
