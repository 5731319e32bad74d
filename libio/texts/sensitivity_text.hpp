#pragma once

#include <string>

#include "libdyn/linear/sensitivity.hpp"
#include "libdyn/linear/step_response.hpp"

namespace whirl::inline io {

/// The largest sensitivity of every loop, in dB, with its zone.
std::string text_of(const Sensitivity& found);
std::string text_of(const StepResponse& found);

}  // namespace whirl::inline io
