#pragma once
/// The shaft as beams: one for every piece of the mesh, and one for every piece of a layer.

#include <vector>

#include "libfe/mesh/elements/beam.hpp"
#include "libfe/mesh/mesh.hpp"

namespace whirl::inline fe {

/// The beam between two neighboring nodes.
Beam beam_of(const MeshElement& element, const Structure& structure, const Mesh& mesh);

/// The beam of a layer beside an element, between the same nodes.
Beam beam_of(const MeshLayer& piece, const Structure& structure, const Mesh& mesh);

/// All beams beside each other along an element: that of the shaft, then those of layers.
std::vector<Beam> beams_along(std::size_t element, const Structure& structure, const Mesh& mesh);

}  // namespace whirl::inline fe
