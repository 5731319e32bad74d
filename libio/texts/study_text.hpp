#pragma once

#include <string>

#include "libdyn/studies/study_outcome.hpp"

namespace whirl::inline io {

/// What was there already, what has not settled, what failed, and whether the study was stopped.
/// @param has_file  whether the study can go on from a file
std::string text_of(const StudyOutcome& outcome, bool has_file);

}  // namespace whirl::inline io
