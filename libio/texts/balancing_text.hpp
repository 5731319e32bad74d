#pragma once

#include <string>

#include "libdata/balancing/balancing.hpp"

namespace whirl::inline io {

/// Weights of the planes, what goes into holes, and every reading before and after.
std::string text_of(const Balancing& balancing);

}  // namespace whirl::inline io
