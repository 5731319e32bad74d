#include <fmt/format.h>

#include "libio/results/call.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/text/files_in_use.hpp"
#include "libio/text/terminal.hpp"
#include "libverbs/command/command.hpp"
#include "libverbs/command/exit_status.hpp"
#include "libverbs/command/verb.hpp"

namespace whirl::inline cli {

namespace {

constexpr std::string_view rerun_usage =
    "Usage: whirl rerun RESULT.h5 [options]\n\nRuns the command that made a result again, on the "
    "model stored in it;\noptions are added to that command (--out NEW.h5, --set PATH=VALUE, "
    "...).\n";

/// Runs the command stored in a result again, on the model stored there.
int run_rerun(const std::vector<std::string>& words, const Ranks* ranks) {
  if (words.empty()) {
    say(stdout, rerun_usage);
    return exit_status::wrong_input;
  }
  const FilesInUse files;
  const std::string& file = words[0];
  Call call;
  std::string text;
  try {
    const ResultReader result(file);
    call = read_call(result);
    text = stored_model(result);
  } catch (const FileError& error) {
    return refused(error);
  }
  const Verb* const verb = verb_named(call.verb);
  if (!verb || verb->takes != "MODEL" || call.file.empty() || call.file.starts_with('-')) {
    say(stderr, fmt::format("whirl: {} does not hold the command that made it\n", file));
    return exit_status::wrong_input;
  }
  const std::vector<std::string> added(words.begin() + 1, words.end());
  std::vector<std::string> line = words_again("whirl", call, left_out_again(*verb, added));
  line.insert(line.end(), added.begin(), added.end());
  return run_command(*verb, line, {text, call.sets}, ranks);
}

}  // namespace

Verb rerun_verb() {
  return {
      .name = "rerun",
      .group = "Results",
      .summary = "runs the command that made a result again",
      .takes = "RESULT.h5",
      .example = "whirl rerun run.h5",
      .run_words = run_rerun,
      .usage = rerun_usage,
  };
}

}  // namespace whirl::inline cli
