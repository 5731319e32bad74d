#include "libio/model/meant_path.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

namespace whirl::inline io {

namespace {

/// Adds the paths of some values with a key, below the top of the tree, as set_value takes them.
void paths_to(const ConfigNode& node, std::string_view key, const std::string& path,
              std::vector<std::string>& found) {
  constexpr std::size_t most_found = 4;
  const auto inner = [&](const std::string& part, const ConfigNode& below) {
    paths_to(below, key, path.empty() ? part : path + "." + part, found);
  };
  for (const auto& [name, entry] : node.entries) {
    if (found.size() == most_found) return;
    if (name == key && !path.empty()) found.push_back(path + "." + name);
    inner(name, entry);
  }
  for (std::size_t i = 0; i < node.items.size() && found.size() < most_found; ++i) {
    const ConfigNode* const name = node.items[i].find("name");
    const bool is_plain = name && name->text.find_first_of(". ,=\"") == std::string::npos;
    inner(is_plain ? name->text : std::to_string(i + 1), node.items[i]);
  }
}

}  // namespace

void throw_if_meant(const ConfigNode& root, const std::string& key, const std::string& asked,
                    const Where& where) {
  std::vector<std::string> found;
  paths_to(root, key, "", found);
  // what a model need not have, and what the field calls otherwise
  constexpr std::array others{
      std::pair{"speed", "operation.speed"},    std::pair{"rpm", "operation.speed"},
      std::pair{"omega", "operation.speed"},    std::pair{"Omega", "operation.speed"},
      std::pair{"mu", "contact.NAME.friction"}, std::pair{"gap", "contact.NAME.clearance"}};
  for (const auto& [word, path] : others) {
    if (key == word && std::find(found.begin(), found.end(), path) == found.end()) {
      found.insert(found.begin(), path);
    }
  }
  if (found.empty()) return;
  throw ModelError(
      where, asked,
      fmt::format("is in a table of the model: did you mean {}?", fmt::join(found, " or ")));
}

}  // namespace whirl::inline io
