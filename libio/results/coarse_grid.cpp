#include "libio/results/coarse_grid.hpp"

#include <algorithm>

namespace whirl::inline io {

bool CoarseGrid::is_all() const {
  return std::all_of(steps.begin(), steps.end(), [](std::size_t step) { return step == 1; });
}

std::size_t CoarseGrid::points() const {
  std::size_t product = 1;
  for (std::size_t i = 0; i < sizes.size(); ++i) product *= taken(i);
  return product;
}

bool CoarseGrid::has(std::size_t point) const {
  for (std::size_t i = sizes.size(); i-- > 0; point /= sizes[i]) {
    if (point % sizes[i] % steps[i] != 0) return false;
  }
  return true;
}

std::size_t CoarseGrid::number_of(std::size_t point) const {
  std::size_t number = 0, stride = 1;
  for (std::size_t i = sizes.size(); i-- > 0; point /= sizes[i]) {
    number += point % sizes[i] / steps[i] * stride;
    stride *= taken(i);
  }
  return number;
}

}  // namespace whirl::inline io
