#include "libio/results/motion_codes.hpp"

#include <algorithm>
#include <sstream>

namespace whirl::inline io {

MotionCodes::MotionCodes(const ResultReader& file, const std::string& dataset) {
  std::istringstream words(file.has_attribute(dataset, words_attribute)
                               ? file.string_attribute(dataset, words_attribute)
                               : code_words<MotionKind>());
  for (std::string word; std::getline(words, word, ',');) {
    const auto all = choices(MotionKind{});
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.first == word; });
    kinds_.push_back(found == all.end() ? std::nullopt : std::optional(found->second));
  }
}

std::optional<MotionKind> MotionCodes::kind(double code) const {
  if (!(code >= 0.0 && code < static_cast<double>(kinds_.size()))) return std::nullopt;
  return kinds_[static_cast<std::size_t>(code)];
}

}  // namespace whirl::inline io
