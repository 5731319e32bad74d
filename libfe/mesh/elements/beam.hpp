#pragma once

#include "libfe/mesh/elements/element.hpp"
#include "libfe/parts/material.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline fe {

/// A two-node shaft element, cylinder or cone.
struct Beam {
  double L = 0.0;  ///< length [m]
  Section left, right;
  Material material;
  Theory theory = Theory::timoshenko;
  ShearCoefficient shear;
  double axial_force = 0.0;    ///< tension > 0 [N]
  double torque = 0.0;         ///< about +z on the face that looks to +z [N.m]
  int internal_functions = 0;  ///< pairs of internal shape functions per plane, 0 to 4
  Rayleigh damping{};          ///< at rest
  Carries carries = Carries::both;

  /// Section at a fraction s of the length, 0 <= s <= 1.
  Section at(double s) const { return between(left, right, s); }
};

/// Matrices of a shaft element.
///
/// Degrees of freedom: (x, y, theta_x, theta_y) of the left node, of the right node, then the
/// amplitudes of the internal functions of the x-z plane, then those of the y-z plane
/// (dimensionless: each function's largest deflection is one metre or its largest rotation one over
/// the length).
///
/// Shape functions are the exact static deflections of the element for unit displacements and
/// rotations of its ends, found by integrating M / (E I) and V / (kappa G A) along the taper, so
/// that K is exact for every cone, and M, G are the consistent ones:
///
///   w'' = theta' + (V / kappa G A)',   theta' = M / (E I),   M' = -V
///
/// For a cylinder these are the cubic functions with Phi = 12 E I / (kappa G A L^2).
/// Internal functions are the deflections of the clamped element under distributed forces and
/// moments that vary as xi^k; they are K-orthogonal to the others. The error of an eigenvalue falls
/// as h^2 with shear and without internal functions, as h^4 without shear, and each pair of
/// internal functions raises these orders by two.
///
/// Axial force: N integral w' w'. Torque: each section turns its axis, T integral
/// (theta_y_i' theta_x_j ...), the skew remainder kept: the torque vector stays along z.
/// Rayleigh damping is a M + b K of the element, without the torque's share; a beam that carries
/// one of mass and stiffness has nothing of the other, neither axial force nor torque without
/// stiffness.
///
/// @throws OptionError  if internal_functions is out of range
/// @source [NelsonMcVaugh1976], [Nelson1980], [Przemieniecki1968] ch. 11 for the functions;
///         [ZorziNelson1977] for rotating damping; [ZorziNelson1980], [Greenhill1883] for torque
ElementMatrices<Eigen::Dynamic> matrices(const Beam& beam);

/// Deflection between the nodes: all shape functions of one plane at places along the element.
///
///   w(xi) = N(xi) . (w, theta of the left node, w, theta of the right node, internal amplitudes)
///
/// For a cylinder without internal functions, with Phi = 12 E I / (kappa G A L^2):
///
///   N_1 = (1 - 3 xi^2 + 2 xi^3 + Phi (1 - xi)) / (1 + Phi)
///   N_2 = L (xi - 2 xi^2 + xi^3 + Phi (xi - xi^2) / 2) / (1 + Phi)
///
/// and their mirror images. In the x-z plane theta is theta_y, in the y-z plane -theta_x.
///
/// @param xi  places, 0 at the left node, 1 at the right one
/// @return    places x (4 + internal functions of a plane) [m/m, m/rad]
/// @source [Przemieniecki1968] ch. 11
Mat deflection_functions(const Beam& beam, const Vec& xi);

}  // namespace whirl::inline fe
