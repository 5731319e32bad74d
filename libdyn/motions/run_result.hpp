#pragma once
/// A run and its parts as results (libbase/structs/column.hpp): where it ended, how it moved, what
/// its contacts did, its spectra.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "libbase/failure.hpp"
#include "libbase/structs/column.hpp"
#include "libdyn/motions/response.hpp"
#include "libdyn/motions/simulate.hpp"
#include "libdyn/motions/touches.hpp"
#include "libdyn/system/clearance.hpp"
#include "libdyn/system/contact_measures.hpp"
#include "libdyn/system/probes.hpp"
#include "libdyn/system/stations.hpp"

namespace whirl::inline dyn {

/// A finished (or failed, or stopped) run.
struct Run {
  Scene scene;
  Simulation simulation;
  std::vector<NamedPoint> stations;
  std::string method;
  std::shared_ptr<const ResponseSpectra> spectra;  ///< null without a motion
  std::vector<SupportLoads::Part> supports{};      ///< of the forces in the recording
  bool has_motion() const { return simulation.recording.revolutions > 0; }
};

/// Motion of a point in a recording, samples x (x, y) [m].
Mat motion_of(const Run& run, const Point& point);

/// What a probe reads at the samples of a recording [m].
/// @throws ModelError  for a station that does not exist
Vec reading_of(const Run& run, const Probe& probe);

/// What a contact did, and its name.
struct ContactShare : ContactDoing {
  std::string name;
  double mean_slip = 0.0;  ///< [m/s]
  FrictionLoad rubbing{};

  static constexpr auto columns() {
    return ColumnList{
        column("name", &ContactShare::name, "", "contact").axis(),
        column("regime", &ContactShare::regime, "", "regime"),
        column("duty", &ContactShare::duty, "", "share of time in touch"),
        column("impacts_per_rev", &ContactShare::impacts_per_rev, "", "impacts per revolution"),
        column("max_normal", &ContactShare::max_normal, "N", "largest normal force"),
        column("max_tangential", &ContactShare::max_tangential, "N", "largest friction force"),
        column("sticking", &ContactShare::sticking, "", "share of time sticking"),
        column("mean_slip", &ContactShare::mean_slip, "m/s", "mean slip velocity in touch"),
        column(
            "friction_energy", [](auto& c) -> auto& { return c.rubbing.energy; }, "J",
            "heat of friction")
            .maybe(),
        column(
            "mean_power", [](auto& c) -> auto& { return c.rubbing.mean_power; }, "W",
            "mean power of friction")
            .maybe(),
        column(
            "max_power", [](auto& c) -> auto& { return c.rubbing.max_power; }, "W",
            "largest power of friction")
            .maybe(),
        column(
            "mean_torque", [](auto& c) -> auto& { return c.rubbing.mean_torque; }, "N.m",
            "mean moment of friction about the axis")
            .maybe(),
        column(
            "max_torque", [](auto& c) -> auto& { return c.rubbing.max_torque; }, "N.m",
            "largest moment of friction about the axis")
            .maybe()};
  }
};

/// What all contacts did; group /contacts.
struct ContactShares {
  std::vector<ContactShare> contacts;

  static constexpr std::string_view group = "/contacts";
  static constexpr auto columns() {
    return ColumnList{rows(&ContactShares::contacts, "contacts+").maybe()};
  }
};
/// @param rubbing  of the contacts; empty: not told
ContactShares contact_shares(const std::vector<ContactMeasure>& contacts, long revolutions,
                             const std::vector<FrictionLoad>& rubbing = {});

/// Where a motion ended, and where other motions may begin; in group /trajectory.
struct MotionEnd {
  Vec displacement, velocity;  ///< full vectors, see DofMap [m, rad], [m/s, rad/s]
  double phase = 0.0;          ///< [rad]
  /// Number of the revolution, where forces do not repeat every revolution.
  std::optional<double> revolution{};

  static constexpr std::string_view group = "/trajectory";
  static constexpr auto columns() {
    return ColumnList{
        column("end_displacement", &MotionEnd::displacement, "m, rad",
               "displacement at the end: x, y, theta_x, theta_y of every node, then of every body")
            .along("full"),
        column("end_velocity", &MotionEnd::velocity, "m/s, rad/s",
               "velocity at the end: x, y, theta_x, theta_y of every node, then of every body")
            .along("full"),
        column("end_phase", &MotionEnd::phase, "rad", "phase at the end").within(valid::finite),
        column("end_revolution", &MotionEnd::revolution, "",
               "revolution at the end, where forces do not repeat with it")
            .within(valid::finite)
            .maybe()};
  }
};
MotionEnd motion_end(const Scene& scene, const MotionState& state);

/// Start of the motions of a study that go on from another motion; group /from.
struct StudyStart {
  Vec displacement, velocity;  ///< full vectors, see DofMap [m, rad], [m/s, rad/s]
  double phase = 0.0;          ///< [rad]
  /// Number of the revolution, where forces of the motion before did not repeat every revolution.
  std::optional<double> revolution{};

  static constexpr std::string_view group = "/from";
  static constexpr auto columns() {
    return ColumnList{column("displacement", &StudyStart::displacement, "m, rad",
                             "displacement that the motions begin with")
                          .along("full")
                          .within(valid::finite),
                      column("velocity", &StudyStart::velocity, "m/s, rad/s",
                             "velocity that the motions begin with")
                          .along("full")
                          .within(valid::finite),
                      column("phase", &StudyStart::phase, "rad", "phase that they begin at")
                          .within(valid::finite),
                      column("revolution", &StudyStart::revolution, "",
                             "revolution that they begin in, where forces do not repeat with it")
                          .within(valid::finite)
                          .maybe()};
  }
};

/// How a motion was computed and recorded; in group /trajectory.
struct RunFacts {
  int samples_per_revolution = 0;
  double revolutions = 0.0;
  double period = 0.0;  ///< of a revolution [s]
  double steps = 0.0, evaluations = 0.0, events = 0.0;
  Failure failure;

  static constexpr std::string_view group = "/trajectory";
  static constexpr auto columns() {
    constexpr double most_samples = 1e9;
    return ColumnList{
        column("samples_per_revolution", &RunFacts::samples_per_revolution, "", "samples")
            .within(valid::from_to(1.0, most_samples)),
        column("revolutions", &RunFacts::revolutions, "", "revolutions that are recorded")
            .within(valid::nonnegative),
        column("period", &RunFacts::period, "s", "of a revolution").within(valid::nonnegative),
        column("steps", &RunFacts::steps, "", "steps of the integration"),
        column("evaluations", &RunFacts::evaluations, "", "evaluations of the equations of motion"),
        column("events", &RunFacts::events, "", "beginnings and ends of touch, slip and stick"),
        column("failure", &RunFacts::failure, "", "why it ended early").maybe()};
  }
};
RunFacts run_facts(const Simulation& simulation);

/// Motion of a station.
struct StationMotion {
  std::string station;
  Vec x, y;  ///< per sample [m]

  static constexpr auto columns() {
    return ColumnList{column("station", &StationMotion::station, "", "station").axis(),
                      column("x", &StationMotion::x, "m", "displacement x").along("samples"),
                      column("y", &StationMotion::y, "m", "displacement y").along("samples")};
  }
};

/// What a probe reads of a motion.
struct ProbeSignal : ProbeLabel {
  Vec displacement;  ///< per sample [m]

  static constexpr auto columns() {
    return joined(ProbeLabel::columns(),
                  ColumnList{column("displacement", &ProbeSignal::displacement, "m",
                                    "displacement that a probe reads")
                                 .along("samples")});
  }
};

/// Force of the rotor on a bearing, seal, link, oil film or rolling bearing over a motion.
struct SupportForce {
  std::string kind, name;
  Vec x, y;  ///< per sample [N]

  static constexpr auto columns() {
    using S = SupportForce;
    return ColumnList{
        column("name", &S::name, "", "bearing, seal, link, oil film or rolling bearing").axis(),
        column("kind", &S::kind, "", "which of these"),
        column("force_x", &S::x, "N", "force of the rotor on it along x").along("samples"),
        column("force_y", &S::y, "N", "force of the rotor on it along y").along("samples")};
  }
};

/// A motion as it was recorded; in group /trajectory.
struct MotionRecord {
  Vec time;         ///< since the start [s]
  Mat coordinates;  ///< reduced ones x samples
  Mat basis;        ///< displacement of all points = basis * coordinates
  std::vector<StationMotion> stations;
  std::vector<ProbeSignal> probes;  ///< of the model
  Mat normal, friction;             ///< contacts x samples [N]
  std::vector<SupportForce> supports{};
  std::vector<double> begins{};  ///< of loads [s]

  static constexpr std::string_view group = "/trajectory";
  static constexpr auto columns() {
    return ColumnList{
        column("time", &MotionRecord::time, "s", "time since the start")
            .axis("samples+")
            .within(valid::finite),
        column("coordinates", &MotionRecord::coordinates, "",
               "reduced coordinates: displacement = basis * coordinates")
            .along("reduced samples"),
        column("basis", &MotionRecord::basis, "m, rad",
               "displacement of the reduced coordinates: x, y, theta_x, theta_y of every node, "
               "then of every body")
            .along("full reduced"),
        rows(&MotionRecord::stations, "stations+").maybe(),
        rows(&MotionRecord::probes, "probes").prefixed("probe_").maybe(),
        column("normal_force", &MotionRecord::normal, "N", "normal force")
            .along("/contacts/name samples")
            .maybe(),
        column("friction_force", &MotionRecord::friction, "N", "friction force along the tangent")
            .along("/contacts/name samples")
            .maybe(),
        rows(&MotionRecord::supports, "supports").prefixed("support_").maybe(),
        column("load_begin", &MotionRecord::begins, "s", "time at which a load begins")
            .along("begins+")
            .within(valid::finite)
            .maybe()};
  }
};
MotionRecord recorded_motion(const Run& run);

/// What the probes of the model read in a recording.
std::vector<ProbeSignal> probe_signals(const Run& run);

/// Spectrum of a station.
struct StationSpectrum {
  Vec amplitude;  ///< per line [m]

  static constexpr auto columns() {
    return ColumnList{column("amplitude", &StationSpectrum::amplitude, "m",
                             "radius of the circle at a signed frequency (Hann window)")
                          .along("lines")};
  }
};

/// Spectra of the stations of a run in ascending frequency, backward to the left; group /spectra.
struct StationSpectra {
  Vec frequency;  ///< signed [rad/s]
  std::vector<StationSpectrum> stations;

  static constexpr std::string_view group = "/spectra";
  static constexpr auto columns() {
    return ColumnList{
        column("frequency", &StationSpectra::frequency, "rad/s", "signed frequency, forward > 0")
            .axis("lines+")
            .within(valid::finite),
        rows(&StationSpectra::stations, "/trajectory/station")};
  }
};
StationSpectra spectra_of(const Run& run);

/// How a rotor was reduced.
struct ReductionFacts {
  int size = 0, dofs = 0;  ///< degrees of freedom, with and without the reduction
  double eigenvalue_error = 0.0, receptance_error = 0.0;

  static constexpr auto columns() {
    return ColumnList{
        column("size", &ReductionFacts::size, "", "reduced degrees of freedom"),
        column("freedoms", &ReductionFacts::dofs, "", "degrees of freedom"),
        column("eigenvalue_error", &ReductionFacts::eigenvalue_error, "", "largest, relative"),
        column("receptance_error", &ReductionFacts::receptance_error, "", "of the contacts")};
  }
};
ReductionFacts reduction_facts(const Scene& scene);

/// What an integration took.
struct RunCost {
  long steps = 0, evaluations = 0, events = 0;
  double wall = 0.0;  ///< [s]
  std::string method;

  static constexpr auto columns() {
    return ColumnList{
        column("steps", &RunCost::steps, "", "steps"),
        column("evaluations", &RunCost::evaluations, "", "of the equations of motion"),
        column("events", &RunCost::events, "", "begins and ends of contacts"),
        column("wall", &RunCost::wall, "s", "duration"),
        column("method", &RunCost::method, "", "integrator")};
  }
};

/// What a probe reads of a motion, in short.
struct ProbeSummary : ProbeLabel {
  double mean = 0.0;          ///< [m]
  double peak_to_peak = 0.0;  ///< between the largest and the smallest sample [m]

  static constexpr auto columns() {
    using P = ProbeSummary;
    return joined(ProbeLabel::columns(),
                  ColumnList{column("mean", &P::mean, "m", "of the reading"),
                             column("peak_to_peak", &P::peak_to_peak, "m", "of the reading")});
  }
};

/// A run as a whole, in short.
struct RunSummary {
  long revolutions = 0;  ///< recorded
  std::vector<ContactShare> contacts;
  ReductionFacts reduction;
  RunCost cost;
  Failure failure;
  std::vector<ProbeSummary> probes{};   ///< of a run with a motion
  std::vector<SupportLoad> supports{};  ///< likewise
  std::vector<double> begins{};         ///< of loads in the recording, since the start [s]
  std::vector<ContactTouch> touches{};  ///< the last ones of all contacts, in their order

  static constexpr auto columns() {
    using S = RunSummary;
    return ColumnList{
        column("revolutions", &S::revolutions, "", "revolutions that are recorded"),
        rows(&S::contacts, "contacts"),
        column("reduction", &S::reduction, "", "how the rotor was reduced"),
        column("cost", &S::cost, "", "what the integration took"),
        rows(&S::probes, "probes").only(Written::in_json).maybe(),
        rows(&S::supports, "supports").only(Written::in_json).maybe(),
        column("load_begins", &S::begins, "s", "times at which loads begin")
            .only(Written::in_json)
            .maybe(),
        rows(&S::touches, "touches").only(Written::in_json).maybe(),
        column("failure", &S::failure, "", "why it ended early").only(Written::in_json).maybe()};
  }
};
RunSummary run_summary(const Run& run);

/// What a recorded motion leaves of each running clearance, in the order of the model.
std::vector<RunningClearance> clearances_of(const Model& model, const Run& run);

/// Forces that a motion exerts, over the revolutions after a state; group /loads.
struct MotionLoads {
  std::vector<SupportLoad> supports;
  std::vector<ContactShare> contacts;

  static constexpr std::string_view group = "/loads";
  static constexpr auto columns() {
    return ColumnList{rows(&MotionLoads::supports, "supports").prefixed("support_").maybe(),
                      rows(&MotionLoads::contacts, "contacts").prefixed("contact_").maybe()};
  }
};
/// Forces on supports of a motion that was recorded, in short.
std::vector<SupportLoad> support_loads(const MotionRecord& motion, int samples_per_revolution);

/// @param recording  of the scene, with forces on supports
MotionLoads motion_loads(const std::vector<SupportLoads::Part>& supports,
                         const Recording& recording);

/// A circle that turns with a signed frequency.
struct FrequencyPeak {
  double frequency = 0.0;  ///< [rad/s]
  double amplitude = 0.0;  ///< radius [m]

  static constexpr auto columns() {
    return ColumnList{
        column("frequency", &FrequencyPeak::frequency, "rad/s", "signed frequency, forward > 0"),
        column("amplitude", &FrequencyPeak::amplitude, "m", "radius of the circle")};
  }
};

/// How a station moved.
struct StationSummary {
  std::optional<int> node;  ///< from 1; nothing: a body
  std::string name, label;
  double max_radius = 0.0;                           ///< [m]
  std::vector<FrequencyPeak> peaks, peaks_rotating;  ///< strongest first; as seen from the rotor

  static constexpr auto columns() {
    using S = StationSummary;
    return ColumnList{column("node", &S::node, "", "number of the node"),
                      column("name", &S::name, "", "what is there"),
                      column("max_radius", &S::max_radius, "m", "largest distance from the axis"),
                      column("peaks", &S::peaks, "", "strongest lines of the spectrum"),
                      column("peaks_rotating", &S::peaks_rotating, "", "seen from the rotor")};
  }
};
/// Summaries of all stations of a run; none without a motion. A motion that grew beyond all bounds
/// has no peaks.
std::vector<StationSummary> station_summaries(const Run& run);

}  // namespace whirl::inline dyn
