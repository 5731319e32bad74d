#include "apps/verbs/simulation.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "apps/progress.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/options.hpp"
#include "libdyn/motions/start.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/result_schema.hpp"
#include "libio/text/format.hpp"
#include "libio/text/table.hpp"

namespace whirl::inline cli {

namespace {

/// A motion that grew beyond all bounds has no spectrum.
bool is_finite(const Peak& peak) {
  return std::isfinite(peak.frequency) && std::isfinite(peak.amplitude);
}

std::string force_text(double force) {
  return std::abs(force) < 1e9 ? fmt::format("{:.1f}", force) : fmt::format("{:.4g}", force);
}

/// Bytes that a sample takes when most are in use: displacements and forces, the spectra of the
/// coordinates and what their transform takes, and of a result file the trajectory or spectra with a
/// copy of one dataset. Measured within 15 % for 4 and 8 coordinates, 2 to 13 stations.
double bytes_of_sample(int coordinates, std::size_t contacts, std::size_t written_stations) {
  constexpr double of_coordinate = 8.0 + 16.0, of_contact = 16.0, of_transform = 64.0;
  constexpr double of_station = 27.0;
  return of_coordinate * coordinates + of_contact * static_cast<double>(contacts) + of_transform +
         of_station * static_cast<double>(written_stations);
}

/// Whether a run fits this machine's memory; a wrong number of zeros is said at once.
void require_memory(const SimulationOptions& options, double bytes) {
  const double needed = bytes * options.samples * static_cast<double>(options.revolutions);
  const double there =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  if (needed < there) return;
  throw ModelError(
      {fmt::format("--revolutions {}", options.revolutions)}, "",
      fmt::format(
          "with {} samples each these take {:.0f} GB, this machine has {:.0f} GB; record fewer, "
          "--discard takes no memory",
          options.samples, 1e-9 * needed, 1e-9 * there));
}

Record peaks_record(const std::vector<Peak>& peaks) {
  Record list = Record::array();
  for (const Peak& p : peaks) {
    if (!is_finite(p)) continue;
    Record r;
    r.set("frequency_rpm", p.frequency / rpm).set("amplitude_m", p.amplitude);
    list.add(r);
  }
  return list;
}

std::string peaks_text(const std::vector<Peak>& peaks) {
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, peaks.size()); ++i) {
    if (!is_finite(peaks[i])) continue;
    text += fmt::format("{}{:+.1f} ({})", text.empty() ? "" : ", ", peaks[i].frequency / rpm,
                        format_length(peaks[i].amplitude));
  }
  return text.empty() ? "-" : text;
}

}  // namespace

std::vector<OptionSpec> integration_options(std::vector<OptionSpec> own) {
  const std::vector<OptionSpec> shared{
      {"revolutions", "N", "revolutions that are recorded", "512"},
      discard_option,
      {"samples", "N", "samples per revolution", "64"},
      {"method", "M",
       "integrator: taylor, collocation (left out: the better of these), dop853, cvode-adams, "
       "cvode-bdf, arkode, arkode-dirk, rk4"},
      tolerance_option,
      from_option,
      {"stations", "NAME,...",
       "what is recorded and shown: names, node numbers, all; left out: contacts, disks, "
       "bearings"}};
  own.insert(own.end(), shared.begin(), shared.end());
  return own;
}

void require_speed(const Model& model) {
  if (model.has_speed) return;
  throw ModelError({}, "operation.speed",
                   "missing, expected a speed (rad/s): write [operation] speed = "
                   "\"3000 rpm\", or use --speed 3000rpm");
}

EarlierEnd earlier_end(const std::string& path) {
  const auto result = open_result(path);
  const ResultReader& file = *result;
  if (!file.has("/trajectory/end_displacement")) {
    throw ModelError({path}, "",
                     "holds no motion to start from; simulate, identify and classify write one");
  }
  const auto ended = read_result<MotionEnd>(file);
  EarlierEnd end{{ended.displacement, ended.velocity}, ended.phase};
  if (!end.state.displacement.allFinite() || !end.state.velocity.allFinite()) {
    throw ModelError(
        {path}, "",
        "its motion failed and ends in no finite numbers: there is nothing to start from");
  }
  return end;
}

MotionState starting_state(const Invocation& call, Model model, const Scene& scene) {
  if (call.has("from")) {
    model.start.from = StartFrom::file;
    model.start.file = call.given.at("from");
    model.start.whirl.clear();  // it goes on as it was
  }
  if (model.start.from != StartFrom::file) return start_state(model, scene, nullptr);
  const EarlierEnd end = earlier_end(model.start.file);
  MotionState state = start_state(model, scene, &end.state);
  state.phase = end.phase;
  return state;
}

void require_tolerance(double tolerance, const std::string& option) {
  if (tolerance >= 1e-15 && tolerance <= 1e-2) return;
  throw ModelError({option}, "", "expected a number from 1e-15 to 1e-2");
}

void require_method(const std::string& method, const std::vector<std::string_view>& methods,
                    const std::string& option) {
  if (method == "cvode" || std::find(methods.begin(), methods.end(), method) != methods.end()) {
    return;
  }
  throw ModelError({option}, "",
                   fmt::format("unknown method, expected one of {}", fmt::join(methods, ", ")));
}

Run run_simulation(const Invocation& call, const Model& model) {
  require_speed(model);
  SimulationOptions options;
  options.revolutions = call.integer("revolutions");
  options.discard = call.integer("discard", 0);
  options.samples = static_cast<int>(call.integer("samples", 4));
  options.integration.tolerance = call.number("tolerance", "");
  require_tolerance(options.integration.tolerance, "--tolerance " + call.text("tolerance"));
  const std::string method = call.text("method");
  if (!method.empty()) require_method(method, method_names(), "--method " + method);

  Scene scene = make_scene(model);
  options.method = method.empty() ? suitable_method(scene.contacts) : method_named(method);
  if (method == "collocation" && !suits_collocation(scene.contacts)) {
    throw ModelError({"--method collocation"}, "",
                     "is for contacts of rings and stops only, without oil films; take taylor");
  }
  std::vector<NamedPoint> stations = select_points(model, scene.assembler, call.text("stations"));
  require_memory(options, bytes_of_sample(scene.contacts.coordinates(), model.contacts.size(),
                                          call.has("out") ? stations.size() : 0));
  MotionState start = starting_state(call, model, scene);
  if (start.phase > 0.0) {
    // samples begin with a revolution: what is left of this one is not recorded
    options.discard = std::max(1L, options.discard);
  }
  const long total = options.discard + options.revolutions;
  Progress progress("simulating", total, call.shows_progress);
  install_interrupt_handler();  // from now on Ctrl-C stops after the revolution under way
  options.progress = [&](long done) {
    progress.update(done);
    return !is_interrupted();
  };
  options.is_stopped = [steps = 0]() mutable {  // or within it, if it has no end
    constexpr int patience = 10'000;
    return is_interrupted() && ++steps > patience;
  };
  Simulation simulation = simulate(scene, start, options);
  Run run{std::move(scene), std::move(simulation), std::move(stations),
          std::string(name_of_method(options.method)), nullptr};
  if (run.has_motion()) {
    run.spectra = std::make_shared<const ResponseSpectra>(run.scene, run.simulation.recording);
  }
  return run;
}

int status_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::reached_end:
      return 0;
    case Outcome::stopped_by_observer:
      return 130;
    default:
      return 3;
  }
}

void add_contacts(Record& record, const std::vector<ContactMeasure>& contacts, long revolutions) {
  record.merge(record_of(contact_shares(contacts, revolutions)));
}

std::string contacts_table(const std::vector<ContactMeasure>& contacts, long revolutions) {
  Table table({"contact", "regime", "duty", "impacts/rev", "largest normal [N]", "tangential [N]",
               "mean slip [m/s]"});
  for (const ContactShare& c : contact_shares(contacts, revolutions).contacts) {
    table.row({c.name, std::string(name_of(c.regime)), fmt::format("{:.4f}", c.duty),
               fmt::format("{:.3f}", c.impacts_per_rev), force_text(c.max_normal),
               force_text(c.max_tangential),
               std::isnan(c.mean_slip) ? "-" : fmt::format("{:.4g}", c.mean_slip)});
  }
  return table.text();
}

void add_reduction(Record& record, const Scene& scene) {
  record.set("reduction", record_of(reduction_facts(scene)));
}

void add_run(Record& record, const Run& run) {
  const Simulation& s = run.simulation;
  record.set("revolutions", s.recording.revolutions);
  add_contacts(record, s.recording.contacts, s.recording.revolutions);
  add_reduction(record, run.scene);
  Record cost;
  cost.set("steps", s.integration.cost.steps).set("evaluations", s.integration.cost.evaluations);
  cost.set("events", s.integration.cost.events).set("wall_s", s.wall).set("method", run.method);
  record.set("cost", cost);
  if (!s.integration.diagnosis.empty()) record.set("failure", s.integration.diagnosis);
}

void add_stations(Record& record, const Run& run) {
  Record list = Record::array();
  if (run.has_motion()) {
    const ResponseSpectra& spectra = *run.spectra;
    for (const NamedPoint& p : run.stations) {
      const Mat xy = motion_of(run, p.point);
      const PointPeaks peaks = point_peaks(spectra, p.point, run.scene.system.Omega);
      Record r;
      r.set("node", p.node() > 0 ? Record(p.node()) : Record(nullptr)).set("name", p.name);
      r.set("max_radius_m", xy.rowwise().norm().maxCoeff());
      r.set("peaks", peaks_record(peaks.stationary))
          .set("peaks_rotating", peaks_record(peaks.rotating));
      list.add(r);
    }
  }
  record.set("stations", list);
}

std::string reduction_text(const Scene& scene, const Model& model) {
  const ReductionError& e = scene.error;
  std::string text;
  if (scene.reduced.size() == scene.system.size()) {
    text += fmt::format("  {} freedoms, not reduced\n", scene.system.size());
  } else {
    text += fmt::format(
        "  {} of {} freedoms; up to {:.0f} rpm eigenvalues are {:.2g} % off, contact receptances "
        "{:.2g} %\n",
        scene.reduced.size(), scene.system.size(), e.band / rpm, 100.0 * e.eigenvalue(),
        100.0 * e.receptance);
    if (!e.within_tolerance) {
      const auto worst =
          std::max_element(e.pairs.begin(), e.pairs.end(),
                           [](const auto& a, const auto& b) { return a.error() < b.error(); });
      text += fmt::format("  warning: that is more than reduction.tolerance = {:g}",
                          model.reduction.tolerance);
      if (worst != e.pairs.end()) {
        text += fmt::format(" ({:.1f} rpm comes out as {:.1f} rpm)", worst->full.imag() / rpm,
                            worst->reduced.imag() / rpm);
      }
      text += "\n";
    }
  }
  return text;
}

std::string run_text(const Run& run, const Model& model) {
  const Simulation& s = run.simulation;
  const Recording& recording = s.recording;
  std::string text = reduction_text(run.scene, model);
  text += fmt::format(
      "  {} revolution{} recorded at {:.6g} rpm; {} steps, {} events, {:.2f} s with {}\n",
      recording.revolutions, recording.revolutions == 1 ? "" : "s", model.speed / rpm,
      s.integration.cost.steps, s.integration.cost.events, s.wall, run.method);
  if (s.integration.outcome == Outcome::stopped_by_observer) {
    text +=
        "  stopped before the end; a result file keeps the motion until there, --from goes on with "
        "it\n";
  }
  if (!run.has_motion()) return text;

  if (!recording.contacts.empty()) {
    text += "\n" + contacts_table(recording.contacts, recording.revolutions);
  }
  Table table({"station", "largest radius", "strongest frequencies [rpm] (radius)",
               "seen from the rotor [rpm]"});
  const ResponseSpectra& spectra = *run.spectra;
  for (const NamedPoint& p : run.stations) {
    const PointPeaks peaks = point_peaks(spectra, p.point, run.scene.system.Omega);
    table.row({p.label(), format_length(motion_of(run, p.point).rowwise().norm().maxCoeff()),
               peaks_text(peaks.stationary), peaks_text(peaks.rotating)});
  }
  return text + "\n" + table.text();
}

void write_end(ResultWriter& file, const Model& model, const Scene& scene,
               const MotionState& state) {
  file.attribute("/", "speed", model.speed);
  write_points(file, model, scene.assembler);
  write_result(file, motion_end(scene, state));
}

void write_run(ResultWriter& file, const Run& run, const Model& model) {
  write_end(file, model, run.scene, run.simulation.end);
  write_result(file, run_facts(run.simulation));
  if (!run.has_motion()) return;
  const Recording& r = run.simulation.recording;
  write_result(file, contact_shares(r.contacts, r.revolutions));
  write_result(file, recorded_motion(run));
  if (!run.stations.empty()) write_result(file, spectra_of(run));
}

}  // namespace whirl::inline cli
