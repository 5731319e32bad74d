#include "libfe/lateral/antinodes.hpp"

#include <algorithm>
#include <cmath>

namespace whirl::inline fe {

std::vector<Antinode> antinodes(const Mesh& mesh, const DofMap& dofs, const CVec& shape) {
  constexpr double least = 0.5;
  constexpr double hardly = 1e-3;  // of the backward part, below which the shape is that alone
  const CVec full = dofs.T * shape;
  std::vector<Complex> forward;  // left to right
  Complex largest = 0.0;
  double backward = 0.0;
  for (const int node : mesh.left_to_right) {
    const Complex x = full(4 * node + X), iy = Complex(0.0, 1.0) * full(4 * node + Y);
    forward.push_back(x + iy);
    if (std::abs(x + iy) > std::abs(largest)) largest = x + iy;
    backward = std::max(backward, std::abs(x - iy));
  }
  std::vector<Antinode> found;
  if (!(std::abs(largest) > hardly * backward)) return found;
  std::vector<double> deflection;
  for (const Complex r : forward) deflection.push_back((r / largest).real());
  const std::size_t last = deflection.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const double here = std::abs(deflection[i]);
    if (here < least) continue;
    if (i > 0 && std::abs(deflection[i - 1]) > here) continue;
    if (i < last && std::abs(deflection[i + 1]) >= here) continue;
    found.push_back({mesh.left_to_right[i], deflection[i]});
  }
  return found;
}

}  // namespace whirl::inline fe
