#pragma once
/// Modes over a value of the model: the locus of their eigenvalues.

#include <optional>
#include <vector>

#include "libdyn/linear/model_at.hpp"
#include "libfe/analyses/modes.hpp"

namespace whirl::inline dyn {

/// One mode, followed through the values by its shape; NaN where it does not oscillate.
struct ModesOverBranch {
  Whirl whirl = Whirl::planar;  ///< the sense it has at most values
  Vec frequency;                ///< damped, per value [rad/s]
  Vec log_decrement;            ///< per value
  CVec eigenvalue;              ///< per value [rad/s]

  static constexpr auto columns() {
    using B = ModesOverBranch;
    return ColumnList{
        column("whirl", &B::whirl, "", "sense of whirl"),
        column("frequency", &B::frequency, "rad/s", "damped natural frequency").along("values"),
        column("log_decrement", &B::log_decrement, "", "logarithmic decrement").along("values"),
        column("eigenvalue", &B::eigenvalue, "rad/s", "eigenvalue")
            .along("values")
            .as("eigenvalue")};
  }
};

/// A value at which a mode begins to grow by itself, or ceases to.
struct ModesOverThreshold {
  double value = 0.0;      ///< of the parameter [SI]
  double frequency = 0.0;  ///< at which it whirls there [rad/s]
  int branch = 0;          ///< from 0

  static constexpr auto columns() {
    using T = ModesOverThreshold;
    return ColumnList{column("value", &T::value, unit_of_parameter, "threshold of instability"),
                      column("frequency", &T::frequency, "rad/s", "of the whirl at the threshold"),
                      column("branch", &T::branch, "", "branch that loses its damping")
                          .from_one()
                          .within(valid::numbers_of("branches"))
                          .as("mode")};
  }
};

/// Modes at the operating speed of each model; group /modes_over.
struct ModesOver : OverValues {
  std::vector<ModesOverBranch> branches;
  std::vector<ModesOverThreshold> thresholds;  ///< of the branches, ascending values
  std::vector<ValueGap> gaps;                  ///< values at which every branch is NaN

  static constexpr std::string_view group = "/modes_over";
  static auto& parameter_of(auto& result, std::string_view) { return result.parameter; }
  static constexpr auto columns() {
    using M = ModesOver;
    return joined(OverValues::columns(),
                  ColumnList{rows(&M::branches, "branches").numbered("branch", "branch"),
                             rows(&M::thresholds, "thresholds").prefixed("threshold_").maybe(),
                             rows(&M::gaps, "gaps").maybe().only(Written::in_json)});
  }
};

/// Follows the lowest modes over values by their shapes, see follow_shapes.
///
/// A threshold is the root over the value of the real part of a branch's eigenvalue, between two
/// neighboring values at which it has different signs.
///
/// @param values  ascending, one at least [SI]
/// @param count   modes at each value; a mode that is among these at any value is followed through
///                all values
/// @throws NumericalError, ModelError  if modes can be computed at no value
ModesOver modes_over(const ModelAt& model_at, ParameterName parameter,
                     const std::vector<double>& values, int count);

}  // namespace whirl::inline dyn
