#pragma once
/// Critical speeds over a value of the model.

#include <string>
#include <vector>

#include "libdyn/linear/model_at.hpp"
#include "libfe/analyses/critical.hpp"

namespace whirl::inline dyn {

/// One critical speed, followed through the values by its shape; NaN where there is none.
struct CriticalOverBranch {
  Whirl whirl = Whirl::planar;           ///< the sense it has at most values
  Vec speed, damped_speed;               ///< per value, as of Critical [rad/s]
  Vec damping_ratio;                     ///< at the damped speed
  std::string shaft = Critical().shaft;  ///< that excites, as of Critical

  static constexpr auto columns() {
    using B = CriticalOverBranch;
    return ColumnList{
        column("whirl", &B::whirl, "", "sense of whirl"),
        column("speed", &B::speed, "rad/s", "undamped critical speed").along("values"),
        column("damped_speed", &B::damped_speed, "rad/s", "damped critical speed").along("values"),
        column("damping_ratio", &B::damping_ratio, "", "at the damped critical speed")
            .along("values"),
        column("shaft", &B::shaft, "", "shaft that excites; \"shaft\": the first one").maybe()};
  }
};

/// Speeds of a further shaft at which it excites a natural frequency, followed through speeds of
/// the first one by their shape.
struct OwnSpeedBranch {
  Whirl whirl = Whirl::planar;  ///< the sense it has at most speeds
  Vec speed;                    ///< of the further shaft, undamped [rad/s]; NaN where there is none

  static constexpr auto columns() {
    return ColumnList{column("whirl", &OwnSpeedBranch::whirl, "", "sense of whirl"),
                      column("speed", &OwnSpeedBranch::speed, "rad/s",
                             "speed of the further shaft at which it excites a natural frequency")
                          .along("lead_speeds")};
  }
};

/// Critical speeds of one order of the first shaft, and by further shafts; group /critical_over.
struct CriticalOver : OverValues {
  std::vector<CriticalOverBranch> branches;
  std::vector<ValueGap> gaps;  ///< values at which every branch is NaN
  /// Where the values are the speed of a further shaft: its name, and the lines along which it
  /// excites natural frequencies, in the plane of both speeds. Else all three are empty.
  std::string shaft{};
  std::vector<double> lead_speeds{};  ///< of the first shaft [rad/s], ascending
  std::vector<OwnSpeedBranch> own_branches{};

  static constexpr std::string_view group = "/critical_over";
  static auto& parameter_of(auto& result, std::string_view) { return result.parameter; }
  static constexpr auto columns() {
    using C = CriticalOver;
    return joined(
        OverValues::columns(),
        ColumnList{
            rows(&C::branches, "branches").numbered("branch", "branch"),
            rows(&C::gaps, "gaps").maybe().only(Written::in_json),
            column("shaft", &C::shaft, "", "further shaft whose speed the values are")
                .maybe()
                .only(Written::in_file),
            column("shaft", &C::shaft, "", "further shaft whose speed the values are")
                .maybe()
                .only(Written::in_json),
            column("lead_speed", &C::lead_speeds, "rad/s", "speed of the first shaft")
                .axis("lead_speeds+")
                .within(valid::nonnegative)
                .maybe()
                .only(Written::in_file),
            column("lead_speed", &C::lead_speeds, "rad/s", "speed of the first shaft")
                .maybe()
                .only(Written::in_json),
            rows(&C::own_branches, "own_branches").prefixed("own_").maybe().only(Written::in_file),
            rows(&C::own_branches, "own_branches").maybe().only(Written::in_json)});
  }
};

/// Follows the lowest critical speeds over values by their shapes, see follow_shapes: those by the
/// first shaft, then those by each further one whose speed changes with that of the first.
///
/// Where the values are the constant speed of a further shaft, rotor.NAME.speed, what that shaft
/// excites hardly depends on the speed of the first one: it is told the other way round, as speeds
/// of the further shaft over those of the first one from rest to the highest critical speed of the
/// branches.
///
/// @param values   ascending, one at least [SI]
/// @param options  count: critical speeds at each value; one that is among the lowest at any value
///                 is followed through all values
/// @throws NumericalError, ModelError  if critical speeds can be computed at no value
CriticalOver critical_over(const ModelAt& model_at, ParameterName parameter,
                           const std::vector<double>& values, const CriticalOptions& options);

}  // namespace whirl::inline dyn
