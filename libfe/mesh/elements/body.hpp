#pragma once

#include "libfe/mesh/elements/element.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline fe {

/// Matrices of a body for (x, y, theta_x, theta_y); without tilts only the first two rows count.
///
/// A body that spins has the gyroscopic matrix of a disk.
inline ElementMatrices<4> matrices(const Body& body) {
  ElementMatrices<4> e;
  e.M.diagonal() << body.m.x, body.m.y, body.Id, body.Id;
  if (body.spins) {
    e.G(2, 3) = +body.Ip;
    e.G(3, 2) = -body.Ip;
  }
  return e;
}

}  // namespace whirl::inline fe
