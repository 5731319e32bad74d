#pragma once

#include <algorithm>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline fe {

/// How damping and circulation compare with strain energy, for whatever shape q.
///
///   damping  q^H D q / q^H K q   (real part)
///   skew     q^H K q / q^H K q   (imaginary part over real part)
///
/// With them the energies of an eigenpair, m |l|^2 + k times decay = c |l|^2 + skew k Im l, say
/// where no eigenvalue l can be.
struct EnergyBounds {
  bool are_known = false;                          ///< the symmetric part of K is positive definite
  double most_damping = 0.0, least_damping = 0.0;  ///< [s]; least may be negative
  double skew = 0.0;                               ///< 0: K is symmetric

  /// Whether an eigenvalue can be at one of
  ///   low <= |Re lambda| <= high,  Im lambda <= top,  with the sign of Re lambda.
  /// @param sign  -1: decays, 1: grows
  bool allow(int sign, double low, double high, double top) const {
    if (!are_known) return true;
    const double damping = sign < 0 ? most_damping : -least_damping;
    return low <= std::max(damping, 0.0) * (high * high + top * top) + skew * top;
  }
};

/// By Lanczos' method in the inner product of K's symmetric part, each bound beyond its residual.
/// @param D  C + Omega G; only its symmetric part matters
EnergyBounds energy_bounds(const Sparse& D, const Sparse& K);

}  // namespace whirl::inline fe
