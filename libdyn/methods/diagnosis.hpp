#pragma once

#include <string>
#include <string_view>

#include "libdyn/trajectory.hpp"

namespace whirl {

/// Says where an integration failed: time, contacts in touch, size of the state.
std::string diagnosis(const ContactSystem& system, const MotionState& state, std::string_view what);

}  // namespace whirl
