#pragma once

#include "libfe/mesh/elements/element.hpp"
#include "libfe/parts/bearings/coefficients.hpp"

namespace whirl::inline fe {

/// Matrices of a bearing, seal or link for the degrees of freedom (x, y, theta_x, theta_y) of both
/// its ends.
inline ElementMatrices<8> matrices(const BearingCoefficients& c) {
  ElementMatrices<8> e;
  const auto add = [](auto& block, const Mat2& k, int at) {
    block.template block<2, 2>(at, at) += k;
    block.template block<2, 2>(at + 4, at + 4) += k;
    block.template block<2, 2>(at, at + 4) -= k;
    block.template block<2, 2>(at + 4, at) -= k;
  };
  add(e.M, c.M, 0);
  add(e.K, c.K, 0);
  add(e.K, c.Kt, 2);
  add(e.C, c.C, 0);
  add(e.C, c.Ct, 2);
  return e;
}

}  // namespace whirl::inline fe
