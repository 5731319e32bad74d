#pragma once

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline fe {

/// Matrices of an element: M q'' + (C + Omega G) q' + (K + Omega H) q = f. Zero until filled.
///
/// H, the circulatory matrix, comes from damping that rotates with the shaft.
template <int N>
struct ElementMatrices {
  using Block = Eigen::Matrix<double, N, N>;
  Block M, C, G, K, H;

  /// @param n  number of dofs, for N = Eigen::Dynamic
  explicit ElementMatrices(int n = N)
      : M(Block::Zero(n, n)),
        C(Block::Zero(n, n)),
        G(Block::Zero(n, n)),
        K(Block::Zero(n, n)),
        H(Block::Zero(n, n)) {}
};

}  // namespace whirl::inline fe
