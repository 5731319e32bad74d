#pragma once

#include "libfe/bearings/coefficients.hpp"

namespace whirl {

/// A bearing whose coefficients are the same at every speed.
struct ConstantBearing {
  static constexpr bool depends_on_speed = false;

  BearingCoefficients value;

  const BearingCoefficients& at(double /*Omega*/) const { return value; }
};

}  // namespace whirl
