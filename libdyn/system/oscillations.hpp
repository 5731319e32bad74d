#pragma once
/// Loads of other frequencies than that of the speed.

#include "libdyn/system/contact_system.hpp"
#include "libfe/forces.hpp"

namespace whirl::inline dyn {

/// Frequency of a load over that of the speed [rad/s].
/// @throws NumericalError  if it changes too often for a revolution at this speed
double frequency_ratio(const Structure& structure, const OscillatingLoad& load, double phase_rate);

/// Whether all loads repeat together, after revolutions or after another time: forces of one frequency
/// of their own repeat with it where nothing has that of the speed.
bool loads_repeat(const ContactSystem& system);

}  // namespace whirl::inline dyn
