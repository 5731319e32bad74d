#pragma once
/// The line of the shaft between its nodes, by the shape functions of its elements.

#include "libfe/assembly/assemble.hpp"

namespace whirl::inline fe {

/// Places along the shafts, one shaft after the other, and their deflections as rows of the full
/// vector (see DofMap).
struct ShaftLine {
  Vec z;        ///< places, left to right; every node is one, NaN between two shafts [m]
  Sparse x, y;  ///< places x full size; deflection = x * full [m]
};

/// Every element divided into equal parts.
/// @param parts  of an element, parts >= 1
ShaftLine shaft_line(const Assembler& assembler, int parts);

}  // namespace whirl::inline fe
