#pragma once

#include <cstddef>
#include <vector>

namespace whirl::inline io {

/// Some points of a study: every so-manieth value along each of its axes, the first one among them.
struct CoarseGrid {
  std::vector<std::size_t> sizes{};  ///< of the axes
  std::vector<std::size_t> steps{};  ///< one per axis

  bool is_all() const;
  /// Number of values along an axis that the coarse grid has.
  std::size_t taken(std::size_t axis) const {
    return (sizes[axis] + steps[axis] - 1) / steps[axis];
  }
  std::size_t points() const;
  bool has(std::size_t point) const;
  /// The number, within the coarse grid, of a point that it has.
  std::size_t number_of(std::size_t point) const;
};

}  // namespace whirl::inline io
