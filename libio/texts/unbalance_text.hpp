#pragma once

#include <string>
#include <vector>

#include "libdyn/linear/unbalance_study.hpp"

namespace whirl::inline io {

/// Largest responses of the stations, and peaks with their amplification and margins.
std::string text_of(const UnbalanceStudy& study, const Model& model);

/// What keeps the response from being the whole truth, a sentence each.
std::vector<std::string> notes_of(const UnbalanceStudy& study);

}  // namespace whirl::inline io
