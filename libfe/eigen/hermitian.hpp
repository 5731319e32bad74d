#pragma once

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline fe {

/// Largest eigenvalues of (M - i g G) q = nu K q with M, K symmetric, K positive definite, G skew.
struct HermitianModes {
  Vec nu;  ///< descending
  CMat q;  ///< n x m, q^H K q = I
};

/// Dense below 150 dofs; above, by Lanczos on the real form of twice the size.
/// @throws NumericalError  if K is not positive definite or Lanczos does not converge
HermitianModes largest_hermitian(const Sparse& M, const Sparse& G, double g, const Sparse& K,
                                 int count);

}  // namespace whirl::inline fe
