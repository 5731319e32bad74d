#include <fmt/format.h>

#include <algorithm>

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

/// Whether an option of some verb has a value behind it: which verb it is stands in the file.
bool takes_value(const std::string& option) {
  return std::any_of(verbs().begin(), verbs().end(), [&](const Verb& verb) {
    const auto known = option_named(verb, option.substr(2));
    return known && !known->is_flag();
  });
}

/// The place of the file among words, which may stand behind options.
std::size_t file_among(const std::vector<std::string>& words) {
  std::size_t at = 0;
  while (at < words.size() && words[at].starts_with("--")) at += takes_value(words[at]) ? 2 : 1;
  return at;
}

/// The files that options of a stored line name and the line at hand does not: a stranger's result
/// must not say what is opened here.
std::vector<std::string> named_by_stored_line(const Verb& verb, const Call& call,
                                              const std::vector<std::string>& added) {
  std::vector<std::string_view> names;
  const std::vector<std::string_view> left_out = left_out_again(verb, added);
  for (const OptionSpec& option : options_of(verb)) {
    const bool is_said = std::any_of(added.begin(), added.end(), [&](const std::string& word) {
      return option_name(word) == option.name;
    });
    if (option.use == FileUse::read && !is_said &&
        std::find(left_out.begin(), left_out.end(), option.name) == left_out.end()) {
      names.push_back(option.name);
    }
  }
  return options_named(call.options, names);
}

/// Runs the command stored in a result again, on the model stored there.
int run_rerun(const std::vector<std::string>& words, const Ranks* ranks) {
  const std::size_t place = file_among(words);
  if (place >= words.size()) {
    say(stdout, rerun_usage);
    return exit_status::wrong_input;
  }
  const FilesInUse files;
  const std::string& file = words[place];
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
  std::vector<std::string> added = words;
  added.erase(added.begin() + static_cast<std::ptrdiff_t>(place));
  const std::vector<std::string> unsaid = named_by_stored_line(*verb, call, added);
  if (!unsaid.empty()) {
    say(stderr,
        fmt::format(
            "whirl: the command that made {} read more files, and a result does not say what "
            "is opened: add {}, or with other names\n",
            file, shell_line(unsaid)));
    return exit_status::wrong_input;
  }
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
