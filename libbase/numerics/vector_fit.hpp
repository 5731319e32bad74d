#pragma once
/// Rational functions with common poles, fitted to frequency responses.

#include <vector>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline base {

/// H(s) = sum over n of R_n / (s - p_n) + D_0 + D_1 s + D_2 s^2, of E entries side by side.
struct RationalFit {
  CVec poles;            ///< [rad/s], stable; of a conjugate pair the one with Im > 0
  CMat residues;         ///< E x poles
  Mat direct;            ///< E x 3: D_0, D_1, D_2; zero those that were not asked for
  double error = 0.0;    ///< root mean square of what is left, of each sample relative to its size
  double largest = 0.0;  ///< the largest of them
  int unstable = 0;      ///< poles that were found on the right and mirrored

  CVec at(Complex s) const;
};

/// Vector fitting: poles are the zeros of a weighting function that is fitted with the responses,
/// again and again until they stay.
///
/// @param omega   N frequencies, ascending, above zero [rad/s]
/// @param H       E x N responses; each frequency counts by its size relative to the norm of its
///                column
/// @param order   number of poles, both of a pair counted, from 0
/// @param direct  how many of D_0, D_1 and D_2 there are, 0 to 3
/// @throws NumericalError  for fewer samples than unknowns, or zero or not finite responses
/// @source [GustavsenSemlyen1999]; [Gustavsen2006] for the relaxed weighting function
RationalFit vector_fit(const Vec& omega, const CMat& H, int order, int direct);

}  // namespace whirl::inline base
