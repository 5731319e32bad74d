#include "apps/verb.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace whirl::inline cli {

namespace {

// options of all verbs, before and behind those of a verb
const std::vector<OptionSpec> first_options{
    {"set", "PATH=VALUE", "set a value of the model by its path; may be given several times"},
    {"speed", "S", "operating speed, such as 3650rpm"}};
const std::vector<OptionSpec> last_options{
    {"out", "FILE.h5", "result file (HDF5)"},
    {"json", "FILE", "write the result as JSON; - is standard output"},
    {"threads", "N", "processors to use at most; left out: all"},
    {"force", "", "replace files that whirl did not write, too"},
    {"quiet", "", "print nothing but errors"}};

}  // namespace

const Verb* verb_named(std::string_view name) {
  for (const Verb& verb : verbs()) {
    if (verb.name == name || (!verb.alias.empty() && verb.alias == name)) return &verb;
  }
  return nullptr;
}

std::vector<OptionSpec> options_of(const Verb& verb) {
  if (verb.takes.empty()) return verb.options;
  std::vector<OptionSpec> all = first_options;
  all.insert(all.end(), verb.options.begin(), verb.options.end());
  for (const OptionSpec& option : last_options) {
    const bool is_own = std::any_of(verb.options.begin(), verb.options.end(),
                                    [&](const OptionSpec& own) { return own.name == option.name; });
    if (!is_own) all.push_back(option);
  }
  return all;
}

std::optional<OptionSpec> option_named(const Verb& verb, std::string_view name) {
  for (const OptionSpec& option : options_of(verb)) {
    if (option.name == name) return option;
  }
  return std::nullopt;
}

std::string help_of(const OptionSpec& option) {
  if (option.otherwise.empty()) return std::string(option.help);
  return fmt::format("{} ({})", option.help, option.otherwise);
}

}  // namespace whirl::inline cli
