#pragma once
/// What is said of a rotor that is unstable at a speed, beside responses that it does not settle
/// to.

#include <string>
#include <vector>

#include "libfe/analyses/campbell.hpp"
#include "libfe/analyses/modes.hpp"

namespace whirl::inline io {

/// A note where a mode grows by itself at one of some speeds; none where the rotor is stable at all
/// of them, or has no modes there, as on oil films without speed.
/// @param speeds  that are looked at [rad/s]
std::vector<std::string> unstable_notes(const Assembler& assembler, std::vector<double> speeds);

/// The same of a diagram whose modes grow from its first speed on, where no threshold is crossed.
std::vector<std::string> unstable_notes(const Campbell& diagram);

}  // namespace whirl::inline io
