#include "libio/drawing/near_range.hpp"

#include <algorithm>
#include <cmath>

namespace whirl::inline io {

std::optional<Extent> near_range(const std::vector<Extent>& extents) {
  constexpr double small = 0.1;  // of the largest size: below, what is near cannot be seen
  constexpr double gap = 3.0;    // from the sizes that are near to the next one
  constexpr double least = 0.1;  // of all extents
  std::vector<double> ends;
  for (const Extent& e : extents) ends.insert(ends.end(), {e.low, e.high});
  if (ends.empty()) return std::nullopt;
  const auto middle = ends.begin() + std::ssize(ends) / 2;
  std::nth_element(ends.begin(), middle, ends.end());
  const double median = *middle;
  const auto size = [&](const Extent& e) { return std::max(e.high - median, median - e.low); };
  std::vector<double> sizes;
  for (const Extent& e : extents) sizes.push_back(size(e));
  std::sort(sizes.begin(), sizes.end());
  const auto count = static_cast<std::size_t>(std::ceil(least * static_cast<double>(sizes.size())));
  for (std::size_t k = sizes.size() - 1; k >= std::max<std::size_t>(1, count); --k) {
    const double near = sizes[k - 1];
    if (!(near > 0.0 && near < small * sizes.back() && sizes[k] >= gap * near)) continue;
    Extent range{INFINITY, -INFINITY};
    for (const Extent& e : extents) {
      if (size(e) > near) continue;
      range.low = std::min(range.low, e.low);
      range.high = std::max(range.high, e.high);
    }
    return range;
  }
  return std::nullopt;
}

}  // namespace whirl::inline io
