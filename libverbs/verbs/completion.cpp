#include <fmt/format.h>

#include "libio/text/bash_completion.hpp"
#include "libio/text/terminal.hpp"
#include "libverbs/command/exit_status.hpp"
#include "libverbs/command/verb.hpp"

namespace whirl::inline cli {

namespace {

constexpr std::string_view completion_usage =
    "Usage: whirl completion\n\nPrints a script that completes verbs, options and names of files "
    "in bash:\nput  source <(whirl completion)  into ~/.bashrc\n";

int run_completion(const std::vector<std::string>& words, const Ranks*) {
  if (!words.empty()) {
    say(stderr, completion_usage);
    return exit_status::wrong_input;
  }
  std::vector<CompletedVerb> completed;
  for (const Verb& verb : verbs()) {
    CompletedVerb& to = completed.emplace_back();
    to.names.emplace_back(verb.name);
    if (!verb.alias.empty()) to.names.emplace_back(verb.alias);
    for (const OptionSpec& o : options_of(verb)) {
      to.options.push_back("--" + std::string(o.name));
      const bool is_file = o.value.find("FILE") != std::string_view::npos || o.name == "out";
      if (!o.is_flag() && !is_file) to.with_value.push_back(to.options.back());
    }
  }
  say(stdout, bash_completion("whirl", completed));
  return exit_status::done;
}

}  // namespace

Verb completion_verb() {
  return {
      .name = "completion",
      .group = "Shells and editors",
      .summary = "a script that completes verbs and options in bash",
      .takes = "",
      .example = "source <(whirl completion)",
      .run_words = run_completion,
      .usage = completion_usage,
  };
}

}  // namespace whirl::inline cli
