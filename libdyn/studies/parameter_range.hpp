#pragma once
/// A parameter that branches are followed along, and the scenes at its values.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "libdyn/branches/continuation.hpp"
#include "libdyn/system/scene.hpp"

namespace whirl::inline dyn {

class RangeSlopes;

/// The scene at a value of a parameter; may throw NumericalError where there is no scene.
using SceneAt = std::function<std::shared_ptr<const Scene>(double value)>;

/// The scenes along a parameter; states are told in the basis of the first one.
struct ParameterScenes {
  std::shared_ptr<const Scene> first;  ///< at the value where branches begin
  SceneAt at;
  std::shared_ptr<const RangeSlopes> slopes{};  ///< of scenes; null: derivatives are differences
};

/// The range of a parameter, and where in it branches begin.
struct ParameterRange {
  double low = 0.0, high = 1.0;
  double first = 0.0;         ///< where branches begin, within the range
  double largest_step = 0.0;  ///< 0: a hundredth of the range
  double direction = 1.0;     ///< of the walk, 1 or -1; of two walks, that of the second
  bool goes_both = false;     ///< branches are walked both ways from the first value
  std::string unit{};         ///< of its values

  /// Directions of the walks, in the order in which they are done.
  std::vector<double> directions() const {
    return goes_both ? std::vector{-direction, direction} : std::vector{direction};
  }
  /// Options of a walk; the period of orbits and the most points are still to be set.
  ContinuationOptions options(double towards) const {
    return {.low = low,
            .high = high,
            .first = first,
            .direction = towards,
            .largest_step = largest_step,
            .unit = unit};
  }
};

}  // namespace whirl::inline dyn
