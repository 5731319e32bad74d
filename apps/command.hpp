#pragma once
/// A command, from its words to what is printed.

#include <string>
#include <vector>

#include "apps/command_line.hpp"
#include "apps/verb.hpp"

namespace whirl::inline cli {

/// Runs a verb that takes a file, and prints what it found or why it did not.
///
/// @param words   the whole line: the program and the verb first
/// @param stored  the model to take instead of the file, of a result whose command is run again
/// @return        exit status: 0, 2 (wrong input), 3 (failed) or 130 (stopped)
int run_command(const Verb& verb, const std::vector<std::string>& words,
                const StoredModel& stored = {});

}  // namespace whirl::inline cli
