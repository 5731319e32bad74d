#pragma once
/// When all that moves a rotor from outside repeats.

#include "libdyn/system/contact_system.hpp"

namespace whirl::inline dyn {

/// Whether all loads repeat together, after revolutions or after another time: forces of one frequency
/// of their own repeat with it where nothing has that of the speed.
bool loads_repeat(const ContactSystem& system);

}  // namespace whirl::inline dyn
