#pragma once
/// Kinds of motion in result files: numbers, with the words they stand for beside them.

#include <optional>
#include <string>
#include <vector>

#include "libdyn/studies/classify.hpp"
#include "libio/results/hdf5.hpp"

namespace whirl::inline io {

/// Attribute of a dataset of codes: words separated by commas, the first one of code 0.
inline constexpr const char* words_attribute = "words";

/// Words of a list of choices, by their codes: "equilibrium,periodic,...".
template <class Enum>
std::string code_words() {
  std::string words;
  for (const auto& [name, code] : choices(Enum{})) {
    words += (words.empty() ? "" : ",") + std::string(name);
  }
  return words;
}

/// The same for people: "0 equilibrium, 1 periodic, ...".
template <class Enum>
std::string code_legend() {
  std::string legend;
  for (const auto& [name, code] : choices(Enum{})) {
    legend += (legend.empty() ? "" : ", ") + std::to_string(static_cast<int>(code)) + ' ' +
              std::string(name);
  }
  return legend;
}

}  // namespace whirl::inline io
