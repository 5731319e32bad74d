#pragma once

#include <string>

#include "libdyn/motions/identify.hpp"

namespace whirl::inline io {

/// Table of peaks against modes, the best mode of a peak beside it; the resonance below.
/// @param Omega  speed of the rotor [rad/s]
std::string text_of(const Identification& found, double Omega);

}  // namespace whirl::inline io
