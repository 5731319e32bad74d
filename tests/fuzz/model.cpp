// Text of models: whatever it is, a model comes of it or an error that says where. As a result
// stores it no file is opened for it: what it names as a table is refused.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "libbase/error.hpp"
#include "libio/model/config.hpp"
#include "libio/model/model_file.hpp"

namespace {

/// Whether a tree has a text of one line for a table, which is the name of a file.
bool names_file(const whirl::ConfigNode& node) {
  for (const auto& [key, value] : node.entries) {
    const bool is_text = value.kind == whirl::ConfigNode::Kind::string;
    if ((key == "table" || key == "bow") && is_text && value.text.find('\n') == std::string::npos)
      return true;
    if (names_file(value)) return true;
  }
  return std::any_of(node.items.begin(), node.items.end(), names_file);
}

/// A model that names a file where tables stand is none, as a result stores it.
void require_no_file(const std::string& text) {
  const whirl::ConfigNode root = whirl::parse_toml(text, "stored.toml");
  whirl::parse_model(text, "stored.toml");
  for (const char* owner : {"shaft", "bearing", "seal", "bow", "rotor"}) {
    const whirl::ConfigNode* node = root.find(owner);
    if (node && names_file(*node)) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    require_no_file(text);
  } catch (const whirl::ModelError&) {
  }
  try {
    const whirl::Model model = whirl::parse_model(text, "model.toml", {}, "/nowhere");
    // what a result stores is a model too
    whirl::parse_model(model.source, "stored.toml");
  } catch (const whirl::ModelError&) {
  }
  return 0;
}
