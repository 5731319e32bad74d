#pragma once

#include <string>

#include "libdyn/studies/resonance_study.hpp"

namespace whirl::inline io {

/// Table of the resonances, with the motions that were found to bounce if these were looked for.
std::string text_of(const ResonanceStudy& study);

}  // namespace whirl::inline io
