#pragma once
/// The shaft of a rotor that an analysis after the rules of one shaft is about.

#include <cmath>

#include "libfe/mesh/dofs.hpp"
#include "libfe/mesh/mesh.hpp"

namespace whirl::inline fe {

/// A shaft that turns, among all of a structure.
struct TurningShaft {
  int number = 0;      ///< from 0, the first one
  double ratio = 1.0;  ///< of its speed to that of the first one, not 0

  /// Of its unbalance: the frequency over the speed of the first shaft.
  double order() const { return std::abs(ratio); }
  bool turns_against() const { return ratio < 0.0; }
  bool has_node(int node, const Mesh& mesh) const {
    return mesh.shaft_of.at(static_cast<std::size_t>(node)) == number;
  }
};

/// Whether nodes belong to more than one shaft.
inline bool has_several_shafts(const Mesh& mesh) {
  return mesh.lines().size() > 1;
}

/// Number of the shaft that a shape moves most, from 0; of a shape that moves none the first one.
/// @param shape   complex, coordinates of the system
int shaft_moved_most(const Mesh& mesh, const DofMap& dofs, const CVec& shape);

}  // namespace whirl::inline fe
