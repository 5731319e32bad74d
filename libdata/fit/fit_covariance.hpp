#pragma once
/// How sure a fit is.

#include <vector>

#include "libdata/fit/fit_least_squares.hpp"

namespace whirl::inline data {

enum class FitGaps {
  residuals,   ///< gaps are as likely as their weight says
  constraints  ///< there are no gaps
};

/// Covariance of the first unknowns of least squares, their part of the inverse of R^T R + G^T G.
///
/// The covariance is the inverse of (P J_p)^T P J_p with J = (R, G), where P projects on what the
/// columns of the other unknowns cannot make up for. It is computed from the columns P J_p, not
/// from that product, so that directions which the records do not determine spoil no others. The
/// variance along such a direction is given as 1e12 times what it would be with all other
/// parameters known, or as infinite.
///
/// Where the motion of a record has to be one, gaps are constraints instead, G u = 0, and the
/// matrix to be inverted is R^T R on the unknowns that meet these constraints. No estimate from
/// these readings without bias varies less (Cramer and Rao).
///
/// @param J        derivatives by all unknowns; empty: not known
/// @param gaps     what gaps are
/// @param is_held  of the unknowns whose covariance is wanted, whether a bound holds them
/// @return         NaN for unknowns that a bound holds; all infinite where the records do not
///                 determine the other unknowns
/// @source [Seber2003], sec. 2.1
Mat fit_covariance(const FitJacobian& J, FitGaps gaps, const std::vector<bool>& is_held);

}  // namespace whirl::inline data
