#pragma once
/// What the mathematical functions of this machine round to.

#include <string>

namespace whirl::inline base {

/// The mathematical library by its values: its name and version, and a digest of sin, cos, tan,
/// atan2, exp, log, pow, sinh and their like at fixed arguments, "glibc 2.36 1f9ab3c0". Where it is
/// the same, they are the same bit by bit: the library chooses among several of each by the
/// processor.
std::string mathematics();

/// Lets the library of mathematical functions use no more than what every processor has, so that it
/// is the same on all of them: where it can choose, and has not been told so yet, the program
/// starts again with the words that it was started with. To be called before anything is computed.
/// @throws std::system_error  if it cannot start again
void use_portable_mathematics();

}  // namespace whirl::inline base
