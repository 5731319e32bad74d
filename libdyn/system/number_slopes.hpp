#pragma once
/// Derivatives by a parameter of the numbers that a system has.

#include <cassert>
#include <span>
#include <type_traits>
#include <vector>

#include "libdyn/system/system_slope.hpp"

namespace whirl::inline dyn {

/// The derivative by a parameter of any number of a system, from neighbors of the system.
///
///   dc/dp = sum_i weight_i (c(above_i) - c(below_i))
///
/// The derivative of a number that does not depend on the parameter is zero, exactly.
class NumberSlopes {
 public:
  /// @param slope  must live as long as this
  explicit NumberSlopes(const SystemSlope& slope) { add(slope, 1.0); }
  /// A sum of slopes.
  /// @param slopes   must live as long as this
  /// @param weights  one each
  NumberSlopes(std::span<const SystemSlope> slopes, const Vec& weights) {
    assert(std::ssize(slopes) == weights.size());
    for (std::size_t i = 0; i < slopes.size(); ++i) {
      add(slopes[i], weights(static_cast<Eigen::Index>(i)));
    }
  }

  /// @param number  of a ContactSystem: a double, a vector or a matrix
  template <class NumberOf>
  auto of(const NumberOf& number) const {
    using Number = std::decay_t<std::invoke_result_t<const NumberOf&, const ContactSystem&>>;
    Number sum = pairs_[0].weight * (number(*pairs_[0].above) - number(*pairs_[0].below));
    for (std::size_t i = 1; i < pairs_.size(); ++i) {
      sum += pairs_[i].weight * (number(*pairs_[i].above) - number(*pairs_[i].below));
    }
    return sum;
  }

 private:
  struct Pair {
    const ContactSystem *above, *below;
    double weight;
  };

  /// Neighbors stand in pairs of opposite weights.
  void add(const SystemSlope& slope, double weight) {
    for (std::size_t j = 0; j + 1 < slope.neighbors.size(); j += 2) {
      pairs_.push_back({&slope.neighbors[j], &slope.neighbors[j + 1],
                        weight * neighbor_weights[j] / slope.step});
    }
  }

  std::vector<Pair> pairs_;
};

/// @throws NumericalError  where a parameter has no derivative: at a speed of zero, or where
///                         friction switches exactly in a neighbor only
void require_smooth(const ContactSystem& system, const SystemSlope& parameter);

}  // namespace whirl::inline dyn
