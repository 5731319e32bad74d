#pragma once

#include <string_view>

#include "libdyn/system/abilities.hpp"
#include "libdyn/system/trajectory.hpp"

namespace whirl::inline dyn {

/// SUNDIALS' ARKODE with Dormand and Prince's explicit pair 5(4), the one of most users' `ode45`,
/// and its own root finding: an implementation that shares nothing with our own methods but the
/// equations of motion. Events are found on an interpolant of degree 5.
///
/// @source [Reynolds2023]; [DormandPrince1980]
struct Arkode {
  static constexpr std::string_view name = "arkode";
  static constexpr Abilities abilities{"method arkode"};
  static Integration integrate(const ContactSystem& system, MotionState& state, long revolutions,
                               const IntegrationOptions& options, const Observer& observer);
};

/// ARKODE with a diagonally implicit, stiffly accurate pair 5(4) and Newton's method, for stiff
/// systems: L-stable at order 5, and not thrown back to order 1 by events as the BDF are.
///
/// @source [Reynolds2023]; [KennedyCarpenter2019], ESDIRK5(4)7L[2]SA2
struct ArkodeDirk {
  static constexpr std::string_view name = "arkode-dirk";
  static constexpr Abilities abilities{"method arkode-dirk"};
  static Integration integrate(const ContactSystem& system, MotionState& state, long revolutions,
                               const IntegrationOptions& options, const Observer& observer);
};

}  // namespace whirl::inline dyn
