#pragma once

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline fe {

/// Lowest undamped modes, K phi = omega^2 M phi.
struct RealModes {
  Vec omega2;     ///< ascending [rad^2/s^2]; exactly 0 for rigid-body modes
  Mat Phi;        ///< n x m, Phi^T M Phi = I, the largest entry of each column positive
  int rigid = 0;  ///< how many of them are rigid-body modes

  /// Lowest frequency of a mode that deforms [rad/s]; 0 if none was computed.
  double first_flexible() const { return omega2.size() > rigid ? std::sqrt(omega2(rigid)) : 0.0; }
};

/// Lowest modes of a symmetric pencil.
///
/// Small systems are solved densely. Larger ones by shift-and-invert Lanczos with a sparse L D L^T;
/// the number of negative pivots of K - s M counts the eigenvalues below s and proves that none is
/// missing. Free systems (K singular) are shifted to -(0.3 first flexible omega)^2: a shift of zero
/// or a tiny one gives wrong modes without a sign.
///
/// @param K      n x n, symmetric, positive semidefinite
/// @param M      n x n, symmetric, positive definite
/// @param count  modes wanted, rigid ones included; fewer come back if n is smaller
/// @throws NumericalError  if M is singular, or a mode stays missing after retries
/// @source Spectra; Sylvester's law of inertia
RealModes lowest_real_modes(const Sparse& K, const Sparse& M, int count);

/// Whether supports hold every freedom: K is positive definite to rounding.
bool is_supported(const Sparse& K);

/// (A + A^T) / 2.
Sparse symmetric_part(const Sparse& A);

/// Largest entry of A - A^T relative to the largest of A is below 1e-12.
bool is_symmetric(const Sparse& A);

/// M itself where it is symmetric, else its symmetric part, for pencils that need one: added mass
/// of seals has small skew parts.
Sparse symmetric_inertia(const Sparse& M);

}  // namespace whirl::inline fe
