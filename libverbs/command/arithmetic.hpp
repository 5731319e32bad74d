#pragma once
/// The arithmetic that a call asks for.

#include <string>

namespace whirl::inline cli {

/// From now on motions are computed with this instruction set, and with `baseline` mathematical
/// functions are those that every processor has, too, for which the program may start again. To be
/// called before anything is computed or read.
/// @param isa  of --isa; empty: the best one
/// @throws ModelError  if it is not to be had
void adopt_arithmetic(const std::string& isa);

}  // namespace whirl::inline cli
