#pragma once
/// Bending of the shaft under its static loads: deflection, moment and shear force along it.

#include "libfe/assemble.hpp"

namespace whirl {

/// What a cut through the shaft shows, position by position.
///
///   moment = E I (x'', y''),   shear = kappa G A (x' - theta_y, y' + theta_x) = -moment'
///
/// Under gravity a shaft between two bearings sags (y < 0) with a moment of the y-z plane above
/// zero. The shear force is that of the right part on the left one. Both ends of every beam are
/// listed, so that inner nodes stand there twice: a bearing or a disk makes the shear force jump.
struct BendingLine {
  Vec z;           ///< positions, ascending [m]
  Mat deflection;  ///< positions x 2: x, y [m]
  Mat moment;      ///< positions x 2: of the planes x-z, y-z [N.m]
  Mat shear;       ///< positions x 2: along x, y [N]
};

/// The bending line of a static equilibrium.
///
/// Moments and shear forces follow from the forces at the ends of each beam and its own weight, so
/// that they are in equilibrium with loads and bearings. Deflections between the nodes are those of
/// the beam under its weight with the displacements of its ends. Both are exact without axial
/// forces; with them the share of N in the moment takes a cubic deflection within a beam. Damping
/// inside the shaft carries its part of the moment while the shaft spins.
///
/// @param Omega         speed of the equilibrium [rad/s]
/// @param displacement  full vector, see DofMap [m, rad]
/// @return  no positions if there is no shaft
BendingLine bending_line(const Assembler& assembler, double Omega, const Vec& displacement);

}  // namespace whirl
