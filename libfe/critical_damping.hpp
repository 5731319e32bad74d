#pragma once
/// Damping of the modes that are critical.

#include <vector>

#include "libfe/critical.hpp"

namespace whirl {

/// Damping ratio above which a mode is hardly a critical speed: that of a bearing, in most cases.
constexpr double heavy_damping = 0.5;

/// Damping ratios at the damped critical speeds; NaN where there is none.
///
/// Of the modes at that speed it is the one whose frequency is order * Omega; among several, the one
/// whose shape is most like the undamped critical's.
///
/// @throws NumericalError  if an eigensolver fails
std::vector<double> critical_damping(const Assembler& assembler,
                                     const std::vector<Critical>& criticals,
                                     const CriticalOptions& options);

}  // namespace whirl
