#pragma once

#include <string>

#include "libdyn/studies/basins.hpp"

namespace whirl::inline io {

/// Table of the coexisting motions, that with the largest share first.
std::string text_of(const BasinShares& shares);

}  // namespace whirl::inline io
