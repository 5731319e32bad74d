#include "libfe/lateral/turning_shaft.hpp"

namespace whirl::inline fe {

int shaft_moved_most(const Mesh& mesh, const DofMap& dofs, const CVec& shape) {
  const CVec full = dofs.T * shape;
  int shaft = 0;
  double largest = 0.0;
  for (int node = 0; node < mesh.nodes(); ++node) {
    const double size = std::norm(full(4 * node + X)) + std::norm(full(4 * node + Y));
    if (!(size > largest)) continue;
    largest = size;
    shaft = mesh.shaft_of[static_cast<std::size_t>(node)];
  }
  return shaft;
}

}  // namespace whirl::inline fe
