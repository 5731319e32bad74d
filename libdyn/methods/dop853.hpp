#pragma once

#include <string_view>

#include "libdyn/system/abilities.hpp"
#include "libdyn/system/trajectory.hpp"

namespace whirl::inline dyn {

/// Explicit Runge-Kutta method of order 8 with events.
///
/// Dormand and Prince's pair 8(5,3); its interpolant of order 7 is searched for events by
/// conservative advancement, and the step is made again up to each event, with Newton's method on
/// its length, until the event's function vanishes to rounding: the order is kept across events.
///
/// @source [HairerNorsettWanner1993], sec. II.5 and II.6
struct Dop853 {
  static constexpr std::string_view name = "dop853";
  static constexpr Abilities abilities{"method dop853"};

  /// Integrates over whole revolutions from where the state is.
  ///
  /// @param state        in and out; at a failure, the last good one
  /// @param revolutions  counted from state.revolution; the end is at phase 0
  /// @param observer     called with every step; may be empty
  static Integration integrate(const ContactSystem& system, MotionState& state, long revolutions,
                               const IntegrationOptions& options, const Observer& observer);
};

}  // namespace whirl::inline dyn
