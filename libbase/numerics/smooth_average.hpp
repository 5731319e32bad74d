#pragma once

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline base {

/// Weights w_i ~ exp(-1 / (t_i (1 - t_i))), 0 < t_i < 1, of a smooth average; they sum to 1.
///
/// For a quantity along a motion with incommensurate frequencies, the error of such an average
/// falls faster with the number of terms than any power of that number; with equal weights it falls
/// as one over the number.
///
/// @param count  at least 1
/// @source [Das2017]
Vec smooth_weights(Eigen::Index count);

}  // namespace whirl::inline base
