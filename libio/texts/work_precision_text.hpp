#pragma once

#include <string>

#include "libdyn/studies/work_precision_study.hpp"
#include "libdyn/system/model.hpp"

namespace whirl::inline io {

/// Table of the runs, what errors are, and what to make of them.
std::string text_of(const WorkPrecisionStudy& study, const Model& model);

}  // namespace whirl::inline io
