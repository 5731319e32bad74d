#pragma once

#include <string>

#include "libdyn/linear/static_study.hpp"

namespace whirl::inline io {

/// Displacements of all named places, loads of the bearings, and where the shaft bends and sags
/// most.
std::string text_of(const StaticStudy& study);

}  // namespace whirl::inline io
