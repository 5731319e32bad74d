#pragma once

#include <string_view>

#include "libdyn/system/abilities.hpp"
#include "libdyn/system/trajectory.hpp"

namespace whirl::inline dyn {

/// The classical Runge-Kutta method of order 4 with equal steps and no regard to events, as many
/// published studies of rubbing rotors use it: contacts and the sign of friction follow from the
/// state of each stage.
///
///     0 |
///   1/2 | 1/2
///   1/2 |  0  1/2
///     1 |  0   0   1
///       | 1/6 1/3 1/3 1/6
///
/// A motion without contacts has order 4. Where a contact begins or ends within a step, the kink of
/// its force leaves an error of order 2 to 3 in this step, and the order of the motion falls to
/// about 2, erratically; jumps of the friction leave order 1.
///
/// There is no error control: a revolution takes a whole number of steps, of `fixed_step` at most,
/// or if that is not given 1000 at the default tolerance of 1e-10 (the number of those studies) and
/// (tolerance / 1e-10)^(-1/4) times as many at others, as the error of a smooth motion asks.
///
/// @source [Kutta1901]
struct Rk4 {
  static constexpr std::string_view name = "rk4";
  static constexpr Abilities abilities{"method rk4"};
  static Integration integrate(const ContactSystem& system, MotionState& state, long revolutions,
                               const IntegrationOptions& options, const Observer& observer);
};

}  // namespace whirl::inline dyn
