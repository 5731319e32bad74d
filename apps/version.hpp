#pragma once

namespace whirl::inline cli {

/// Version of the program, from the build.
extern const char* const version;

}  // namespace whirl::inline cli
