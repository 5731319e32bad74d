#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace whirl::inline io {

/// Every so many rows of a long table, the first and the last among them.
struct SomeRows {
  std::vector<std::size_t> shown;
  std::string which;  ///< in words

  /// @param size  above zero
  /// @param what  what the rows are, in the plural
  SomeRows(std::size_t size, std::string_view what) {
    constexpr std::size_t most = 21;
    const std::size_t stride = std::max<std::size_t>(1, size / (most - 1));
    for (std::size_t i = 0; i < size; i += stride) shown.push_back(i);
    if (shown.back() + 1 < size) shown.push_back(size - 1);
    which = stride == 1 ? fmt::format("all {}", what)
                        : fmt::format("every {} of {} {} and the last; --json and --out have all",
                                      stride == 2   ? "second"
                                      : stride == 3 ? "third"
                                                    : fmt::format("{}th", stride),
                                      size, what);
  }
};

}  // namespace whirl::inline io
