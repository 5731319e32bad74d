#include "libfe/shaft_elements.hpp"

namespace whirl::inline fe {

Beam beam_of(const MeshElement& element, const Structure& structure, const Mesh& mesh) {
  const Segment& segment = structure.shaft[static_cast<std::size_t>(element.segment)];
  return {.L = mesh.z[element.right] - mesh.z[element.left],
          .left = segment.at(element.from),
          .right = segment.at(element.to),
          .material = segment.material,
          .theory = segment.theory,
          .shear = segment.shear,
          .axial_force = segment.axial_force,
          .torque = segment.torque,
          .internal_functions = segment.internal_functions};
}

}  // namespace whirl::inline fe
