#pragma once

#include <string>
#include <vector>

#include "libdyn/linear/unbalance_study.hpp"

namespace whirl::inline io {

/// Largest responses of the stations, and peaks with their amplification and margins.
std::string text_of(const UnbalanceStudy& study, const Model& model);

/// Why the response is not the whole truth, a sentence for each reason.
std::vector<std::string> notes_of(const UnbalanceStudy& study);

}  // namespace whirl::inline io
