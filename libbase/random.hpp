#pragma once

#include <cmath>
#include <random>

namespace whirl::inline base {

/// A number from 0 to below 1, the same on every machine.
inline double random_share(std::mt19937_64& random) {
  return std::ldexp(static_cast<double>(random() >> 11), -53);
}

}  // namespace whirl::inline base
