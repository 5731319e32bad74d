#pragma once
/// Critical speeds over a value of the model.

#include <vector>

#include "libdyn/linear/model_at.hpp"
#include "libfe/analyses/critical.hpp"

namespace whirl::inline dyn {

/// One critical speed, followed through the values by its shape; NaN where there is none.
struct CriticalOverBranch {
  Whirl whirl = Whirl::planar;  ///< the sense it has at most values
  Vec speed, damped_speed;      ///< per value, as of Critical [rad/s]
  Vec damping_ratio;            ///< at the damped speed

  static constexpr auto columns() {
    using B = CriticalOverBranch;
    return ColumnList{
        column("whirl", &B::whirl, "", "sense of whirl"),
        column("speed", &B::speed, "rad/s", "undamped critical speed").along("values"),
        column("damped_speed", &B::damped_speed, "rad/s", "damped critical speed").along("values"),
        column("damping_ratio", &B::damping_ratio, "", "at the damped critical speed")
            .along("values")};
  }
};

/// Critical speeds of one order; group /critical_over.
struct CriticalOver : OverValues {
  std::vector<CriticalOverBranch> branches;
  std::vector<ValueGap> gaps;  ///< values at which every branch is NaN

  static constexpr std::string_view group = "/critical_over";
  static auto& parameter_of(auto& result, std::string_view) { return result.parameter; }
  static constexpr auto columns() {
    using C = CriticalOver;
    return joined(OverValues::columns(),
                  ColumnList{rows(&C::branches, "branches").numbered("branch", "branch"),
                             rows(&C::gaps, "gaps").maybe().only(Written::in_json)});
  }
};

/// Follows the lowest critical speeds over values by their shapes, see follow_shapes.
///
/// @param values   ascending, one at least [SI]
/// @param options  count: critical speeds at each value; one that is among the lowest at any value
///                 is followed through all values
/// @throws NumericalError, ModelError  if critical speeds can be computed at no value
CriticalOver critical_over(const ModelAt& model_at, ParameterName parameter,
                           const std::vector<double>& values, const CriticalOptions& options);

}  // namespace whirl::inline dyn
