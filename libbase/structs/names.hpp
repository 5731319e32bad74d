#pragma once

#include <string>
#include <string_view>

namespace whirl::inline base {

/// A name with its kind, said once: "bearing left" of "left", but "bearing 1" of "bearing 1".
inline std::string named(std::string_view kind, const std::string& name) {
  return name.starts_with(kind) ? name : std::string(kind) + " " + name;
}

}  // namespace whirl::inline base
