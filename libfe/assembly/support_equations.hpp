#pragma once
/// What supports with a dynamic stiffness add to the equations of motion.

#include <vector>

#include "libfe/eigen/equations_of_motion.hpp"
#include "libfe/mesh/dofs.hpp"
#include "libfe/mesh/mesh.hpp"

namespace whirl::inline fe {

struct Structure;
struct Support;

/// Numbers the coordinates of the states of all supports, behind all others.
/// @throws ModelError  for supports whose states cannot be made coordinates
void add_states(const Structure& structure, DofMap& dofs);

/// Matrices of the supports, of the full vector; no spin. Empty without supports.
EquationsOfMotion<Sparse> support_equations(const Structure& structure, const Mesh& mesh,
                                            const DofMap& dofs);

/// The same of their stiffness at rest alone: M and C are zero, and the states have a stiffness of
/// their own that holds them.
EquationsOfMotion<Sparse> static_support_equations(const Structure& structure, const Mesh& mesh,
                                                   const DofMap& dofs);

/// The force of the rotor on a support where it stands, along x and y, as a linear function of the
/// motion of all points: F = K q + C q' + M q''.
struct SupportForce {
  const Support* support = nullptr;
  Point from, to;
  Sparse K, C, M;  ///< 2 x full vector
};

/// Of all supports, in their order; of one that stands at several places one for each.
std::vector<SupportForce> support_forces(const Structure& structure, const Mesh& mesh,
                                         const DofMap& dofs);

/// A signal that saturates, over the full vector q: p = displacement . q + rate . q', and the
/// forces that what it has beyond its limit adds, per unit of it.
struct LimitedSignal {
  Vec displacement, rate, force;
};

/// A limit of a support, by their numbers.
LimitedSignal limited_signal(const Structure& structure, const Mesh& mesh, const DofMap& dofs,
                             std::size_t support, std::size_t limit);

/// Rows over the full vector that belong to a sensor of a support, and the force that it would see
/// as a displacement: stiffness r + damping r' of a displacement r.
struct SensorRows {
  Vec sees, acts_on;  ///< of the sensor, and of the force of the same number
  Vec stiffness, damping;
};

/// Those of a sensor of a support, by their numbers.
SensorRows sensor_rows(const Structure& structure, const Mesh& mesh, const DofMap& dofs,
                       std::size_t support, int sensor);

}  // namespace whirl::inline fe
