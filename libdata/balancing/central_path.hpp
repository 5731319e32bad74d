#pragma once
/// The convex problems behind correction weights, by barriers.

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline data {

/// Weights near the end of the central path, and multipliers that bound what others could do.
struct CentralPathEnd {
  CVec w;
  Vec lambda;  ///< of the readings, sum 1; all 1 for sums of squares
  Vec mu;      ///< of the limits, 0 where there is none
};

/// Minimizes the largest of |v_j + (a w)_j|^2, or their sum, with |w_k| <= limit_k.
///
/// @param a, v  scaled: entries about 1 in size
/// @param limit  above zero; infinite: none
/// @param is_sum  whether the sum is minimized
CentralPathEnd walk_central_path(const CMat& a, const CVec& v, const Vec& limit, bool is_sum);

/// The lower bound that multipliers give, see correct(); at least 0.
double lower_bound(const CMat& a, const CVec& v, const Vec& limit, const Vec& lambda,
                   const Vec& mu);

}  // namespace whirl::inline data
