#include "libio/model/foreign_table.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "libio/text/encoding.hpp"

namespace whirl::inline io {

std::optional<ForeignName> foreign_name(const std::string& name) {
  constexpr std::array<std::string_view, 6> endings{".mat", ".h5", ".hdf5", ".uff", ".unv", ".ufb"};
  const auto at = name.find('#');
  ForeignName found{name.substr(0, at)};
  if (at != std::string::npos) found.part = name.substr(at + 1);
  const std::string ending = lower_case(std::filesystem::path(found.file).extension().string());
  if (std::ranges::find(endings, ending) == endings.end()) return std::nullopt;
  return found;
}

}  // namespace whirl::inline io
