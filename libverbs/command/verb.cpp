#include "libverbs/command/verb.hpp"

#include <algorithm>

#include "libio/results/call.hpp"
#include "libverbs/command/invocation.hpp"

namespace whirl::inline cli {

const Verb* verb_named(std::string_view name) {
  for (const Verb& verb : verbs()) {
    if (verb.name == name || (!verb.alias.empty() && verb.alias == name)) return &verb;
  }
  return nullptr;
}

bool shares_work(const Verb& verb, const GivenValues& given) {
  return verb.shares_work && (verb.shares_with.empty() || given.contains(verb.shares_with));
}

const std::vector<OptionSpec>& own_options(const Verb& verb) {
  return verb.run_words ? verb.options_in_words : verb.run.options;
}

std::vector<OptionSpec> options_of(const Verb& verb) {
  const std::vector<OptionSpec>& own = own_options(verb);
  if (verb.takes.empty()) return own;
  std::vector<OptionSpec> all = specs_of<ModelOptions>();
  all.insert(all.end(), own.begin(), own.end());
  for (const OptionSpec& option : specs_of<OutputOptions>()) {
    const bool is_own = std::any_of(own.begin(), own.end(),
                                    [&](const OptionSpec& o) { return o.name == option.name; });
    if (!is_own) all.push_back(option);
  }
  return all;
}

std::vector<std::string_view> left_out_again(const Verb& verb,
                                             const std::vector<std::string>& added) {
  const auto is_added = [&](std::string_view name) {
    return std::any_of(added.begin(), added.end(),
                       [&](const std::string& word) { return option_name(word) == name; });
  };
  std::vector<std::string_view> names;
  for (const OptionSpec& option : options_of(verb)) {
    const std::string_view other = option.goes_with;
    if (option.writes() || (!other.empty() && !is_added(other))) names.push_back(option.name);
  }
  return names;
}

std::optional<OptionSpec> option_named(const Verb& verb, std::string_view name) {
  for (const OptionSpec& option : options_of(verb)) {
    if (option.name == name) return option;
  }
  return std::nullopt;
}

}  // namespace whirl::inline cli
