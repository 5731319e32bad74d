#pragma once
/// What a verb of the command line is: how it is called, its options, and what runs it.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "libbase/processes/ranks.hpp"
#include "libio/text/option.hpp"

namespace whirl::inline cli {

class Invocation;
struct Report;

/// What runs a verb, and the options that it takes.
struct VerbRun {
  std::vector<OptionSpec> options{};
  std::function<Report(const Invocation&)> with{};

  VerbRun() = default;
  template <std::same_as<Invocation> Call>
  VerbRun(Report (*run)(const Call&)) : with(run) {}
  template <class Options>
  VerbRun(Report (*run)(const Invocation&, const Options&))
      : options(specs_of<Options>()),
        with([run](const auto& call) { return run(call, read_options<Options>(call.given)); }) {}
};

/// A verb; it is described in the file that runs it, which is named after it.
struct Verb {
  std::string_view name;
  std::string_view alias = "";  ///< the field's name of the verb, if that is another one
  std::string_view group;       ///< heading in the help
  std::string_view summary;
  std::string_view takes = "MODEL";       ///< MODEL, RESULT.h5 or FILE (either); empty: no file
  std::string_view takes_more = "";       ///< placeholder of words after the file; empty: none
  std::string_view takes_more_help = "";  ///< what these words are
  std::string_view example;               ///< a command line
  VerbRun run{};
  bool shares_work = false;           ///< run hands pieces to other processes, see Ranks
  std::string_view shares_with = "";  ///< option that asks for such work; empty: every call does
  /// Instead of run, for a verb that reads the words after it itself, and prints; returns the exit
  /// status. Of several processes only the leader calls it, with the Ranks that may share the work;
  /// null: there are none.
  int (*run_words)(const std::vector<std::string>& words, const Ranks*) = nullptr;
  std::string_view usage = "";                 ///< what --help prints of such a verb
  std::vector<OptionSpec> options_in_words{};  ///< options among those words
};

/// All verbs, in the order of the help.
const std::vector<Verb>& verbs();
/// The verb of a name or alias; null: there is none.
const Verb* verb_named(std::string_view name);

/// Whether a call of a verb with these options hands pieces to other processes.
bool shares_work(const Verb& verb, const GivenValues& given);

/// The options of a verb beside those of all verbs.
const std::vector<OptionSpec>& own_options(const Verb& verb);
/// All options of a verb in the order of its help: the options of all verbs stand around its own,
/// which replace output options of the same name. A verb that takes no file has only its own.
std::vector<OptionSpec> options_of(const Verb& verb);
/// Options of a stored command line that do not count when it is run again: only words that are
/// added say what is written.
std::vector<std::string_view> left_out_again(const Verb& verb,
                                             const std::vector<std::string>& added);
/// The option of a name; nothing: there is none.
std::optional<OptionSpec> option_named(const Verb& verb, std::string_view name);

}  // namespace whirl::inline cli
