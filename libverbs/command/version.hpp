#pragma once
/// The version of whirl.

namespace whirl::inline cli {

/// As the build has it, such as "0.2.0".
extern const char* const version;

}  // namespace whirl::inline cli
