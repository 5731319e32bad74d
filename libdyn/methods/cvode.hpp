#pragma once

#include <string_view>

#include "libdyn/system/abilities.hpp"
#include "libdyn/system/trajectory.hpp"

namespace whirl::inline dyn {

/// SUNDIALS' CVODE with its own root finding: an implementation that shares nothing with our own
/// methods but the equations of motion. Each event restarts CVODE at order one. Events are changes
/// of sign over a step: a contact that begins and ends within one step is missed.
///
/// @source [Hindmarsh2005]
struct CvodeAdams {
  static constexpr std::string_view name = "cvode-adams";  ///< Adams-Moulton, fixed-point iteration
  static constexpr Abilities abilities{"method cvode-adams"};
  static Integration integrate(const ContactSystem& system, MotionState& state, long revolutions,
                               const IntegrationOptions& options, const Observer& observer);
};

/// CVODE with backward differences and Newton's method, for stiff systems.
struct CvodeBdf {
  static constexpr std::string_view name = "cvode-bdf";
  static constexpr Abilities abilities{"method cvode-bdf"};
  static Integration integrate(const ContactSystem& system, MotionState& state, long revolutions,
                               const IntegrationOptions& options, const Observer& observer);
};

}  // namespace whirl::inline dyn
