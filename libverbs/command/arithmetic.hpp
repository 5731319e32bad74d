#pragma once
/// The arithmetic that a call asks for.

#include <string>

namespace whirl::inline cli {

/// From now on motions are computed with this instruction set. With `baseline`, mathematical
/// functions also use no more than what every processor has, for which the program may start again.
/// To be called before anything is computed or read.
/// @param isa  value of --isa; empty: the best one
/// @throws ModelError  if this processor or program does not have it
void adopt_arithmetic(const std::string& isa);

}  // namespace whirl::inline cli
