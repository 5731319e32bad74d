#pragma once

#include <string>

#include "libdyn/studies/classification_result.hpp"

namespace whirl::inline io {

/// What was found of a motion, why it is so, its exponents and what its contacts do; if it was
/// stopped, after how long.
std::string text_of(const ClassificationResult& result);

}  // namespace whirl::inline io
