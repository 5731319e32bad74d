#pragma once
/// Numbers that say what many numbers are like.

#include <vector>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline base {

/// The one in the middle, of an even number the mean of the two.
/// @param values  one or more
double median_of(std::vector<double> values);

/// Root of the mean square of the distances from the mean.
/// @param values  one or more
double standard_deviation(const Vec& values);

}  // namespace whirl::inline base
