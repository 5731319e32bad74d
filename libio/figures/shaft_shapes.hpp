#pragma once
/// Complex shapes along the shaft, as figures draw them.

#include <string>
#include <vector>

#include "libio/figures/figures.hpp"

namespace whirl::inline io::figures {

/// Lateral shapes along the shaft, left to right.
struct ShaftShapes {
  std::vector<double> z;           ///< [m]
  CMat x, y;                       ///< places x modes
  std::vector<std::string> names;  ///< of the places: "node 3: seal", or nothing between nodes
};

/// The shapes between the nodes too, by the shape functions of the elements; at the nodes only
/// where the model cannot be read again.
/// @param full     full vectors as columns, see DofMap
/// @throws FileError  for vectors that are not of the nodes of the result
ShaftShapes shaft_shapes(const ResultView& result, const CMat& full);

/// The axis of positions along the shapes, with a little room at both ends.
FigureAxis shaft_axis(const ShaftShapes& shapes);

/// The factor of size one that makes the largest entry real and positive; 0 if all entries are
/// zero.
Complex turn_of(const CVec& values);

}  // namespace whirl::inline io::figures
