#pragma once
/// Words of verbs that read them themselves.

#include <string>
#include <variant>
#include <vector>

#include "libio/text/option.hpp"

namespace whirl::inline cli {

/// Words, sorted into those that stand alone and options, which may stand anywhere between them.
struct SortedWords {
  std::vector<std::string> alone{};  ///< in their order
  GivenValues given{};
};

/// Sorts words.
/// @return  the sorted words, or what is wrong: an unknown option, or an option without its value
std::variant<SortedWords, std::string> sorted_words(const std::vector<std::string>& words,
                                                    const std::vector<OptionSpec>& options);

}  // namespace whirl::inline cli
