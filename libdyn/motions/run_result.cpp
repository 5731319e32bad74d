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

ContactShares contact_shares(const std::vector<ContactMeasure>& contacts, long revolutions) {
  ContactShares shares;
  for (const ContactMeasure& c : contacts) {
    shares.contacts.push_back({contact_doing(c, revolutions), c.name, c.mean_slip});
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

RunSummary run_summary(const Run& run) {
  const Simulation& s = run.simulation;
  std::vector<ProbeSummary> probes;
  for (const ProbeSignal& signal :
       run.has_motion() ? probe_signals(run) : std::vector<ProbeSignal>{}) {
    const Vec& d = signal.displacement;
    probes.push_back({signal, d.mean(), d.maxCoeff() - d.minCoeff()});
  }
  const Cost& cost = s.integration.cost;
  return {.revolutions = s.recording.revolutions,
          .contacts = contact_shares(s.recording.contacts, s.recording.revolutions).contacts,
          .reduction = reduction_facts(run.scene),
          .cost = {cost.steps, cost.evaluations, cost.events, s.wall, run.method},
          .failure = s.integration.failure,
          .probes = std::move(probes)};
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
