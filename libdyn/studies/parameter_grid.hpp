#pragma once
/// Points of a study: all combinations of the values of some parameters.

#include <cstddef>
#include <vector>

namespace whirl::inline dyn {

/// Numbers of points run fastest along the last axis; without axes there is one point.
struct ParameterGrid {
  std::vector<std::vector<double>> axes;  ///< values of each parameter [SI]

  std::size_t points() const {
    std::size_t product = 1;
    for (const auto& values : axes) product *= values.size();
    return product;
  }

  /// Number of a point's value along each axis.
  std::vector<std::size_t> indices_of(std::size_t point) const {
    std::vector<std::size_t> indices(axes.size());
    for (std::size_t i = axes.size(); i-- > 0;) {
      indices[i] = point % axes[i].size();
      point /= axes[i].size();
    }
    return indices;
  }

  /// Values of the parameters at a point.
  std::vector<double> values_at(std::size_t point) const {
    const std::vector<std::size_t> indices = indices_of(point);
    std::vector<double> values;
    for (std::size_t i = 0; i < axes.size(); ++i) values.push_back(axes[i][indices[i]]);
    return values;
  }
};

}  // namespace whirl::inline dyn
