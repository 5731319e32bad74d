#pragma once
/// Static equilibrium: sag under gravity and what the bearings carry.

#include <string_view>
#include <vector>

#include "libfe/assemble.hpp"

namespace whirl {

struct BearingLoad {
  std::string name;
  Vec2 force = Vec2::Zero();  ///< of the rotor on the bearing, (x, y) [N]
};

struct StaticEquilibrium {
  Vec displacement;  ///< full vector, see DofMap [m, rad]
  std::vector<BearingLoad> bearings;
};

/// Equilibrium under gravity at a speed [rad/s]: (K + Omega H) q = -g M e_y.
/// @throws ModelError  if the rotor is free
StaticEquilibrium static_equilibrium(const Assembler& assembler, double Omega);

/// Checks that no rigid-body motion is free at a speed.
/// @param what  begins the message, "the static sag needs"
/// @throws ModelError  if one is
void require_supports(const Assembler& assembler, double Omega, std::string_view what);

}  // namespace whirl
