#pragma once

#include <memory>

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

/// Eigenpairs nearest to a real shift, by Arnoldi on the second-order problem.
///
///   x = -(s^2 M + s D + K)^-1 (M p + (s M + D) q),   v = s x + q
///
/// so that no state matrix is formed. For s = 0 the one factorization of K serves every D.
///
/// @source Spectra; [TisseurMeerbergen2001], sec. 3.4
class QuadraticSolver {
 public:
  /// @param shift  [rad/s]; 0 needs a regular K; free systems take a negative one
  QuadraticSolver(Sparse M, Sparse K, double shift);
  ~QuadraticSolver();
  QuadraticSolver(QuadraticSolver&&) noexcept;
  QuadraticSolver& operator=(QuadraticSolver&&) noexcept;

  /// At least `pairs` eigenvalues with Im > 0 (fewer if there are fewer), the real ones between.
  /// @throws NumericalError  if Arnoldi does not converge
  QuadraticModes lowest(const Sparse& D, int pairs) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace whirl::inline fe
