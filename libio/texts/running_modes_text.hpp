#pragma once

#include <string>

#include "libdata/measured/running_modes.hpp"

namespace whirl::inline io {

/// Table of the modes, frequency-domain decomposition beside them, and what they were found from.
std::string text_of(const RunningModes& found);

}  // namespace whirl::inline io
