#pragma once
/// How sure a fit is.

#include <vector>

#include "libdata/fit/fit_least_squares.hpp"

namespace whirl::inline data {

enum class FitGaps {
  residuals,   ///< as likely as their weight says
  constraints  ///< there are none
};

/// Covariance of the first unknowns of least squares, their part of the inverse of R^T R + G^T G.
///
/// With P what the columns of the other unknowns cannot make up for, the inverse of (P J_p)^T P
/// J_p, J = (R, G): made of these columns themselves, so that directions which are not told spoil
/// no others. Their variance is given as 1e12 times what it would be with all other parameters
/// known, or infinite.
///
/// Where the motion of a record has to be one, gaps are constraints instead, G u = 0: R^T R on the
/// unknowns that meet them. No estimate from these readings without bias varies less (Cramer and
/// Rao).
///
/// @param J        derivatives by all unknowns; empty: not known
/// @param gaps     what gaps are
/// @param is_held  of the unknowns whose covariance is wanted, whether a bound holds them
/// @return         NaN of those that a bound holds; all infinite where the other unknowns are not
///                 told
/// @source [Seber2003], sec. 2.1
Mat fit_covariance(const FitJacobian& J, FitGaps gaps, const std::vector<bool>& is_held);

}  // namespace whirl::inline data
