#pragma once
/// What rigid connections hold together, and what they leave free.

#include "libfe/mesh/dofs.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline fe {

/// Transformation full = T q from the coordinates that rigid bearings and links leave free.
/// @param dofs  freedoms of all points and internal functions; its T is not read
/// @throws ModelError  for connections that cannot be (both ends at one place, clamping a body
///                     without tilts, ends that are held already), or if nothing can move
Sparse freedoms_left(const Structure& structure, const Mesh& mesh, const DofMap& dofs);

}  // namespace whirl::inline fe
