#pragma once
/// A rotor is balanced: from runs to weights, what they leave, and how sure they are.

#include <optional>
#include <string>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libdata/balancing/convention.hpp"
#include "libdata/balancing/correction.hpp"
#include "libdata/balancing/holes.hpp"
#include "libdata/balancing/influence.hpp"
#include "libdata/balancing/model_influence.hpp"

namespace whirl::inline data {

struct BalancingPlane {
  std::string name;
  double radius = 0.0;      ///< of its weights [m]; 0: not told
  double limit = INFINITY;  ///< largest correction [kg]
  std::optional<BalancingHoles> holes{};
  std::optional<double> z{};  ///< place along the shaft [m]
};

struct BalancingProbe {
  std::string name;
  std::string unit = "um";    ///< in which people are told its readings
  std::string si_unit = "m";  ///< of its readings: m, m/s or m/s^2
  double per_unit = 1e-6;     ///< one `unit` [si_unit]
  double weight = 1.0;        ///< of its readings in the criterion, per si_unit
  double allowed = 0.0;       ///< largest reading that is allowed, peak [si_unit]; 0: not told
  double uncertainty =
      0.0;  ///< radius that holds 95 % of its readings, peak [si_unit]; 0: not told
};

/// What the permissible residual unbalance follows from.
struct RotorGrade {
  double grade = 0.0;              ///< 2.5e-3 of G2.5 [m/s]
  double mass = 0.0;               ///< [kg]
  double speed = 0.0;              ///< the highest that the rotor runs at [rad/s]
  std::optional<double> center{};  ///< of mass, along the shaft [m]
};

struct BalancingInput {
  BalancingConvention convention{};
  BalancingCriterion criterion = BalancingCriterion::least_squares;
  std::vector<BalancingPlane> planes{};
  std::vector<BalancingProbe> probes{};
  std::vector<ReadingPlace> places{};  ///< one per reading
  std::vector<BalancingRun> runs{};
  CVec kept{};                         ///< weights that stay on the rotor, per plane [kg]
  std::optional<CMat> coefficients{};  ///< of a model [reading/kg]; nothing: those of the runs
  std::optional<RotorGrade> grade{};
  bool accepts_nonlinear = false;  ///< runs whose vibration does not follow their weights
};

/// Largest share of what runs change that may not follow their weights.
constexpr double most_nonlinearity = 0.1;

/// A plane with the weight that it gets, beside those that stay.
struct PlaneBalance {
  std::string name;
  Complex weight{};  ///< that leaves least [kg]
  Complex placed{};  ///< what its holes and pieces make of it; without holes the same [kg]
  double mass = 0.0, angle = 0.0;  ///< of what is placed, as told [kg], [deg]
  double uncertainty = nan;        ///< radius about the weight that holds 95 %; NaN: not known [kg]
  double limit = INFINITY;         ///< [kg]
  double radius = nan;             ///< [m]
  double left = nan;  ///< unbalance that may be left: by the pieces, and the uncertainty [kg.m]
  double permissible = nan;  ///< [kg.m]

  static constexpr auto columns() {
    using enum Written;
    using P = PlaneBalance;
    return ColumnList{
        column("plane", &P::name, "", "plane").axis().as("name"),
        column("weight", &P::weight, "kg", "weight that leaves least, m e^(i angle)"),
        column("placed", &P::placed, "kg", "the same as its holes and pieces have it"),
        column("mass", &P::mass, "kg", "of what is placed"),
        column("angle", &P::angle, "", "of what is placed, in degrees, as `angles` says"),
        column("uncertainty", &P::uncertainty, "kg", "radius about the weight that holds 95 %"),
        column("limit", &P::limit, "kg", "largest weight that was allowed").only(in_json),
        column("radius", &P::radius, "m", "of its weights"),
        column("left", &P::left, "kg.m", "residual unbalance by pieces and uncertainty"),
        column("permissible", &P::permissible, "kg.m", "residual unbalance of the grade")};
  }
};

/// What goes into a hole.
struct HoleBalance {
  int plane = 0;       ///< from 0
  double angle = 0.0;  ///< as told [deg]
  double mass = 0.0;   ///< [kg]

  static constexpr auto columns() {
    using H = HoleBalance;
    return ColumnList{column("plane", &H::plane, "", "number of the plane, from 1")
                          .within(valid::numbers_of("planes"))
                          .from_one(),
                      column("angle", &H::angle, "", "in degrees, as `angles` says"),
                      column("mass", &H::mass, "kg", "that goes into the hole")};
  }
};

/// A reading of a probe at a speed, before and after.
struct ReadingBalance {
  std::string probe;
  double speed = 0.0;  ///< [rad/s]
  std::string unit;    ///< in which people are told it
  std::string si_unit;
  double per_unit = 1.0;                         ///< one unit [si_unit]
  CVec influence{};                              ///< per plane [si_unit/kg]
  Complex before{}, after{};                     ///< reading = Re(V e^(i theta)) [si_unit]
  double told_before = 0.0, told_after = 0.0;    ///< amplitudes as `amplitudes` says [unit]
  double phase_before = 0.0, phase_after = 0.0;  ///< as `phase` says [deg]
  double allowed = nan;                          ///< as told [unit]
  double uncertainty = nan;  ///< of `told_after`: 95 % of runs read no farther away [unit]

  bool is_too_large() const { return told_after > allowed; }

  static constexpr auto columns() {
    using R = ReadingBalance;
    return ColumnList{
        column("probe", &R::probe, "", "probe"),
        column("speed", &R::speed, "rad/s", "speed").within(valid::finite),
        column("unit", &R::unit, "", "of amplitudes"),
        column("si_unit", &R::si_unit, "", "of complex readings"),
        column("per_unit", &R::per_unit, "", "one unit in the SI unit"),
        column("influence", &R::influence, "", "reading in its SI unit per kg in a plane")
            .along("planes"),
        column("before", &R::before, "", "reading in its SI unit, Re(V e^(i theta))"),
        column("after", &R::after, "", "the same as predicted with what is placed"),
        column("amplitude_before", &R::told_before, "", "in its unit, as `amplitudes` says"),
        column("phase_before", &R::phase_before, "", "in degrees, as `phase` says"),
        column("amplitude_after", &R::told_after, "", "predicted, in its unit"),
        column("phase_after", &R::phase_after, "", "predicted, in degrees"),
        column("allowed", &R::allowed, "", "largest amplitude allowed, in its unit"),
        column("uncertainty", &R::uncertainty, "",
               "95 % of runs read no farther from what is predicted, in its unit")};
  }
};

/// A balanced rotor; group /balancing.
struct Balancing {
  BalancingConvention convention{};
  BalancingCriterion criterion = BalancingCriterion::least_squares;
  bool is_of_model = false;  ///< whether a model's coefficients were taken
  std::vector<PlaneBalance> planes{};
  std::vector<HoleBalance> holes{};
  std::vector<ReadingBalance> readings{};
  double objective = 0.0;            ///< weighted: root of the sum of squares, or the largest
  double bound = 0.0;                ///< no weights within the limits leave less
  double nonlinearity = 0.0;         ///< share of what runs change that does not follow the weights
  double permissible = nan;          ///< residual unbalance of all planes [kg.m]
  std::vector<std::string> notes{};  ///< sentences

  static constexpr std::string_view group = "/balancing";
  static constexpr auto columns() {
    using B = Balancing;
    return ColumnList{
        column(
            "phase", [](auto& b) -> auto& { return b.convention.phase; }, "",
            "whether phases lead or lag"),
        column(
            "angles", [](auto& b) -> auto& { return b.convention.angles; }, "",
            "in which direction angles on the rotor count from the mark"),
        column(
            "amplitudes", [](auto& b) -> auto& { return b.convention.amplitudes; }, "",
            "what amplitudes are"),
        column("criterion", &B::criterion, "", "what is made small"),
        column("is_of_model", &B::is_of_model, "", "whether coefficients are those of the model"),
        column("objective", &B::objective, "", "what is left of the criterion, before holes"),
        column("bound", &B::bound, "", "no weights within the limits leave less"),
        column("nonlinearity", &B::nonlinearity, "",
               "share of what runs change that does not follow their weights"),
        column("permissible", &B::permissible, "kg.m", "residual unbalance of all planes")
            .as("permissible_kg_m"),
        rows(&B::planes, "planes+"),
        rows(&B::holes, "holes").prefixed("hole_").maybe(),
        rows(&B::readings, "readings+").prefixed("reading_")};
  }
};

/// Balances a rotor.
///
/// @throws OptionError     as influence_lines and correct; for runs whose vibration does not follow
///                         their weights, as that of a rotor that rubs, unless these are accepted
/// @throws NumericalError  as correct
Balancing balance(const BalancingInput& input);

}  // namespace whirl::inline data
