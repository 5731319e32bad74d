#pragma once
/// Numbers that units and angles are made of.

#include <limits>
#include <numbers>

namespace whirl::inline base {

constexpr double turn = 2.0 * std::numbers::pi;      ///< once around [rad]
constexpr double degree = std::numbers::pi / 180.0;  ///< [rad]
constexpr double rpm = std::numbers::pi / 30.0;      ///< one revolution a minute [rad/s]
constexpr double hertz = 60.0 * rpm;                 ///< one revolution a second [rad/s]
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace whirl::inline base
