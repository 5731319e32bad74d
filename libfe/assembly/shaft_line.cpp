#include "libfe/assembly/shaft_line.hpp"

#include <array>
#include <cassert>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libfe/mesh/shaft_elements.hpp"

namespace whirl::inline fe {

namespace {

/// The first entry of the full vector behind those of nodes and bodies.
int internal_start(const Assembler& assembler) {
  int next = 4 * assembler.mesh().nodes();
  for (const Body& body : assembler.structure().bodies) next += body.tilts ? 4 : 2;
  return next;
}

}  // namespace

ShaftLine shaft_line(const Assembler& assembler, int parts) {
  assert(parts >= 1);
  const Mesh& mesh = assembler.mesh();
  const auto elements = static_cast<Eigen::Index>(mesh.elements.size());
  const auto lines = std::ssize(mesh.lines());
  ShaftLine line{Vec::Constant(elements * parts + (lines > 0 ? 2 * lines - 1 : 0), nan), {}, {}};
  std::vector<Triplet> x, y;
  int next = internal_start(assembler);
  Eigen::Index place = 0;
  for (Eigen::Index e = 0; e < elements; ++e) {
    const MeshElement& element = mesh.elements[static_cast<std::size_t>(e)];
    const Beam beam = beam_of(element, assembler.structure(), mesh);
    const auto next_element = static_cast<std::size_t>(e) + 1;
    const bool is_last = e + 1 == elements || mesh.elements[next_element].shaft != element.shaft;
    const Vec xi = Vec::LinSpaced(parts + 1, 0.0, 1.0).head(is_last ? parts + 1 : parts);
    const Mat N = deflection_functions(beam, xi);
    const auto internal = static_cast<int>(N.cols()) - 4;
    const int left = 4 * element.left, right = 4 * element.right;
    const std::array<int, 4> of_x{left + X, left + THETA_Y, right + X, right + THETA_Y};
    const std::array<int, 4> of_y{left + Y, left + THETA_X, right + Y, right + THETA_X};
    for (Eigen::Index i = 0; i < xi.size(); ++i, ++place) {
      const auto row = static_cast<int>(place);
      line.z(place) = mesh.z[static_cast<std::size_t>(element.left)] + xi(i) * beam.L;
      for (int k = 0; k < 4; ++k) {
        x.emplace_back(row, of_x[static_cast<std::size_t>(k)], N(i, k));
        y.emplace_back(row, of_y[static_cast<std::size_t>(k)], k % 2 == 1 ? -N(i, k) : N(i, k));
      }
      for (int k = 0; k < internal; ++k) {
        x.emplace_back(row, next + k, N(i, 4 + k));
        y.emplace_back(row, next + internal + k, N(i, 4 + k));
      }
    }
    next += 2 * internal;
    if (is_last) ++place;  // the gap
  }
  for (Sparse* to : {&line.x, &line.y}) {
    to->resize(line.z.size(), next);
    const auto& entries = to == &line.x ? x : y;
    to->setFromTriplets(entries.begin(), entries.end());
  }
  return line;
}

}  // namespace whirl::inline fe
