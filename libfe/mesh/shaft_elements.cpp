#include "libfe/mesh/shaft_elements.hpp"

namespace whirl::inline fe {

Beam beam_of(const MeshElement& element, const Structure& structure, const Mesh& mesh) {
  const std::vector<Segment>& segments = structure.segments_of(element.shaft);
  const Segment& segment = segments[static_cast<std::size_t>(element.segment)];
  return {.L = mesh.z[element.right] - mesh.z[element.left],
          .left = segment.at(element.from),
          .right = segment.at(element.to),
          .material = segment.material,
          .theory = segment.theory,
          .shear = segment.shear,
          .axial_force = segment.axial_force,
          .torque = segment.torque,
          .internal_functions = segment.internal_functions,
          .damping = segment.damping};
}

Beam beam_of(const MeshLayer& piece, const Structure& structure, const Mesh& mesh) {
  const Layer& layer = structure.layers[static_cast<std::size_t>(piece.layer)];
  const MeshElement& element = mesh.elements[static_cast<std::size_t>(piece.element)];
  return {.L = mesh.z[element.right] - mesh.z[element.left],
          .left = between(layer.left, layer.right, piece.from),
          .right = between(layer.left, layer.right, piece.to),
          .material = layer.material,
          .theory = layer.theory,
          .shear = layer.shear,
          .damping = layer.damping,
          .carries = layer.carries};
}

std::vector<Beam> beams_along(std::size_t element, const Structure& structure, const Mesh& mesh) {
  std::vector<Beam> beams{beam_of(mesh.elements[element], structure, mesh)};
  for (const MeshLayer& piece : mesh.layers) {
    if (static_cast<std::size_t>(piece.element) != element) continue;
    beams.push_back(beam_of(piece, structure, mesh));
  }
  return beams;
}

}  // namespace whirl::inline fe
