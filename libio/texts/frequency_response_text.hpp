#pragma once

#include <string>

#include "libdyn/linear/frequency_response.hpp"

namespace whirl::inline io {

/// Peaks of every response, with their phases and how sharp they are.
std::string text_of(const FrequencyResponse& found);

}  // namespace whirl::inline io
