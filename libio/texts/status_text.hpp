#pragma once

#include <string>

#include "libio/results/study_status.hpp"

namespace whirl::inline io {

/// How far a study is, and whether it is running, in two lines.
std::string text_of(const StudyStatus& status);

}  // namespace whirl::inline io
