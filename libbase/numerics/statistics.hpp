#pragma once
/// Median and standard deviation of many numbers.

#include <vector>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline base {

/// The value in the middle; of an even number of values, the mean of the two in the middle.
/// @param values  one or more
double median_of(std::vector<double> values);

/// Root of the mean square of the distances from the mean.
/// @param values  one or more
double standard_deviation(const Vec& values);

}  // namespace whirl::inline base
