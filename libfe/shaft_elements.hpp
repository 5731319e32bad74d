#pragma once
/// The shaft as beams: one for every piece of the mesh.

#include "libfe/elements/beam.hpp"
#include "libfe/mesh.hpp"

namespace whirl::inline fe {

/// The beam between two neighboring nodes.
Beam beam_of(const MeshElement& element, const Structure& structure, const Mesh& mesh);

}  // namespace whirl::inline fe
