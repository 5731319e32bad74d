#include "apps/verbs/simulation.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "apps/progress.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/options.hpp"
#include "libdyn/motions/start.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/results/result_schema.hpp"
#include "libio/text/format.hpp"
#include "libio/text/table.hpp"

namespace whirl {

namespace {

/// Motion of a station in a recording, samples x (x, y).
Mat motion(const Run& run, const Point& point) {
  const Mat map = run.scene.displacement_map();
  const DofMap& dofs = run.scene.reduced.dofs;
  Mat xy(run.simulation.recording.eta.cols(), 2);
  for (const int c : {X, Y}) {
    xy.col(c) = (map.row(dofs.full_index(point, c)) * run.simulation.recording.eta).transpose();
  }
  return xy;
}

/// A motion that grew beyond all bounds has no spectrum.
bool is_finite(const Peak& peak) {
  return std::isfinite(peak.frequency) && std::isfinite(peak.amplitude);
}

std::string force_text(double force) {
  return std::abs(force) < 1e9 ? fmt::format("{:.1f}", force) : fmt::format("{:.4g}", force);
}

/// Bytes that a sample takes when most are in use: displacements and forces, the spectra of the
/// coordinates and what their transform takes, and of a result file the stations' motions and
/// spectra with a copy of one. Measured within 15 % for 4 and 8 coordinates, 2 to 13 stations.
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

/// The order of freedoms in a result file.
const std::string full_vector = ": x, y, theta_x, theta_y of every node, then of every body";

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
  EarlierEnd end{
      {file.vector("/trajectory/end_displacement"), file.vector("/trajectory/end_velocity")},
      file.number_attribute("/trajectory", "end_phase")};
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
                     "is for contacts of rings only, without oil films; take taylor");
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
  Record list = Record::array();
  for (const ContactMeasure& c : contacts) {
    Record r;
    r.set("name", c.name).set("regime", name_of(c.regime())).set("duty", c.duty);
    r.set("impacts_per_rev", c.impacts / static_cast<double>(std::max(1L, revolutions)));
    r.set("max_normal_n", c.max_normal).set("max_tangential_n", c.max_tangential);
    r.set("sticking", c.sticking).set("mean_slip_m_s", c.mean_slip);
    list.add(r);
  }
  record.set("contacts", list);
}

std::string contacts_table(const std::vector<ContactMeasure>& contacts, long revolutions) {
  Table table({"contact", "regime", "duty", "impacts/rev", "largest normal [N]", "tangential [N]",
               "mean slip [m/s]"});
  for (const ContactMeasure& c : contacts) {
    table.row({c.name, std::string(name_of(c.regime())), fmt::format("{:.4f}", c.duty),
               fmt::format("{:.3f}", c.impacts / static_cast<double>(revolutions)),
               force_text(c.max_normal), force_text(c.max_tangential),
               std::isnan(c.mean_slip) ? "-" : fmt::format("{:.4g}", c.mean_slip)});
  }
  return table.text();
}

void add_reduction(Record& record, const Scene& scene) {
  Record reduction;
  const ReductionError& e = scene.error;
  reduction.set("size", scene.reduced.size()).set("freedoms", scene.system.size());
  reduction.set("eigenvalue_error", e.eigenvalue()).set("receptance_error", e.receptance);
  record.set("reduction", reduction);
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
      const Mat xy = motion(run, p.point);
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
    table.row({point_label(p), format_length(motion(run, p.point).rowwise().norm().maxCoeff()),
               peaks_text(peaks.stationary), peaks_text(peaks.rotating)});
  }
  return text + "\n" + table.text();
}

void write_end(ResultWriter& file, const Model& model, const Scene& scene,
               const MotionState& state) {
  file.attribute("/", "speed", model.speed);
  write_points(file, model, scene.assembler);
  const FullState end = full_state(scene, state);
  file.dataset("/trajectory/end_displacement", end.displacement,
               {"m, rad", "displacement at the end" + full_vector, {""}});
  file.dataset("/trajectory/end_velocity", end.velocity,
               {"m/s, rad/s", "velocity at the end" + full_vector, {""}});
  file.attribute("/trajectory", "end_phase", state.phase);
}

void write_run(ResultWriter& file, const Run& run, const Model& model) {
  const Recording& r = run.simulation.recording;
  write_end(file, model, run.scene, run.simulation.end);
  file.attribute("/trajectory", "samples_per_revolution", r.samples);
  file.attribute("/trajectory", "revolutions", static_cast<double>(r.revolutions));
  file.attribute("/trajectory", "period", r.period);
  const Cost& cost = run.simulation.integration.cost;
  file.attribute("/trajectory", "steps", static_cast<double>(cost.steps));
  file.attribute("/trajectory", "evaluations", static_cast<double>(cost.evaluations));
  file.attribute("/trajectory", "events", static_cast<double>(cost.events));
  if (!run.simulation.integration.diagnosis.empty()) {
    file.attribute("/trajectory", "failure", run.simulation.integration.diagnosis);
  }
  if (!run.has_motion()) return;

  const auto n = r.eta.cols();
  Vec time(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    time(j) =
        r.period * (static_cast<double>(r.first_revolution) + static_cast<double>(j) / r.samples);
  }
  std::vector<std::string> names;
  Mat x(static_cast<Eigen::Index>(run.stations.size()), n), y(x.rows(), n);
  for (std::size_t i = 0; i < run.stations.size(); ++i) {
    names.push_back(point_label(run.stations[i]));
    const Mat xy = motion(run, run.stations[i].point);
    x.row(static_cast<Eigen::Index>(i)) = xy.col(0).transpose();
    y.row(static_cast<Eigen::Index>(i)) = xy.col(1).transpose();
  }
  file.dataset("/trajectory/time", time, {"s", "time since the start", {""}});
  if (!names.empty()) {
    file.dataset("/trajectory/station", names, {"", "station", {""}});
    const std::vector<std::string> axes{"/trajectory/station", "/trajectory/time"};
    file.dataset("/trajectory/x", x, {"m", "displacement x", axes});
    file.dataset("/trajectory/y", y, {"m", "displacement y", axes});
  }
  file.dataset(
      "/trajectory/coordinates", r.eta,
      {"", "reduced coordinates: displacement = basis * coordinates", {"", "/trajectory/time"}});
  file.dataset("/trajectory/basis", run.scene.displacement_map(),
               {"m, rad", "displacement of the reduced coordinates" + full_vector, {"", ""}});

  if (!r.contacts.empty()) {
    std::vector<std::string> contacts, regimes;
    std::vector<double> duty, impacts, normal, tangential, sticking, slip;
    for (const ContactMeasure& c : r.contacts) {
      contacts.push_back(c.name);
      regimes.emplace_back(name_of(c.regime()));
      duty.push_back(c.duty);
      impacts.push_back(c.impacts / static_cast<double>(r.revolutions));
      normal.push_back(c.max_normal);
      tangential.push_back(c.max_tangential);
      sticking.push_back(c.sticking);
      slip.push_back(c.mean_slip);
    }
    file.dataset("/contacts/name", contacts, {"", "contact", {""}});
    const std::vector<std::string> per{"/contacts/name"};
    file.dataset("/contacts/regime", regimes, {"", "regime", per});
    file.dataset("/contacts/duty", duty, {"", "share of time in touch", per});
    file.dataset("/contacts/impacts_per_rev", impacts, {"", "impacts per revolution", per});
    file.dataset("/contacts/max_normal", normal, {"N", "largest normal force", per});
    file.dataset("/contacts/max_tangential", tangential, {"N", "largest friction force", per});
    file.dataset("/contacts/sticking", sticking, {"", "share of time sticking", per});
    file.dataset("/contacts/mean_slip", slip, {"m/s", "mean slip velocity in touch", per});
    const std::vector<std::string> axes{"/contacts/name", "/trajectory/time"};
    file.dataset("/trajectory/normal_force", r.normal, {"N", "normal force", axes});
    file.dataset("/trajectory/friction_force", r.friction,
                 {"N", "friction force along the tangent", axes});
  }

  // spectra in ascending frequency, backward to the left
  const ResponseSpectra& spectra = *run.spectra;
  const auto bins = spectra.size(), half = bins / 2;
  Vec frequency(bins);
  Mat amplitude(x.rows(), bins);
  for (Eigen::Index k = 0; k < bins; ++k)
    frequency(k) = static_cast<double>(k - half) * spectra.bin();
  for (std::size_t i = 0; i < run.stations.size(); ++i) {
    const Spectrum s = spectra.at(run.stations[i].point);
    for (Eigen::Index k = 0; k < bins; ++k) {
      amplitude(static_cast<Eigen::Index>(i), k) = std::abs(s.at(k - half));
    }
  }
  if (names.empty()) return;
  file.dataset("/spectra/frequency", frequency, {"rad/s", "signed frequency, forward > 0", {""}});
  file.dataset("/spectra/amplitude", amplitude,
               {"m",
                "radius of the circle at a signed frequency (Hann window)",
                {"/trajectory/station", "/spectra/frequency"}});
}

}  // namespace whirl
