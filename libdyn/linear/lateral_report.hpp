#pragma once
/// The lateral analysis of a machine after [API617]: its response to unbalance, the margins of its
/// critical speeds, its stability, and whether these are enough.

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "libbase/numerics/constants.hpp"
#include "libbase/structs/column.hpp"
#include "libbase/structs/field.hpp"
#include "libdyn/linear/lateral_parts.hpp"
#include "libdyn/linear/lateral_unbalance.hpp"
#include "libdyn/system/model.hpp"
#include "libdyn/system/stations.hpp"
#include "libfe/analyses/campbell.hpp"
#include "libfe/analyses/response_curve.hpp"

namespace whirl::inline dyn {

/// Speeds of the machine as a model tells them; where the model does not, the operating speed, and
/// a trip speed of 1.05 times the maximum.
///
/// @param maximum  taken instead of the model's maximum [rad/s]; a minimum above becomes equal to
///                 this maximum, and a trip speed below does not count; 0: that of the model
/// @return         maximum 0 if the model has no speed
OperatingRange operating_range(const Model& model, double maximum = 0.0);

struct LateralOptions {
  OperatingRange range;
  double anticipated = 0.0;      ///< Q_A, cross-coupled stiffness to be expected [N/m]; 0: none
  bool has_anticipated = false;  ///< whether Q_A is told
  std::optional<double> gas_density = {};  ///< average of the gas [kg/m^3]; nothing: not told
  int coupled_shaft = 0;                   ///< number of the shaft on which Q_A acts, from 0
  int modes = 8;                           ///< of the Campbell diagram
  int criticals = 6;                       ///< critical speeds that are looked for
};

/// What a bearing or film carries.
struct LateralJournal {
  std::string name;
  double mass = 0.0;    ///< [kg]
  std::string shaft{};  ///< that it carries; empty: the machine has one

  static constexpr auto columns() {
    return ColumnList{
        column("name", &LateralJournal::name, "", "bearing or oil film"),
        column("mass", &LateralJournal::mass, "kg", "that it carries at rest at full speed"),
        column_of_shaft<LateralJournal>()};
  }
};

/// One place of the unbalance of a case.
struct LateralPlane {
  int of_case = 0;  ///< from 0
  std::string station;
  double moment = 0.0;  ///< [kg.m]
  double phase = 0.0;   ///< [rad]
  std::string shaft{};  ///< on which it is; empty: the machine has one

  static constexpr auto columns() {
    using P = LateralPlane;
    return ColumnList{column("case", &P::of_case, "", "case of unbalance")
                          .within(valid::numbers_of("cases"))
                          .from_one(),
                      column("station", &P::station, "", "where it is"),
                      column("moment", &P::moment, "kg.m", "unbalance"),
                      column("phase", &P::phase, "rad", "angle to the first one, 0 or pi"),
                      column_of_shaft<P>()};
  }
};

/// A case of unbalance, and the largest vibration that this unbalance makes.
struct LateralCase {
  std::string variant{};        ///< of the model; empty: the model itself
  double mode_speed = 0.0;      ///< undamped critical speed of the mode that it excites [rad/s]
  Whirl whirl = Whirl::planar;  ///< of that mode
  UnbalancePlaces places = UnbalancePlaces::antinodes;
  double vibration = 0.0;        ///< largest at probes at operating speeds, peak to peak [m]
  int probe = 0;                 ///< number of that probe, from 0
  double vibration_speed = 0.0;  ///< speed of that vibration [rad/s]
  double scaling = 0.0;          ///< that brings the vibration to the limit, 6 at most
  std::string shaft{};           ///< with the unbalance; empty: the machine has one
  double order = 1.0;            ///< frequency of the unbalance over the speed of the first shaft

  static constexpr auto columns() {
    using C = LateralCase;
    return ColumnList{
        column("variant", &C::variant, "", "variant of the model; empty: the model itself").maybe(),
        column("mode_speed", &C::mode_speed, "rad/s", "undamped critical speed of its mode"),
        column("whirl", &C::whirl, "", "sense of whirl of that mode"),
        column("places", &C::places, "", "of its unbalance: antinodes of the mode, or an end")
            .maybe(),
        column("vibration", &C::vibration, "m", "largest at operating speeds, peak to peak"),
        column("vibration_probe", &C::probe, "", "where it is largest")
            .within(valid::numbers_of("probes"))
            .from_one(),
        column("vibration_speed", &C::vibration_speed, "rad/s", "where it is largest"),
        column("scaling", &C::scaling, "", "that brings it to the limit, 6 at most"),
        column_of_shaft<C>(),
        column("order", &C::order, "", "of its unbalance, over the speed of the first shaft")
            .within(valid::positive)
            .maybe()};
  }
};

/// Vibration of a probe over speed.
struct LateralResponse {
  int of_case = 0;   ///< from 0
  int probe = 0;     ///< from 0
  Vec peak_to_peak;  ///< along the major axis, per speed [m]

  static constexpr auto columns() {
    using R = LateralResponse;
    return ColumnList{
        column("case", &R::of_case, "", "case of unbalance")
            .within(valid::numbers_of("cases"))
            .from_one(),
        column("probe", &R::probe, "", "probe").within(valid::numbers_of("probes")).from_one(),
        column("peak_to_peak", &R::peak_to_peak, "m", "along the major axis")
            .along("lateral_speeds")};
  }
};

/// A place where vibration is measured.
struct LateralProbe {
  std::string station;
  std::string shaft{};  ///< on which it is; empty: the machine has one, or it is on none

  static constexpr auto columns() {
    return ColumnList{column("probe", &LateralProbe::station, "", "station").axis(),
                      column_of_shaft<LateralProbe>()};
  }
};

/// On which sides of a peak 0.707 of it is reached.
enum class PeakSides { both, below, above, none };
constexpr auto choices(PeakSides) {
  using enum PeakSides;
  return std::array{Choice<PeakSides>{"both", both}, Choice<PeakSides>{"below", below},
                    Choice<PeakSides>{"above", above}, Choice<PeakSides>{"none", none}};
}

/// What a peak is by its amplification factor.
enum class PeakKind { critical_speed, critically_damped, unknown };
constexpr auto choices(PeakKind) {
  using enum PeakKind;
  return std::array{Choice<PeakKind>{"critical speed", critical_speed},
                    Choice<PeakKind>{"critically damped", critically_damped},
                    Choice<PeakKind>{"unknown", unknown}};
}

/// A peak of the response to one case.
struct LateralPeak : ResponsePeak {
  int of_case = 0;  ///< from 0
  SeparationMargin margin;
  PeakSides sides = PeakSides::both;  ///< of a single side, the other one is taken to be as far
  std::string shaft{};                ///< with the unbalance; empty: the machine has one

  double found() const { return margin.actual; }
  double required() const { return margin.required; }
  PeakKind kind() const;
  /// Whether the amplification factor of the peak follows from one side.
  bool is_one_sided() const { return sides == PeakSides::below || sides == PeakSides::above; }

  static constexpr auto columns() {
    using enum Written;
    using P = LateralPeak;
    return ColumnList{
        column("case", &P::of_case, "", "case of unbalance")
            .within(valid::numbers_of("cases"))
            .from_one(),
        column("probe", &P::row, "", "where it is largest")
            .within(valid::numbers_of("probes"))
            .from_one(),
        column("speed", &P::speed, "rad/s", "speed of the peak"),
        column("amplitude", &P::amplitude, "m", "major semi-axis there"),
        column("below", &P::below, "rad/s", "0.707 of the peak, below it"),
        column("above", &P::above, "rad/s", "0.707 of the peak, above it"),
        column("sides", &P::sides, "", "on which 0.707 of the peak is reached").maybe(),
        column_of_shaft<P>(),
        column("amplification", &P::amplification, "", "factor").only(in_json),
        column("kind", &P::kind, "", "what that makes of it").only(in_json),
        column("margin", &P::found, "", "to the operating speeds").only(in_json),
        column("required_margin", &P::required, "", "[API617]").only(in_json)};
  }
};

/// What a case takes of a running clearance, scaled to the vibration limit.
struct LateralClearance {
  int of_case = 0;  ///< from 0
  std::string name;
  double left = 0.0;     ///< what is left of the clearance with the rotor at rest [m]
  double largest = 0.0;  ///< major semi-axis there up to the trip speed, scaled [m]
  double speed = 0.0;    ///< speed of the largest one [rad/s]
  std::string shaft{};   ///< with the unbalance; empty: the machine has one

  /// Largest over left; infinite where the rotor at rest touches already.
  double share() const { return left > 0.0 ? largest / left : INFINITY; }

  static constexpr auto columns() {
    using enum Written;
    using C = LateralClearance;
    return ColumnList{column("case", &C::of_case, "", "case of unbalance")
                          .within(valid::numbers_of("cases"))
                          .from_one(),
                      column("name", &C::name, "", "whose clearance it is"),
                      column("left", &C::left, "m", "running clearance, beside the rotor at rest"),
                      column("largest", &C::largest, "m", "scaled response, from the middle"),
                      column("speed", &C::speed, "rad/s", "where it is that large"),
                      column("share", &C::share, "", "of the running clearance").only(in_json),
                      column_of_shaft<C>()};
  }
};

enum class LateralRule {
  separation_margin,  ///< of a peak, over the nearest operating speed
  vibration,          ///< at a probe, peak to peak [m]
  running_clearance,  ///< share of the clearance that the scaled response takes
  log_decrement,      ///< with the anticipated cross-coupling
  coupling_ratio,     ///< cross-coupling that the rotor bears over the anticipated one
  stability_region,   ///< the same ratio, for the region that speed and gas density are in
  level_two           ///< log decrement with all seals of the model
};
constexpr auto choices(LateralRule) {
  using enum LateralRule;
  return std::array{Choice<LateralRule>{"separation margin", separation_margin},
                    Choice<LateralRule>{"vibration", vibration},
                    Choice<LateralRule>{"running clearance", running_clearance},
                    Choice<LateralRule>{"log decrement", log_decrement},
                    Choice<LateralRule>{"cross-coupling", coupling_ratio},
                    Choice<LateralRule>{"stability region", stability_region},
                    Choice<LateralRule>{"level II", level_two}};
}

enum class Verdict { passed, failed, unknown };
constexpr auto choices(Verdict) {
  return std::array{Choice<Verdict>{"passed", Verdict::passed},
                    Choice<Verdict>{"failed", Verdict::failed},
                    Choice<Verdict>{"unknown", Verdict::unknown}};
}

/// A rule, and what was found for it.
struct LateralCheck {
  LateralRule rule = LateralRule::separation_margin;
  int of_case = -1;  ///< from 0; -1: of none
  /// Station or clearance; of stability the station of the cross-coupling, or "threshold of
  /// instability"; of a resonance without damping "undamped resonance".
  std::string place;
  double speed = nan;  ///< at which it was found [rad/s]
  double found = nan;  ///< in SI, as the rule says
  double limit = nan;  ///< in SI, as the rule says
  Verdict verdict = Verdict::unknown;
  std::string missing{};  ///< what was not given for the check; empty: nothing
  std::string variant{};  ///< of the model; empty: the model itself
  std::string shaft{};    ///< that it is about; empty: the machine has one, or it is about all

  static constexpr auto columns() {
    using C = LateralCheck;
    return ColumnList{
        column("rule", &C::rule, "", "what is asked for"),
        column("case", &C::of_case, "", "case of unbalance; 0: of none").from_one(),
        column("place", &C::place, "", "where"),
        column("speed", &C::speed, "rad/s", "at which it was found"),
        column("found", &C::found, "", "what was found, in SI"),
        column("limit", &C::limit, "", "what is asked for, in SI"),
        column("verdict", &C::verdict, "", "passed, failed or unknown"),
        column("missing", &C::missing, "", "what was not given for it").maybe(),
        column("variant", &C::variant, "", "variant of the model; empty: the model itself").maybe(),
        column_of_shaft<C>()};
  }
};

/// The report; group /lateral.
struct LateralReport {
  double minimum_speed = 0.0, maximum_speed = 0.0, trip_speed = 0.0;  ///< [rad/s]
  double vibration_limit = 0.0;                                       ///< peak to peak [m]
  std::string vibration_unit{};       ///< in which people are told vibration; empty: um
  std::string coupled_station;        ///< where the cross-coupled stiffness acts
  double anticipated = nan;           ///< Q_A [N/m]; NaN: not told
  double limit = nan;                 ///< Q_0 [N/m]; 0: bears no Q; NaN: stable with any Q
  double log_decrement = nan;         ///< the least with Q_A, or without any cross-coupling
  double rigid_critical_speed = nan;  ///< the first one on rigid supports [rad/s]; NaN: none
  double gas_density = nan;           ///< average [kg/m^3]; NaN: not told
  std::vector<double> speeds;         ///< of the responses [rad/s]
  std::vector<LateralProbe> probes;
  std::vector<LateralJournal> journals;
  std::vector<LateralCase> cases;
  std::vector<LateralPlane> planes;
  std::vector<LateralResponse> responses;
  std::vector<LateralPeak> peaks;
  std::vector<LateralClearance> clearances;
  std::vector<CoupledMode> coupled_modes;
  std::vector<LateralCheck> checks;
  std::vector<double> unbounded;  ///< undamped resonances [rad/s]

  bool is_passed() const;
  /// Maximum speed over the first critical speed on rigid supports.
  double critical_speed_ratio() const { return maximum_speed / rigid_critical_speed; }
  /// Region of the screening; nothing: too little is told.
  std::optional<StabilityRegion> region() const;

  static constexpr std::string_view group = "/lateral";
  static constexpr auto columns() {
    using enum Written;
    using R = LateralReport;
    return ColumnList{
        column("minimum_speed", &R::minimum_speed, "rad/s", "least continuous speed"),
        column("maximum_speed", &R::maximum_speed, "rad/s", "largest continuous speed"),
        column("trip_speed", &R::trip_speed, "rad/s", "at which it is stopped"),
        column("vibration_limit", &R::vibration_limit, "m", "at probes, peak to peak"),
        column("vibration_unit", &R::vibration_unit, "", "in which people are told vibration")
            .only(in_file)
            .maybe(),
        column("coupled_station", &R::coupled_station, "", "where cross-coupled stiffness acts"),
        column("anticipated", &R::anticipated, "N/m", "cross-coupled stiffness to be expected"),
        column("limit", &R::limit, "N/m", "cross-coupled stiffness that the rotor bears"),
        column("log_decrement", &R::log_decrement, "", "with that to be expected"),
        column("rigid_critical_speed", &R::rigid_critical_speed, "rad/s",
               "first critical speed on rigid supports")
            .maybe(),
        column("gas_density", &R::gas_density, "kg/m^3", "average of the gas")
            .as("gas_density_kg_m3")
            .maybe(),
        column("critical_speed_ratio", &R::critical_speed_ratio, "",
               "maximum speed over the first critical speed on rigid supports")
            .only(in_json),
        column("region", &R::region, "", "A or B, of the screening").only(in_json),
        column("passed", &R::is_passed, "", "every check but those that are unknown").only(in_json),
        column("speed", &R::speeds, "rad/s", "rotor speed")
            .axis("lateral_speeds+")
            .within(valid::finite)
            .as("speeds_rpm"),
        rows(&R::probes, "probes+"),
        rows(&R::cases, "cases+").prefixed("case_").numbered("number", "case of unbalance"),
        rows(&R::responses, "responses+").prefixed("response_"),
        rows(&R::journals, "journals").prefixed("journal_").maybe(),
        rows(&R::planes, "planes").prefixed("plane_").maybe(),
        rows(&R::peaks, "peaks").prefixed("peak_").maybe(),
        rows(&R::clearances, "clearances").prefixed("clearance_").maybe(),
        rows(&R::coupled_modes, "coupled_modes").prefixed("coupled_").maybe(),
        rows(&R::checks, "checks").prefixed("check_").maybe(),
        column("unbounded", &R::unbounded, "rad/s", "undamped resonances").only(in_json)};
  }
};

/// The report with the analyses that it rests on.
struct LateralStudy {
  LateralReport report;
  LateralParts parts;
  CriticalSpeeds criticals;
  Campbell campbell;
};

/// A model in another state of the machine, such as with bearings of the least clearance.
struct LateralVariant {
  std::string name;
  Model model;
};

/// Analyses a model with its oil films linearized; its own unbalance and bow are left out.
///
/// Variants are analyzed as the model is: their cases of unbalance, peaks, responses and checks
/// follow those of the model. Decrement and limit of the report are those of the worst of all,
/// critical speeds and the Campbell diagram those of the model.
///
/// Unbalance excites the modes of critical speeds up to 1.5 times the maximum continuous speed.
/// Responses go from a tenth of that maximum to 1.5 times it, or to the trip speed if that is
/// higher: at the stations of the model's probes across the shaft, or at bearings and oil films if
/// there are no such probes. Vibration is told along the major axis. For running clearances the
/// unbalance is scaled so that the probes are at the vibration limit. Cross-coupled stiffness acts
/// at the node that is nearest to the middle between the outermost journals, at the maximum
/// continuous speed. A check that asks for what was not given is unknown, and says what is missing.
///
/// @throws ModelError      if nothing carries the shaft, or there is no shaft
/// @throws NumericalError  as the analyses
/// @source [API617], [API684]
LateralStudy lateral_report(const Model& model, const LateralOptions& options,
                            const std::vector<LateralVariant>& variants = {});

}  // namespace whirl::inline dyn
