#pragma once
/// Floquet multipliers: what becomes of small disturbances of a periodic motion in a period.

#include <span>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline base {

/// Sorts multipliers, the largest first, conjugate pairs together.
void sort_by_size(CVec& multipliers);

/// Eigenvalues of the product A_m ... A_1, the largest first.
///
/// They are m-th powers of the eigenvalues of the cyclic matrix that has A_1 ... A_m as its blocks:
/// the product, in which small multipliers drown beside large ones, is never made. The periodic
/// QR method does the same to these blocks in a cleverer order.
///
/// @param tangents  derivatives of the end of each segment of the motion by its start, n x n
/// @source [Kressner2005], 4.1
CVec multipliers_of(std::span<const Mat> tangents);

/// Multipliers of a motion whose equations do not depend on time, from the tangent of one segment;
/// left out is the multiplier nearest to 1, which belongs to the direction along the motion.
CVec multipliers_across(const Mat& tangent);

}  // namespace whirl::inline base
