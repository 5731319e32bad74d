#pragma once
/// The steady response to unbalance as a result: orbits of stations over speeds, peaks with their
/// margins, clearances.

#include <optional>
#include <string>
#include <vector>

#include "libbase/failure.hpp"
#include "libbase/structs/column.hpp"
#include "libdyn/linear/bearing_response.hpp"
#include "libdyn/system/clearance.hpp"
#include "libdyn/system/probes.hpp"
#include "libdyn/system/stations.hpp"
#include "libfe/analyses/response_curve.hpp"

namespace whirl::inline dyn {

struct UnbalanceOptions {
  std::vector<double> speeds;     ///< ascending [rad/s]
  bool has_given_speeds = false;  ///< else their range counts, and the curve's speeds are taken
  std::vector<NamedPoint> stations;
  bool tells_all = true;  ///< responses to forces of other frequencies and clearances, too
};

/// Orbits of a station: u(t) = Re(value e^(i Omega t)).
struct StationResponse {
  std::optional<int> node;  ///< from 1; nothing: a body
  std::string name, label;
  CVec x, y;         ///< complex amplitudes, per speed [m]
  Vec major, minor;  ///< semi-axes, the minor one > 0 forward, per speed [m]
  /// Amplitudes and major semi-axis over the speeds of the curve; empty if the speeds are the
  /// curve's.
  CVec curve_x, curve_y;
  Vec curve_major;

  static constexpr auto columns() {
    using enum Written;
    return ColumnList{
        column("node", &StationResponse::node, "", "number of the node").only(in_json),
        column("name", &StationResponse::name, "", "what is there").only(in_json),
        column("station", &StationResponse::label, "", "station").axis().only(in_file),
        column("major", &StationResponse::major, "m", "major semi-axis of the orbit")
            .along("speeds"),
        column("minor", &StationResponse::minor, "m", "minor semi-axis, > 0 forward")
            .along("speeds"),
        column("x", &StationResponse::x, "m", "complex amplitude of x").along("speeds"),
        column("y", &StationResponse::y, "m", "complex amplitude of y").along("speeds"),
        column("curve_x", &StationResponse::curve_x, "m", "complex amplitude of x")
            .along("curve")
            .only(in_file)
            .maybe(),
        column("curve_y", &StationResponse::curve_y, "m", "complex amplitude of y")
            .along("curve")
            .only(in_file)
            .maybe(),
        column("curve_major", &StationResponse::curve_major, "m", "major semi-axis of the orbit")
            .along("curve")
            .only(in_file)
            .maybe()};
  }
};

/// Orbits of a station under forces of another frequency than that of the speed:
/// u(t) = Re(value e^(i w t)).
struct ForcedResponse {
  std::string force;                ///< "2x", "40 Hz"
  std::optional<double> order;      ///< of the speed
  std::optional<double> frequency;  ///< of its own [rad/s]
  std::optional<int> node;          ///< from 1; nothing: a body
  std::string name, label;
  CVec x, y;             ///< complex amplitudes, per speed [m]; NaN at undamped resonances
  Vec major, minor;      ///< semi-axes, the minor one > 0 forward, per speed [m]
  std::string forces{};  ///< names of the forces of that frequency; not in result files

  static constexpr auto columns() {
    using enum Written;
    using F = ForcedResponse;
    return ColumnList{
        column("force", &F::force, "", "order or frequency of the force").axis(),
        column("forces", &F::forces, "", "their names").only(in_json),
        column("order", &F::order, "", "of the speed").only(in_json),
        column("frequency", &F::frequency, "rad/s", "of its own").only(in_json),
        column("node", &F::node, "", "number of the node").only(in_json),
        column("name", &F::name, "", "what is there").only(in_json),
        column("station", &F::label, "", "station").only(in_file),
        column("major", &F::major, "m", "major semi-axis of the orbit").along("speeds"),
        column("minor", &F::minor, "m", "minor semi-axis, > 0 forward").along("speeds"),
        column("x", &F::x, "m", "complex amplitude of x").along("speeds"),
        column("y", &F::y, "m", "complex amplitude of y").along("speeds")};
  }
};

/// Forces on bearings, seals, links and oil films under forces of another frequency.
struct ForcedBearing : BearingResponse {
  std::string force_label;          ///< "2x", "40 Hz"
  std::optional<double> order;      ///< of the speed
  std::optional<double> frequency;  ///< of its own [rad/s]

  static constexpr auto columns() {
    using enum Written;
    using F = ForcedBearing;
    return joined(
        ColumnList{column("load", &F::force_label, "", "order or frequency of the load"),
                   column("order", &F::order, "", "of the speed").only(in_json),
                   column("frequency", &F::frequency, "rad/s", "of its own").only(in_json)},
        BearingResponse::speed_columns());
  }
};

/// A peak of what a probe reads, found on the reading itself; its row is the number of the probe.
struct ProbePeak : ResponsePeak {
  double peak_to_peak() const { return 2.0 * amplitude; }
  std::vector<double> half_power() const { return {below, above}; }

  static constexpr auto columns() {
    using enum Written;
    using P = ProbePeak;
    return ColumnList{
        column("speed", &P::speed, "rad/s", "speed of a peak").axis().within(valid::finite),
        column("probe", &P::row, "", "number of the probe, from 1")
            .within(valid::numbers_of("probes"))
            .from_one()
            .only(in_file),
        column("amplitude", &P::amplitude, "m", "half of its reading, peak to peak").only(in_file),
        column("below", &P::below, "rad/s", "0.707 of the peak, below it").only(in_file),
        column("above", &P::above, "rad/s", "0.707 of the peak, above it").only(in_file),
        column("peak_to_peak", &P::peak_to_peak, "m", "of the reading there").only(in_json),
        column("amplification", &P::amplification, "", "factor").only(in_json),
        column("half_power", &P::half_power, "rad/s", "0.707 of the peak").only(in_json)};
  }
};

/// What a probe reads: Re(amplitude e^(i Omega t)).
struct ProbeResponse : ProbeLabel {
  CVec amplitude;                ///< per speed [m]
  CVec curve_amplitude;          ///< over the curve's speeds; empty if the speeds are the curve's
  std::vector<ProbePeak> peaks;  ///< ascending speeds
  ProbePeak largest;             ///< with its speed and amplitude only

  Vec peak_to_peak() const { return 2.0 * amplitude.cwiseAbs(); }
  /// Phase ahead of the rotor's angle Omega t, -180 to 180 [deg].
  Vec phase_deg() const { return amplitude.cwiseArg() / degree; }

  static constexpr auto columns() {
    using enum Written;
    using P = ProbeResponse;
    return joined(
        ProbeLabel::columns(),
        ColumnList{
            column("amplitude", &P::amplitude, "m", "complex amplitude of what a probe reads")
                .along("speeds")
                .only(in_file),
            column("curve_amplitude", &P::curve_amplitude, "m",
                   "complex amplitude of what a probe reads")
                .along("curve")
                .only(in_file)
                .maybe(),
            column("peak_to_peak", &P::peak_to_peak, "m", "of the reading").only(in_json),
            column("phase_deg", &P::phase_deg, "", "ahead of the rotor's angle").only(in_json),
            column("peaks", &P::peaks, "", "of the reading").only(in_json)});
  }
};

/// What a probe reads of forces of another frequency than that of the speed:
/// Re(amplitude e^(i w t)).
struct ForcedReading : ProbeLabel {
  std::string force;                ///< "2x", "40 Hz"
  std::optional<double> order;      ///< of the speed
  std::optional<double> frequency;  ///< of its own [rad/s]
  CVec amplitude;                   ///< per speed [m]; NaN at undamped resonances
  std::string forces{};             ///< names of the forces of that frequency; not in result files

  Vec peak_to_peak() const { return 2.0 * amplitude.cwiseAbs(); }
  /// Phase ahead of w t, -180 to 180 [deg].
  Vec phase_deg() const { return amplitude.cwiseArg() / degree; }

  static constexpr auto columns() {
    using enum Written;
    using F = ForcedReading;
    return joined(
        ProbeLabel::columns(),
        ColumnList{
            column("force", &F::force, "", "order or frequency of the force"),
            column("forces", &F::forces, "", "their names").only(in_json),
            column("order", &F::order, "", "of the speed").only(in_json),
            column("frequency", &F::frequency, "rad/s", "of its own").only(in_json),
            column("amplitude", &F::amplitude, "m", "complex amplitude of what a probe reads")
                .along("speeds")
                .only(in_file),
            column("peak_to_peak", &F::peak_to_peak, "m", "of the reading").only(in_json),
            column("phase_deg", &F::phase_deg, "", "ahead of the force's angle").only(in_json)});
  }
};

/// How far a peak is from the speeds of a machine: from the range that its model tells, else from
/// the operating speed; nothing: it tells neither.
/// @source [API617]
std::optional<SeparationMargin> machine_margin(const Model& model, const ResponsePeak& peak);

/// A peak of the largest response, and how far it is from the operating speed.
struct StationPeak : ResponsePeak {
  std::optional<int> node;  ///< of the station that moves most
  std::string name;
  std::optional<SeparationMargin> separation;  ///< see machine_margin

  std::vector<double> half_power() const { return {below, above}; }
  std::optional<double> margin() const {
    return separation ? std::optional(separation->actual) : std::nullopt;
  }
  std::optional<std::string> side() const;
  std::optional<double> required_margin() const {
    return separation ? std::optional(separation->required) : std::nullopt;
  }
  std::optional<bool> is_kept() const;

  static constexpr auto columns() {
    using enum Written;
    return ColumnList{
        column("speed", &StationPeak::speed, "rad/s", "speed of a peak")
            .axis()
            .within(valid::finite),
        column("station", &StationPeak::row, "", "number of the station, from 1")
            .within(valid::numbers_of("stations"))
            .from_one()
            .only(in_file),
        column("node", &StationPeak::node, "", "where it is largest").only(in_json),
        column("name", &StationPeak::name, "", "where it is largest").only(in_json),
        column("amplitude", &StationPeak::amplitude, "m", "major semi-axis there"),
        column("amplification", &StationPeak::amplification, "", "factor").only(in_json),
        column("half_power", &StationPeak::half_power, "rad/s", "0.707 of the peak").only(in_json),
        column("below", &StationPeak::below, "rad/s", "0.707 of the peak, below it").only(in_file),
        column("above", &StationPeak::above, "rad/s", "0.707 of the peak, above it").only(in_file),
        column("margin", &StationPeak::margin, "", "to the operating speeds").only(in_json),
        column("side", &StationPeak::side, "", "of the operating speeds").only(in_json),
        column("required_margin", &StationPeak::required_margin, "", "[API617]").only(in_json),
        column("is_kept", &StationPeak::is_kept, "", "the required margin").only(in_json)};
  }
};

/// The steady response to unbalance and forces; group /unbalance.
struct UnbalanceStudy {
  std::vector<double> speeds;  ///< those asked for, else those of the curve [rad/s]
  std::vector<StationResponse> stations;
  std::vector<double> curve_speeds;  ///< as curves need them; empty if `speeds` are those [rad/s]
  std::vector<StationPeak> peaks;
  std::vector<ClearanceUse> clearances;
  std::vector<double> unbounded;                 ///< undamped resonances [rad/s]
  std::vector<LargestResponse> largest;          ///< per station
  std::vector<ForcedResponse> forced;            ///< to forces of other frequencies, force by force
  Failure failure;                               ///< why narrow peaks may be missing
  std::vector<ProbeResponse> probes{};           ///< of the model
  std::vector<ProbePeak> probe_peaks{};          ///< of all probes
  std::vector<ForcedReading> forced_probes{};    ///< under such forces, force by force
  std::vector<BearingResponse> bearings{};       ///< forces on bearings, seals, links, oil films
  std::vector<ForcedBearing> forced_bearings{};  ///< likewise under forces of other frequencies

  static constexpr std::string_view group = "/unbalance";
  static constexpr auto columns() {
    using enum Written;
    return ColumnList{
        column("speed", &UnbalanceStudy::speeds, "rad/s", "rotor speed")
            .axis("speeds+")
            .within(valid::finite)
            .as("speeds_rpm"),
        column("curve_speed", &UnbalanceStudy::curve_speeds, "rad/s",
               "rotor speed, as many as the curves need")
            .axis("curve+")
            .within(valid::finite)
            .only(in_file)
            .maybe(),
        rows(&UnbalanceStudy::stations, "stations+"),
        rows(&UnbalanceStudy::peaks, "peaks").prefixed("peak_").maybe(),
        rows(&UnbalanceStudy::forced, "forced").prefixed("forced_").maybe(),
        rows(&UnbalanceStudy::probes, "probes").prefixed("probe_").maybe().only(in_file),
        rows(&UnbalanceStudy::probe_peaks, "probe_peaks")
            .prefixed("probe_peak_")
            .maybe()
            .only(in_file),
        rows(&UnbalanceStudy::probes, "probes").maybe().only(in_json),
        rows(&UnbalanceStudy::forced_probes, "forced_probes")
            .prefixed("forced_probe_")
            .maybe()
            .only(in_file),
        rows(&UnbalanceStudy::forced_probes, "forced_probes").maybe().only(in_json),
        rows(&UnbalanceStudy::bearings, "bearings").prefixed("bearing_").maybe(),
        rows(&UnbalanceStudy::forced_bearings, "forced_bearings")
            .prefixed("forced_bearing_")
            .maybe(),
        rows(&UnbalanceStudy::clearances, "clearances").only(in_json),
        column("unbounded", &UnbalanceStudy::unbounded, "rad/s", "undamped resonances")
            .only(in_json)};
  }
};

/// Responses of stations, and the clearances that these responses take.
/// @throws NumericalError  at a given speed where the dynamic stiffness is singular
UnbalanceStudy unbalance_study(const Model& model, const Assembler& assembler,
                               const UnbalanceOptions& options);

}  // namespace whirl::inline dyn
