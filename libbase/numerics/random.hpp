#pragma once

#include <cmath>
#include <random>

#include "libbase/numerics/constants.hpp"

namespace whirl::inline base {

/// A number from 0 to below 1, the same on every machine.
inline double random_share(std::mt19937_64& random) {
  return std::ldexp(static_cast<double>(random() >> 11), -53);
}

/// A number of the normal distribution of mean 0 and deviation 1.
/// @source [BoxMuller1958]
inline double random_normal(std::mt19937_64& random) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - random_share(random)));
  return radius * std::cos(turn * random_share(random));
}

}  // namespace whirl::inline base
