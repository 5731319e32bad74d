#pragma once
/// Stability of orbits that are Fourier series, by Hill's method.

#include "libbase/failure.hpp"
#include "libdyn/orbits/harmonic_balance.hpp"

namespace whirl::inline dyn {

/// Floquet exponents and multipliers of an orbit.
struct HillStability {
  CVec exponents;    ///< [1/s], of the multipliers; imaginary parts modulo the orbit's frequency
  CVec multipliers;  ///< of the whole period, the largest first
  /// How many of the 2 n multipliers are missing: those below 1e-4, which are not looked for, and
  /// those that Arnoldi's method did not find.
  int missing = 0;
  /// How many multipliers are those of modes too fast for the harmonics, from the mean of A(t).
  int averaged = 0;
  int harmonics = 0;  ///< of p
  Failure failure;

  bool is_stable() const {
    return !failure && (multipliers.size() == 0 || multipliers.cwiseAbs().maxCoeff() < 1.0);
  }
};

/// Floquet exponents of an orbit of harmonic balance.
///
///   y(t) = p(t) e^(lambda t),   p periodic:   (A(t) - d/dt) p = lambda p
///
/// is an eigenproblem for the Fourier coefficients of p, whose eigenvalues repeat as
/// lambda + i k w. The eigenvalues of the smallest size, best resolved by so many harmonics, are
/// found by Arnoldi's method on the inverse. Each of its vectors costs a solution with the Jacobian
/// of harmonic balance, whose size is that of the ports, not of the states. A strip of width w
/// across the imaginary axis holds each exponent once; the strip is laid where no eigenvalue is
/// near its edges. Blocks of two vectors find exponents that isotropy doubles. Modes faster than
/// seven tenths of the harmonics have no copy in the strip that the harmonics resolve; exponents of
/// such modes are those of the mean of A(t), to first order.
///
/// The series of p has the harmonics of the orbit, or more if the modes of the mean of A(t) ask for
/// that and the cost is low.
///
/// @source [Hill1886]; [VonGrollEwins2001] for harmonic balance; [LazarusThomas2010] for the choice
///         of eigenvalues
HillStability hill_stability(const HarmonicProblem& problem, const HarmonicOrbit& orbit);

}  // namespace whirl::inline dyn
