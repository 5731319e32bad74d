#include <fmt/format.h>

#include <set>

#include "apps/status.hpp"
#include "apps/verb.hpp"

namespace whirl::inline cli {

namespace {

constexpr std::string_view completion_usage =
    "Usage: whirl completion\n\nPrints a script that completes verbs, options and names of files "
    "in bash:\nput  source <(whirl completion)  into ~/.bashrc\n";

std::string bash_completion() {
  std::string words, cases;
  std::set<std::string> with_value;  // that is no file
  for (const Verb& verb : verbs()) {
    words += std::string(verb.name) + ' ';
    std::string options;
    for (const OptionSpec& o : options_of(verb)) {
      const std::string name = "--" + std::string(o.name);
      options += name + ' ';
      const bool is_file = o.value.find("FILE") != std::string_view::npos || o.name == "out";
      if (!o.is_flag() && !is_file) with_value.insert(name);
    }
    cases += fmt::format("    {}) options=\"{}--help\" ;;\n", verb.name, options);
  }
  return fmt::format(
      R"(# Completion of whirl for bash: put  source <(whirl completion)  into ~/.bashrc
_whirl() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} options=""
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "{}help --help --version" -- "$word"))
    return
  fi
  case "$before" in
    {}) return ;;
  esac
  case "${{COMP_WORDS[1]}}" in
{}  esac
  if [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$word"))
  else
    COMPREPLY=($(compgen -f -- "$word"))
  fi
}}
complete -o filenames -F _whirl whirl
)",
      words, fmt::join(with_value, "|"), cases);
}

int run_completion(const std::vector<std::string>&) {
  fmt::print("{}", bash_completion());
  return after_printing(exit_status::done);
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
