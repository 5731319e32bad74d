#pragma once
/// Invariant circles as a result (libbase/structs/column.hpp); group /torus.

#include <optional>
#include <string>
#include <vector>

#include "libbase/failure.hpp"
#include "libbase/structs/parameter_name.hpp"
#include "libdyn/studies/end_texts.hpp"
#include "libdyn/studies/torus_branch.hpp"
#include "libdyn/system/scene.hpp"

namespace whirl::inline dyn {

/// A circle along a parameter.
struct CircleRow : CirclePoint {
  static constexpr auto columns() {
    using C = CircleRow;
    return ColumnList{column("value", &C::value, unit_of_parameter, "the parameter's")
                          .axis()
                          .within(valid::finite),
                      column("rotation", &C::rotation, "", "turns of the circle per revolution")
                          .within(valid::finite)
                          .as("rotation_per_rev"),
                      column("largest_exponent", &C::growth, "",
                             "largest exponent across the circle, per revolution")
                          .as("largest_exponent_per_rev"),
                      column("tail", &C::tail, "", "highest harmonics by the largest")};
  }
};

/// One way along the parameter.
struct CircleWalkRow : EndTexts {
  static constexpr auto columns() { return EndTexts::columns(); }
};

/// A circle, and the circles along a parameter.
struct TorusResult {
  Vec angles{};            ///< around the circle [rad]
  Mat displacement{};      ///< of all points at phase 0, a row per angle [m, rad]
  double rotation = 0.0;   ///< turns of the circle per revolution
  double frequency = 0.0;  ///< of the lines beside those of the speed [rad/s]
  int period = 1;          ///< of the map [revolutions]
  bool is_good = true;     ///< a circle was found
  int stability = 0;       ///< 1 stable, 0 unstable
  int is_complete = 0;     ///< 1: nothing is left to be walked
  Vec exponents{};         ///< across the circle, descending [1/revolution]
  double along = 0.0;      ///< exponent along the circle [1/revolution]
  int harmonics = 0;
  double residual = 0.0;  ///< [scales]
  double tail = 0.0;      ///< size of the highest harmonics over the largest
  Failure failure{};

  ParameterName parameter{};
  std::vector<CircleRow> circles{};
  std::vector<CircleWalkRow> walks{};
  std::vector<std::string> ends{};  ///< of the walks, with what the circle locks to
  std::vector<double> walk{};       ///< what the study goes on from, packed

  std::optional<bool> is_stable() const;  ///< nothing: there is no circle
  std::optional<std::string> path() const;
  std::optional<std::string> unit() const;

  static constexpr std::string_view group = "/torus";
  static auto& parameter_of(auto& result, std::string_view) { return result.parameter; }
  static constexpr auto columns() {
    using T = TorusResult;
    using enum Written;
    constexpr double most_revolutions = 1e9;
    return ColumnList{
        column("angle", &T::angles, "rad", "angle around the circle").axis("angles").only(in_file),
        column("displacement", &T::displacement, "m, rad", "displacement of all points at phase 0")
            .along("angles full")
            .only(in_file),
        column("period_revolutions", &T::period, "", "revolutions of the map")
            .within(valid::from_to(1.0, most_revolutions))
            .as("period_revs")
            .maybe(),
        column("rotation", &T::rotation, "", "turns of the circle per revolution")
            .as("rotation_per_rev")
            .maybe(),
        column("frequency", &T::frequency, "rad/s", "of the lines beside those of the speed")
            .only(in_json),
        column("exponents_per_rev", &T::exponents, "", "across it").only(in_json),
        column("along_per_rev", &T::along, "", "exponent along it").only(in_json),
        column("stable", &T::stability, "", "1 stable, 0 unstable").only(in_file).maybe(),
        column("stable", &T::is_stable, "", "null: there is no circle").only(in_json),
        column("harmonics", &T::harmonics, "", "of the circle").only(in_json),
        column("residual", &T::residual, "", "[length scales]").only(in_json),
        column("tail", &T::tail, "", "highest harmonics by the largest").only(in_json),
        column("failure", &T::failure, "", "why there is none").only(in_json).maybe(),
        column("parameter", &T::path, "", "its path").only(in_json).maybe(),
        column("unit", &T::unit, "", "its SI unit").only(in_json).maybe(),
        rows(&T::circles, "points+").only(in_file).maybe(),
        rows(&T::circles, "points").only(in_json).maybe(),
        rows(&T::walks, "walks").only(in_file).maybe(),
        column("ends", &T::ends, "", "why each way ends").only(in_json).maybe(),
        column("walk", &T::walk, "", "what the walk goes on from")
            .along("packed_torus")
            .only(in_file)
            .maybe(),
        column("complete", &T::is_complete, "", "0: the study was stopped")
            .within(valid::from_to(0.0, 1.0))
            .only(in_file)
            .maybe()};
  }
};

/// @param parameter  of the walks; does not count without walks
TorusResult torus_result(const Scene& scene, const TorusBranch& torus,
                         const ParameterName& parameter);

}  // namespace whirl::inline dyn
