#pragma once

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline fe {

/// Eigenpairs of (lambda^2 M + lambda D + K) q = 0. Of conjugate pairs, the one with Im > 0.
struct QuadraticModes {
  CVec lambda;  ///< [rad/s]
  CMat q;       ///< n x lambda.size(), columns of length one
};

/// All eigenpairs, densely, by inverting the state matrix about a real shift: for small systems,
/// and as the oracle in tests.
///
/// The inverse resolves the lowest modes to rounding even where supports of 1e15 N/m or nearly
/// massless dofs put others at 1e10 rad/s; velocities are scaled by a typical frequency,
/// without which the small real parts drown, and with them the verdict on stability. Infinite
/// eigenvalues of a singular M are left out.
///
/// @param shift  [rad/s]; 0 needs a regular K; free systems take a negative one
/// @throws NumericalError  if the QR iteration fails
QuadraticModes dense_quadratic_modes(const Sparse& M, const Sparse& D, const Sparse& K,
                                     double shift = 0.0);

}  // namespace whirl::inline fe
