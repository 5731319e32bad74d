#include "apps/completion.hpp"

#include <fmt/format.h>

#include "apps/verb.hpp"

namespace whirl {

std::string bash_completion() {
  std::string words, cases, takes_value = "--set|--speed|--threads";
  for (const Verb& verb : verbs()) {
    words += std::string(verb.name) + ' ';
    std::string options = "--set --speed --out --json --threads --force --quiet --help";
    for (const OptionSpec& o : verb.options) {
      const std::string name = "--" + std::string(o.name);
      if (name != "--out") options += ' ' + name;
      const bool is_file = o.value.find("FILE") != std::string_view::npos || o.name == "out";
      if (!o.value.empty() && !is_file) takes_value += '|' + name;
    }
    cases += fmt::format("    {}) options=\"{}\" ;;\n", verb.name, options);
  }
  return fmt::format(
      R"(# Completion of whirl for bash: put  source <(whirl completion)  into ~/.bashrc
_whirl() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} options=""
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "{}rerun completion schema help --help --version" -- "$word"))
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
      words, takes_value, cases);
}

}  // namespace whirl
