#pragma once
/// Gears of ROSS.

#include <optional>

#include "libio/import/ross.hpp"
#include "libio/import/ross_section.hpp"

namespace whirl::inline io {

/// Reads a gear, as a disk and its teeth. What is not told of its mass follows from its width.
void read_ross_gear(const RossSection& section, RossRotor& rotor, UnreadKeys& unread);

/// Reads what the parameters of a rotor say of a second shaft.
void read_ross_shafts(const RossSection& parameters, RossRotor& rotor);

/// Stiffness of the teeth of two gears in mesh [N/m], where the file has none: with e the contact
/// ratio and w the width of the driving gear,
///
///   k = e w E_1 E_2 / (9 (E_1 + E_2))
///
/// @return  nothing, if the file does not say how many teeth there are, or how wide
std::optional<double> mesh_stiffness(const RossGear& driving, const RossGear& driven);

}  // namespace whirl::inline io
