#pragma once
/// What a verb of the command line is: how it is called, its options, and what runs it.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace whirl::inline cli {

class Invocation;
struct Report;

/// An option of a verb.
struct OptionSpec {
  std::string_view name;   ///< without dashes
  std::string_view value;  ///< placeholder of its value; empty: a flag
  std::string_view help;   ///< without the default
  /// Value where it is left out. Empty: none, or one that the model or other options decide; the
  /// help says so then.
  std::string_view otherwise = "";

  bool is_flag() const { return value.empty(); }
};

/// A verb; it is described in the file that runs it, which is named after it.
struct Verb {
  std::string_view name;
  std::string_view alias = "";  ///< the field's name of it, where that is another one
  std::string_view group;       ///< heading in the help
  std::string_view summary;
  std::string_view takes = "MODEL";       ///< MODEL, RESULT.h5 or FILE (either); empty: no file
  std::string_view takes_more = "";       ///< placeholder of words after the file; empty: none
  std::string_view takes_more_help = "";  ///< what they are
  std::string_view example;               ///< a command line
  std::vector<OptionSpec> options{};      ///< beside those of all verbs
  Report (*run)(const Invocation&) = nullptr;
  /// Instead of run, of a verb that reads the words after it itself and prints: its exit status.
  int (*run_words)(const std::vector<std::string>&) = nullptr;
  std::string_view usage = "";  ///< what --help prints then
};

/// All verbs, in the order of the help.
const std::vector<Verb>& verbs();
/// The one of a name or alias; null: there is none.
const Verb* verb_named(std::string_view name);

/// All options of a verb in the order of its help: those of all verbs around its own, which take
/// their place where they have the same name. A verb that takes no file has only its own.
std::vector<OptionSpec> options_of(const Verb& verb);
/// The one of a name; nothing: there is none.
std::optional<OptionSpec> option_named(const Verb& verb, std::string_view name);

/// What the help says of an option, with its default in parentheses.
std::string help_of(const OptionSpec& option);

}  // namespace whirl::inline cli
