// Values that are set by their paths, as --set does: in a tree with tables and lists of all kinds.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "libbase/error.hpp"
#include "libio/model/config.hpp"

namespace {

constexpr std::string_view tree = R"(format = 1
[operation]
speed = "3000 rpm"
[material.steel]
density = 7850
[[shaft]]
material = "steel"
length = 0.6
[[contact]]
name = "ring"
stiffness = { xx = 1, yy = [1, 2, [3]] }
[[contact]]
name = "seal"
)";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view assignment(reinterpret_cast<const char*>(data), size);
  whirl::ConfigNode root = whirl::parse_toml(tree, "model.toml");
  try {
    whirl::set_value(root, assignment);
    whirl::parse_toml(whirl::to_toml(root), "set.toml");
  } catch (const whirl::ModelError&) {
  }
  return 0;
}
