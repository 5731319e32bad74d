#include "libio/text/bash_completion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

namespace whirl::inline io {

namespace {

constexpr const char* script =
    R"(# Completion of {0} for bash: put  source <({0} completion)  into ~/.bashrc
_{0}() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} options=""
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "{1}help --help --version" -- "$word"))
    return
  fi
  case "$before" in
    {2}) return ;;
  esac
  case "${{COMP_WORDS[1]}}" in
{3}  esac
  if [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$word"))
  else
    COMPREPLY=($(compgen -f -- "$word"))
  fi
}}
complete -o filenames -F _{0} {0}
)";

}  // namespace

std::string bash_completion(const std::string& program, const std::vector<CompletedVerb>& verbs) {
  std::string words, cases;
  std::set<std::string> with_value;
  for (const CompletedVerb& verb : verbs) {
    for (const std::string& name : verb.names) words += name + ' ';
    cases += fmt::format("    {}) options=\"", fmt::join(verb.names, "|"));
    for (const std::string& option : verb.options) cases += option + ' ';
    cases += "--help\" ;;\n";
    with_value.insert(verb.with_value.begin(), verb.with_value.end());
  }
  return fmt::format(script, program, words, fmt::join(with_value, "|"), cases);
}

}  // namespace whirl::inline io
