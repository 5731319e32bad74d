#pragma once

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline base {

/// Weights w_i ~ exp(-1 / (t_i (1 - t_i))), 0 < t_i < 1, of a smooth average; they sum to 1.
///
/// Of a quantity along a motion with incommensurate frequencies, such an average comes nearer to
/// the mean with the number of terms than any of its powers, where equal weights leave one over it.
///
/// @param count  at least 1
/// @source [Das2017]
Vec smooth_weights(Eigen::Index count);

}  // namespace whirl::inline base
