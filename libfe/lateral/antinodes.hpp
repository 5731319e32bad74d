#pragma once
/// Where a mode moves the shaft most: where unbalance excites it most.

#include <vector>

#include "libfe/assembly/assemble.hpp"
#include "libfe/lateral/turning_shaft.hpp"

namespace whirl::inline fe {

/// A node at which the deflection of a shape is largest among its neighbors.
struct Antinode {
  int node = 0;             ///< from 0
  double deflection = 0.0;  ///< over the largest one of the shape, with its sign
};

/// Antinodes of the part of a shape that whirls forward, left to right; ends of the shaft can be
/// some.
///
/// Deflections are taken in phase with the largest one of all shafts. Those below half of it count
/// for none: an end that moves a little is not what the mode is excited at.
///
/// @param shape  complex, coordinates of the system
/// @param of     whose antinodes are wanted; forward is the sense in which this shaft turns
/// @return       none where the shaft does not move, or only backward
std::vector<Antinode> antinodes(const Mesh& mesh, const DofMap& dofs, const CVec& shape,
                                const TurningShaft& of = {});

/// How far the part of a shape that whirls forward moves a node, over the largest deflection of all
/// shafts; 0 where they do not move.
double forward_share(const Mesh& mesh, const DofMap& dofs, const CVec& shape, int node,
                     const TurningShaft& of = {});

}  // namespace whirl::inline fe
