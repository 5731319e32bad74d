#include "libverbs/command/words.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "libio/text/nearest.hpp"

namespace whirl::inline cli {

std::variant<SortedWords, std::string> sorted_words(const std::vector<std::string>& words,
                                                    const std::vector<OptionSpec>& options) {
  SortedWords sorted;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (!word.starts_with("--")) {
      sorted.alone.push_back(word);
      continue;
    }
    const auto equals = word.find('=');
    const std::string name = word.substr(2, equals == word.npos ? word.npos : equals - 2);
    const auto option = std::find_if(options.begin(), options.end(),
                                     [&](const OptionSpec& o) { return o.name == name; });
    if (option == options.end()) {
      std::vector<std::string> known;
      for (const OptionSpec& o : options) known.push_back("--" + std::string(o.name));
      return unknown_option(std::vector{word}, known)
          .value_or(fmt::format("cannot place {}", word));
    }
    if (option->is_flag() && equals != word.npos) return fmt::format("--{} takes no value", name);
    if (option->is_flag()) {
      sorted.given[name] = {""};
    } else if (equals != word.npos) {
      sorted.given[name] = {word.substr(equals + 1)};
    } else if (++i < words.size()) {
      sorted.given[name] = {words[i]};
    } else {
      return fmt::format("--{} needs a value: {}", name, option->value);
    }
  }
  return sorted;
}

}  // namespace whirl::inline cli
