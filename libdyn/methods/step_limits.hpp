#pragma once
/// Where methods that step to events give up.

namespace whirl::inline dyn {

inline constexpr double too_small_step = 1e-14;  ///< of a revolution
inline constexpr int most_instant_events = 50;   ///< without time passing
/// Value of an event's function at the place of the event, above which the step was too coarse.
inline constexpr double missed_event = 1e-6;

}  // namespace whirl::inline dyn
