#pragma once
/// Steps of methods without error control.

#include <algorithm>
#include <cmath>

#include "libdyn/system/trajectory.hpp"

namespace whirl::inline dyn {

/// Number of equal steps over what is left of a revolution, a whole number.
///
/// A step is `fixed_step` at most, or if that is not given a thousandth of a revolution at a
/// tolerance of 1e-10, and (tolerance / 1e-10)^(1/4) times as long at others.
///
/// @param period  of a revolution [s]
/// @param left    what is left of the revolution [s]
inline double equal_steps(double period, double left, const IntegrationOptions& options) {
  constexpr double usual_steps = 1000.0, usual_tolerance = 1e-10;
  const double longest =
      options.fixed_step > 0.0
          ? options.fixed_step
          : period / usual_steps * std::pow(options.tolerance / usual_tolerance, 0.25);
  return std::max(1.0, std::ceil(left / longest * (1.0 - 1e-9)));
}

}  // namespace whirl::inline dyn
