#include "libfe/lateral/antinodes.hpp"

#include <algorithm>
#include <cmath>

namespace whirl::inline fe {

namespace {

/// The part of a shape that whirls forward, left to right.
struct ForwardShape {
  std::vector<Complex> deflection;
  Complex largest = 0.0;
  double backward = 0.0;  ///< the largest deflection of the other part

  ForwardShape(const Mesh& mesh, const DofMap& dofs, const CVec& shape, const TurningShaft& of) {
    const CVec full = dofs.T * shape;
    const Complex ahead(0.0, of.turns_against() ? -1.0 : 1.0);
    for (const int node : mesh.left_to_right) {
      const Complex x = full(4 * node + X), iy = ahead * full(4 * node + Y);
      deflection.push_back(x + iy);
      if (std::abs(x + iy) > std::abs(largest)) largest = x + iy;
      backward = std::max(backward, std::abs(x - iy));
    }
  }
};

}  // namespace

std::vector<Antinode> antinodes(const Mesh& mesh, const DofMap& dofs, const CVec& shape,
                                const TurningShaft& of) {
  constexpr double least = 0.5;
  constexpr double hardly = 1e-3;  // of the backward part, below which the shape is that alone
  const ForwardShape forward(mesh, dofs, shape, of);
  std::vector<Antinode> found;
  if (!(std::abs(forward.largest) > hardly * forward.backward)) return found;
  std::vector<double> deflection;
  for (const Complex r : forward.deflection) deflection.push_back((r / forward.largest).real());
  std::size_t first = 0;
  for (const std::vector<int>& line : mesh.lines()) {
    const std::size_t last = first + line.size() - 1;
    for (std::size_t i = first; i <= last && of.has_node(line.front(), mesh); ++i) {
      const double here = std::abs(deflection[i]);
      if (here < least) continue;
      if (i > first && std::abs(deflection[i - 1]) > here) continue;
      if (i < last && std::abs(deflection[i + 1]) >= here) continue;
      found.push_back({mesh.left_to_right[i], deflection[i]});
    }
    first = last + 1;
  }
  return found;
}

double forward_share(const Mesh& mesh, const DofMap& dofs, const CVec& shape, int node,
                     const TurningShaft& of) {
  const ForwardShape forward(mesh, dofs, shape, of);
  const auto place = std::find(mesh.left_to_right.begin(), mesh.left_to_right.end(), node);
  const auto i = static_cast<std::size_t>(place - mesh.left_to_right.begin());
  const double largest = std::max(std::abs(forward.largest), forward.backward);
  return largest > 0.0 ? std::abs(forward.deflection.at(i)) / largest : 0.0;
}

}  // namespace whirl::inline fe
