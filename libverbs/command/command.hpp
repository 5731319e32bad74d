#pragma once
/// A command, from its words to what is printed.

#include <string>
#include <vector>

#include "libverbs/command/command_line.hpp"
#include "libverbs/command/verb.hpp"

namespace whirl::inline cli {

/// Runs a verb that takes a file, and prints what it found or why it did not.
///
/// @param words   the whole line: the program and the verb first
/// @param stored  the model to take instead of the file, when the command of a result is run again
/// @param ranks   processes that share the work of the verb, led by this one; null: there are none
/// @return        exit status: 0, 2 (wrong input), 3 (failed) or 130 (stopped)
int run_command(const Verb& verb, const std::vector<std::string>& words,
                const StoredModel& stored = {}, const Ranks* ranks = nullptr);

/// Shares the work of a verb whose leader runs these words, and prints nothing. Returns if the verb
/// shares no work or fails; the leader is told why, if it does not know.
/// @throws WorkIsDone  once the leader has ended
void serve_command(const Verb& verb, const std::vector<std::string>& words, const Ranks& ranks);

}  // namespace whirl::inline cli
