#pragma once

namespace whirl {

/// Version of the program, from the build.
extern const char* const version;

}  // namespace whirl
