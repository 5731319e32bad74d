#pragma once
/// Completion of a command line by bash.

#include <string>
#include <vector>

namespace whirl::inline io {

/// A verb whose options are completed.
struct CompletedVerb {
  std::vector<std::string> names;       ///< its name and its aliases
  std::vector<std::string> options;     ///< "--speed"
  std::vector<std::string> with_value;  ///< options that want a value that is no file
};

/// A script that completes verbs, their options and names of files.
/// @param program  its name, a word
std::string bash_completion(const std::string& program, const std::vector<CompletedVerb>& verbs);

}  // namespace whirl::inline io
