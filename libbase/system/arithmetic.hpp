#pragma once
/// What the mathematical functions of this machine round to.

#include <string>

namespace whirl::inline base {

/// The mathematical library by its values: its name and version, and a digest of sin, cos, tan,
/// atan2, exp, log, pow, sinh and their like at fixed arguments, "glibc 2.36 1f9ab3c0". Where this
/// text is the same, the functions are the same bit by bit. The digest is needed since the library
/// chooses among several versions of each function by the processor.
std::string mathematics();

/// Lets the library of mathematical functions use no more than what every processor has, so that
/// the functions are the same on all processors. Where the library can choose, and has not been
/// told so yet, the program starts again with the words that it was started with. To be called
/// before anything is computed.
/// @throws std::system_error  if it cannot start again
void use_portable_mathematics();

}  // namespace whirl::inline base
