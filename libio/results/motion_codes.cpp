#include "libio/results/motion_codes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "libio/results/checkpoint.hpp"

namespace whirl {

std::string motion_words() {
  std::string words;
  for (const auto& [name, kind] : choices(MotionKind{})) {
    words += (words.empty() ? "" : ",") + std::string(name);
  }
  return words;
}

std::string motion_legend() {
  std::string legend;
  for (const auto& [name, kind] : choices(MotionKind{})) {
    legend += fmt::format("{} {}, ", static_cast<int>(kind), name);
  }
  return legend + "-1 failed";
}

MotionCodes::MotionCodes(const ResultReader& file, const std::string& dataset) {
  std::istringstream words(file.has_attribute(dataset, words_attribute)
                               ? file.string_attribute(dataset, words_attribute)
                               : motion_words());
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

}  // namespace whirl
