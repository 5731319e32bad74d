#pragma once

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline base {

/// Dimension of the set that points lie on: 0 for a few points that repeat, 1 for a closed curve,
/// as the sections of a motion with two frequencies make it, more for a torus of three frequencies
/// or for chaos.
///
/// The number of neighbors within a distance grows as its power D:  D = ln(k_2 / k_1) over the mean
/// of ln(T_2 / T_1), with the distances T of the k_1 = 8th and k_2 = 32nd nearest neighbors of each
/// point. The error is some 0.1 for 400 points.
///
/// @param points  one per column, at least 96; in units in which all directions count alike
/// @return        NaN for fewer points
/// @source [BadiiPoliti1985], fixed mass
double fractal_dimension(const Mat& points);

}  // namespace whirl::inline base
