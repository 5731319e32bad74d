#include "libdyn/motions/run_result.hpp"

#include <algorithm>
#include <cmath>

namespace whirl::inline dyn {

namespace {

std::vector<FrequencyPeak> finite_peaks(const std::vector<Peak>& peaks) {
  std::vector<FrequencyPeak> finite;
  for (const Peak& p : peaks) {
    if (std::isfinite(p.frequency) && std::isfinite(p.amplitude)) {
      finite.push_back({p.frequency, p.amplitude});
    }
  }
  return finite;
}

}  // namespace

Mat motion_of(const Run& run, const Point& point) {
  const Mat map = run.scene.displacement_map();
  const DofMap& dofs = run.scene.reduced.dofs;
  Mat xy(run.simulation.recording.eta.cols(), 2);
  for (const int c : {X, Y}) {
    xy.col(c) = (map.row(dofs.full_index(point, c)) * run.simulation.recording.eta).transpose();
  }
  return xy;
}

Vec reading_of(const Run& run, const Probe& probe) {
  const Mat row = probe_rows({probe}, run.scene, run.scene.displacement_map());
  return (row * run.simulation.recording.eta).transpose();
}

std::vector<ProbeSignal> probe_signals(const Run& run) {
  std::vector<ProbeSignal> signals;
  for (const Probe& probe : probes_of(run.scene)) {
    signals.push_back({probe, reading_of(run, probe)});
  }
  return signals;
}

ContactShares contact_shares(const std::vector<ContactMeasure>& contacts, long revolutions,
                             const std::vector<FrictionLoad>& rubbing) {
  ContactShares shares;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ContactMeasure& c = contacts[i];
    shares.contacts.push_back({contact_doing(c, revolutions), c.name, c.mean_slip,
                               i < rubbing.size() ? rubbing[i] : FrictionLoad{}});
  }
  return shares;
}

MotionEnd motion_end(const Scene& scene, const MotionState& state) {
  const FullState end = full_state(scene, state);
  MotionEnd motion{end.displacement, end.velocity, state.phase};
  if (scene.contacts.repeats_after() != 1) motion.revolution = state.revolution;
  return motion;
}

RunFacts run_facts(const Simulation& simulation) {
  const Recording& r = simulation.recording;
  const Cost& cost = simulation.integration.cost;
  return {.samples_per_revolution = r.samples,
          .revolutions = static_cast<double>(r.revolutions),
          .period = r.clock.period(),
          .steps = static_cast<double>(cost.steps),
          .evaluations = static_cast<double>(cost.evaluations),
          .events = static_cast<double>(cost.events),
          .failure = simulation.integration.failure};
}

MotionRecord recorded_motion(const Run& run) {
  const Recording& r = run.simulation.recording;
  MotionRecord t{.time = r.time, .coordinates = r.eta, .basis = run.scene.displacement_map()};
  for (const NamedPoint& p : run.stations) {
    const Mat xy = motion_of(run, p.point);
    t.stations.push_back({p.label(), xy.col(0), xy.col(1)});
  }
  t.probes = probe_signals(run);
  t.begins = r.begins;
  for (std::size_t i = 0; i < run.supports.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(2 * i);
    t.supports.push_back({run.supports[i].kind, run.supports[i].name,
                          r.on_supports.row(row).transpose(),
                          r.on_supports.row(row + 1).transpose()});
  }
  if (!r.contacts.empty()) {
    t.normal = r.normal;
    t.friction = r.friction;
  }
  return t;
}

StationSpectra spectra_of(const Run& run) {
  const ResponseSpectra& spectra = *run.spectra;
  StationSpectra result{.frequency = signed_frequencies(spectra.size(), spectra.bin())};
  for (const NamedPoint& p : run.stations) {
    result.stations.push_back({spectra.at(p.point).ascending().cwiseAbs()});
  }
  return result;
}

ReductionFacts reduction_facts(const Scene& scene) {
  return {static_cast<int>(scene.reduced.size()), static_cast<int>(scene.system.size()),
          scene.error.eigenvalue(), scene.error.receptance};
}

namespace {

constexpr long last_revolutions = 8;  ///< that tell the force after a load has begun

/// When a motion was recorded.
struct Samples {
  const Vec& time;                    ///< [s]
  const std::vector<double>& begins;  ///< of loads [s]
  int of_revolution;
};

/// @param fx, fy  per sample [N]
SupportLoad support_load(const SupportLoads::Part& part, const Samples& r, const Vec& fx,
                         const Vec& fy) {
  const Vec force = (fx.array().square() + fy.array().square()).sqrt();
  Eigen::Index at = 0;
  const double largest = force.maxCoeff(&at);
  SupportLoad load{.kind = part.kind,
                   .name = part.name,
                   .mean_fx = fx.mean(),
                   .mean_fy = fy.mean(),
                   .largest = largest,
                   .largest_at = r.time(at),
                   .peak_to_peak_fx = fx.maxCoeff() - fx.minCoeff(),
                   .peak_to_peak_fy = fy.maxCoeff() - fy.minCoeff()};
  if (r.begins.empty()) return load;
  const auto before = std::ranges::lower_bound(r.time, r.begins.front()) - r.time.begin();
  const auto begun = std::ranges::lower_bound(r.time, r.begins.back()) - r.time.begin();
  if (before > 0) load.before = force.head(before).maxCoeff();
  const auto after =
      std::min<Eigen::Index>(last_revolutions * r.of_revolution, force.size() - begun);
  if (after > 0) load.after = force.tail(after).maxCoeff();
  return load;
}

std::vector<SupportLoad> support_loads(const std::vector<SupportLoads::Part>& parts,
                                       const Recording& r) {
  const Samples samples{r.time, r.begins, r.samples};
  std::vector<SupportLoad> all;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(2 * i);
    all.push_back(support_load(parts[i], samples, r.on_supports.row(row).transpose(),
                               r.on_supports.row(row + 1).transpose()));
  }
  return all;
}

}  // namespace

std::vector<SupportLoad> support_loads(const MotionRecord& motion, int samples_per_revolution) {
  std::vector<SupportLoad> all;
  for (const SupportForce& s : motion.supports) {
    if (s.x.size() == 0) continue;
    all.push_back(support_load({s.kind, s.name},
                               {motion.time, motion.begins, samples_per_revolution}, s.x, s.y));
  }
  return all;
}

MotionLoads motion_loads(const std::vector<SupportLoads::Part>& supports,
                         const Recording& recording) {
  if (recording.revolutions == 0) return {};
  return {support_loads(supports, recording),
          contact_shares(recording.contacts, recording.revolutions, recording.rubbing).contacts};
}

RunSummary run_summary(const Run& run) {
  const Simulation& s = run.simulation;
  std::vector<ProbeSummary> probes;
  for (const ProbeSignal& signal :
       run.has_motion() ? probe_signals(run) : std::vector<ProbeSignal>{}) {
    const Vec& d = signal.displacement;
    probes.push_back({signal, d.mean(), d.maxCoeff() - d.minCoeff()});
  }
  std::vector<SupportLoad> supports;
  if (run.has_motion()) supports = support_loads(run.supports, s.recording);
  const Cost& cost = s.integration.cost;
  return {
      .revolutions = s.recording.revolutions,
      .contacts = contact_shares(s.recording.contacts, s.recording.revolutions, s.recording.rubbing)
                      .contacts,
      .reduction = reduction_facts(run.scene),
      .cost = {cost.steps, cost.evaluations, cost.events, s.wall, run.method},
      .failure = s.integration.failure,
      .probes = std::move(probes),
      .supports = std::move(supports),
      .begins = s.recording.begins,
      .touches = run.has_motion() ? touches_of(s.recording) : std::vector<ContactTouch>{}};
}

std::vector<RunningClearance> clearances_of(const Model& model, const Run& run) {
  return largest_distances(model, run.scene.assembler, run.scene.displacement_map(),
                           run.simulation.recording.eta);
}

std::vector<StationSummary> station_summaries(const Run& run) {
  std::vector<StationSummary> summaries;
  if (!run.has_motion()) return summaries;
  for (const NamedPoint& p : run.stations) {
    const PointPeaks peaks = point_peaks(*run.spectra, p.point, run.scene.system.Omega);
    summaries.push_back({.node = p.node() > 0 ? std::optional(p.node()) : std::nullopt,
                         .name = p.name,
                         .label = p.label(),
                         .max_radius = motion_of(run, p.point).rowwise().norm().maxCoeff(),
                         .peaks = finite_peaks(peaks.stationary),
                         .peaks_rotating = finite_peaks(peaks.rotating)});
  }
  return summaries;
}

}  // namespace whirl::inline dyn
