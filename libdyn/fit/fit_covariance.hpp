#pragma once
/// How sure a fit is.

#include <vector>

#include "libbase/linalg.hpp"

namespace whirl::inline dyn {

/// Covariance of the first unknowns of least squares, their part of the inverse of J^T J.
///
/// With P what the columns J_o of the other unknowns cannot make up for, the inverse of (P J_p)^T P J_p:
/// made of these columns themselves, so that directions which are not told spoil no others. Their
/// variance is given as 1e12 times what it would be with all other parameters known, or infinite.
///
/// @param J        derivatives of all residuals over their deviations, by all unknowns; empty: not known
/// @param is_held  of the unknowns whose covariance is wanted, whether a bound holds them
/// @return         NaN of those that a bound holds; all infinite where the other unknowns are not told
/// @source [Seber2003], sec. 2.1
Mat fit_covariance(const Sparse& J, const std::vector<bool>& is_held);

}  // namespace whirl::inline dyn
