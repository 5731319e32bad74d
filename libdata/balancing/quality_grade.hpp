#pragma once
/// Balance quality grades.

#include <array>
#include <optional>

namespace whirl::inline data {

/// Permissible residual unbalance of a rotor, U = G m / Omega [kg.m].
///
/// @param grade  permissible e Omega, 2.5e-3 of G2.5 [m/s]
/// @param mass   of the rotor [kg]
/// @param Omega  the highest speed that it runs at [rad/s]
/// @source [ISO21940-11], sec. 6
double permissible_unbalance(double grade, double mass, double Omega);

/// Shares of two planes in a permissible unbalance, by the distances of the center of mass:
///
///   share of the left = distance to the right plane / distance of the planes
///
/// and neither less than 0.3 nor more than 0.7.
///
/// @param left, right, center  along the shaft [m]
/// @return  nothing where the center of mass is not between the planes
/// @source [ISO21940-11], sec. 7, rotors with the center of mass between their bearings
std::optional<std::array<double, 2>> plane_shares(double left, double right, double center);

}  // namespace whirl::inline data
