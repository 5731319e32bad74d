#pragma once
/// When the loads of a system repeat.

#include <optional>

#include "libdyn/system/contact_system.hpp"
#include "libfe/assembly/excitations.hpp"

namespace whirl::inline dyn {

/// Frequency of a load over that of the speed [rad/s].
/// @throws NumericalError  if it changes too often for a revolution at this speed
double frequency_ratio(const Structure& structure, const Excitation& load, double phase_rate);

/// Whether something turns with the rotor, once a revolution: unbalance, forces of order 1, places
/// that a contact has on it.
bool follows_the_speed(const ContactSystem& system);

/// Time after which all loads of a system repeat, if all have frequencies of their own [s];
/// nothing: one goes by the speed, there are none, or their frequencies are in no simple ratio.
std::optional<double> load_period(const ContactSystem& system);

/// Whether all loads repeat together, after revolutions or after another time: forces of one
/// frequency of their own repeat with it where nothing has that of the speed.
bool loads_repeat(const ContactSystem& system);

}  // namespace whirl::inline dyn
