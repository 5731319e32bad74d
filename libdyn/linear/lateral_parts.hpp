#pragma once
/// Parts of the report of a lateral analysis that go beside its table of checks: forces on
/// supports, stability state by state and seal by seal, and the shafts of a machine that has
/// several.

#include <string>
#include <vector>

#include "libbase/numerics/constants.hpp"
#include "libbase/structs/column.hpp"
#include "libfe/lateral/coupling_stability.hpp"

namespace whirl::inline dyn {

/// Column of the shaft that a row is about.
template <class Row>
constexpr auto column_of_shaft() {
  return column("shaft", &Row::shaft, "",
                "shaft of a machine that has several, \"shaft\" the first")
      .maybe();
}

/// A shaft of a machine that has several, by its own speeds.
struct LateralShaft {
  std::string name;                   ///< "shaft": the first one
  double ratio = 1.0;                 ///< of its speed to that of the first one
  double minimum_speed = 0.0;         ///< least continuous one of its own [rad/s]
  double maximum_speed = 0.0;         ///< likewise [rad/s]
  double trip_speed = 0.0;            ///< likewise [rad/s]
  double vibration_limit = 0.0;       ///< at its probes, peak to peak [m]
  double rigid_critical_speed = nan;  ///< its own first one on rigid supports [rad/s]; NaN: none
  std::string coupled_station;        ///< where cross-coupled stiffness acts

  static constexpr auto columns() {
    using S = LateralShaft;
    return ColumnList{
        column("name", &S::name, "", "shaft, \"shaft\" the first"),
        column("ratio", &S::ratio, "", "of its speed to that of the first shaft"),
        column("minimum_speed", &S::minimum_speed, "rad/s", "its own least continuous speed"),
        column("maximum_speed", &S::maximum_speed, "rad/s", "its own largest continuous speed"),
        column("trip_speed", &S::trip_speed, "rad/s", "its own speed at which it is stopped"),
        column("vibration_limit", &S::vibration_limit, "m", "at its probes, peak to peak"),
        column("rigid_critical_speed", &S::rigid_critical_speed, "rad/s",
               "its own first critical speed on rigid supports"),
        column("coupled_station", &S::coupled_station, "", "where cross-coupled stiffness acts")};
  }
};

/// Largest force of a case on what carries the rotor, up to the trip speed.
struct LateralForce {
  int of_case = 0;   ///< from 0
  std::string kind;  ///< "bearing", "seal", "link", "oil film"
  std::string name;
  double force = 0.0;   ///< largest in a period, without the weight [N]
  double speed = 0.0;   ///< where it is that large [rad/s]
  std::string shaft{};  ///< with the unbalance; empty: the machine has one

  static constexpr auto columns() {
    using F = LateralForce;
    return ColumnList{
        column("case", &F::of_case, "", "case of unbalance")
            .within(valid::numbers_of("cases"))
            .from_one(),
        column("kind", &F::kind, "", "bearing, seal, link, oil film or rolling bearing"),
        column("name", &F::name, "", "its name"),
        column("force", &F::force, "N", "largest in a period, without the weight"),
        column("speed", &F::speed, "rad/s", "where it is that large"),
        column_of_shaft<F>()};
  }
};

/// The logarithmic decrement with the parts that may drive a whirl put in one by one.
struct LevelTwoStep {
  std::string variant{};       ///< of the model; empty: the model itself
  std::string parts;           ///< "without seals", "with seal eye", ..., each with those before it
  double log_decrement = nan;  ///< of the least damped mode
  double frequency = nan;      ///< of that mode [rad/s]
  std::string shaft{};         ///< which the mode moves most; empty: the machine has one

  static constexpr auto columns() {
    using S = LevelTwoStep;
    return ColumnList{
        column("parts", &S::parts, "", "what is in the model, beside what was before"),
        column("log_decrement", &S::log_decrement, "", "of the least damped mode"),
        column("frequency", &S::frequency, "rad/s", "of that mode"),
        column("variant", &S::variant, "", "variant of the model; empty: the model itself").maybe(),
        column_of_shaft<S>()};
  }
};

/// Level I of the model or of a variant.
struct LevelOneState {
  std::string variant{};       ///< of the model; empty: the model itself
  double log_decrement = nan;  ///< with Q_A, or without any cross-coupling
  double limit = nan;          ///< Q_0 [N/m]; 0: bears no Q; NaN: stable with any Q
  std::string shaft{};         ///< on which Q acts; empty: the machine has one

  static constexpr auto columns() {
    using S = LevelOneState;
    return ColumnList{
        column("log_decrement", &S::log_decrement, "", "with the cross-coupled stiffness expected"),
        column("limit", &S::limit, "N/m", "cross-coupled stiffness that the rotor bears"),
        column("variant", &S::variant, "", "variant of the model; empty: the model itself").maybe(),
        column_of_shaft<S>()};
  }
};

/// The least damped mode of the model or of a variant under a cross-coupled stiffness.
struct CoupledState : CoupledMode {
  std::string variant{};  ///< of the model; empty: the model itself
  std::string shaft{};    ///< on which Q acts; empty: the machine has one

  static constexpr auto columns() {
    using S = CoupledState;
    return joined(CoupledMode::columns(),
                  ColumnList{column("variant", &S::variant, "",
                                    "variant of the model; empty: the model itself")
                                 .maybe(),
                             column_of_shaft<S>()});
  }
};

/// Forces on supports, stability state by state and seal by seal, shafts; in group /lateral.
struct LateralParts {
  std::vector<LateralForce> forces;
  std::vector<LevelTwoStep> level_two;
  /// The model first, of each shaft; empty: there are neither variants nor further shafts.
  std::vector<LevelOneState> level_one{};
  std::vector<CoupledState> coupled{};  ///< of all states; empty likewise
  std::vector<LateralShaft> shafts{};   ///< empty: the machine has one

  static constexpr std::string_view group = "/lateral";
  static constexpr auto columns() {
    using P = LateralParts;
    return ColumnList{rows(&P::forces, "forces").prefixed("force_").maybe(),
                      rows(&P::level_two, "level_two").prefixed("level_two_").maybe(),
                      rows(&P::level_one, "level_one").prefixed("level_one_").maybe(),
                      rows(&P::coupled, "coupled_states").prefixed("state_").maybe(),
                      rows(&P::shafts, "shafts").prefixed("shaft_").maybe()};
  }
};

}  // namespace whirl::inline dyn
