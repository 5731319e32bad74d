#pragma once
/// The program: finds the verb of a command line and runs it.

#include <string>
#include <vector>

#include "libbase/processes/ranks.hpp"

namespace whirl::inline cli {

/// Runs a command line.
/// @param words  the program first
/// @param ranks  processes that share its work, led by this one; null: there are none
/// @return       exit status
int run_program(const std::vector<std::string>& words, const Ranks* ranks = nullptr);

/// Does what the leader of this process shares of its command line, until it has ended.
void serve_program(const Ranks& ranks);

}  // namespace whirl::inline cli
