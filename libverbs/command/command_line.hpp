#pragma once
/// From the words of a command line to an invocation.

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "libverbs/command/invocation.hpp"
#include "libverbs/command/verb.hpp"

namespace whirl::inline cli {

/// The model of a result whose command is run again, with what was set in the model.
struct StoredModel {
  std::string text;  ///< empty: there is none
  std::vector<std::string> sets{};
  /// Files that a study takes its points from, instead of computing any.
  std::optional<std::vector<std::string>> joins{};
};

/// What a command line asks for.
struct CommandLine {
  Invocation call;
  std::optional<std::string> speed{};  ///< value of --speed, which is the last of the sets too
};

/// Reads the words of a command, the program and the verb first, as the options of its verb say.
///
/// @return  the exit status instead, where there is nothing to run: help was asked for and printed,
///          or what is wrong with the words is on standard error
std::variant<CommandLine, int> read_command_line(const Verb& verb,
                                                 const std::vector<std::string>& words,
                                                 const StoredModel& stored);

}  // namespace whirl::inline cli
