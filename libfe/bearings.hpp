#pragma once
/// The list of bearings: every member states its coefficients at a speed.

#include <variant>

#include "libfe/bearings/constant.hpp"
#include "libfe/bearings/table.hpp"

namespace whirl {

using AnyBearing = std::variant<ConstantBearing,  //
                                TableBearing>;

/// Coefficients of any bearing at a speed [rad/s].
inline BearingCoefficients coefficients(const AnyBearing& bearing, double Omega) {
  return std::visit([&](const auto& b) { return b.at(Omega); }, bearing);
}

/// True if the coefficients change with speed.
inline bool depends_on_speed(const AnyBearing& bearing) {
  return std::visit([](const auto& b) { return b.depends_on_speed; }, bearing);
}

}  // namespace whirl
