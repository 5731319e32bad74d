#pragma once

namespace whirl {

/// Version of the program, from the build.
inline constexpr const char* version = WHIRL_VERSION;

}  // namespace whirl
