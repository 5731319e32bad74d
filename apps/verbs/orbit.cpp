#include <fmt/format.h>

#include <limits>

#include "apps/invocation.hpp"
#include "apps/progress.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/branch_point.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "apps/verbs/options.hpp"
#include "apps/verbs/orbits.hpp"
#include "apps/verbs/simulation.hpp"
#include "libbase/error.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libdyn/orbits/cycle.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/text/table.hpp"

namespace whirl {

namespace {

std::string multipliers_table(const FoundOrbit& orbit) {
  std::vector<std::string> head{"multiplier", "real",           "imaginary",
                                "size",       "exponent [1/s]", "frequency [rpm]"};
  if (!orbit.modes.empty()) head.push_back("most like mode (MAC)");
  Table table(head);
  const CVec& rates = orbit.exponents;
  for (Eigen::Index i = 0; i < rates.size(); ++i) {
    const Complex m = orbit.multipliers(i);
    std::vector<std::string> row{std::to_string(i + 1),
                                 fmt::format("{:+.8f}", m.real()),
                                 fmt::format("{:+.8f}", m.imag()),
                                 fmt::format("{:.8f}", std::abs(m)),
                                 fmt::format("{:+.6f}", rates(i).real()),
                                 fixed(rates(i).imag() / rpm, 2)};
    if (!orbit.modes.empty()) {
      const MultiplierMode& mode = orbit.modes[static_cast<std::size_t>(i)];
      row.push_back(mode.mode > 0 ? fmt::format("{} ({:.2f})", mode.mode, mode.mac) : "-");
    }
    table.row(row);
  }
  return table.text();
}

}  // namespace

OrbitFrame orbit_frame(const Invocation& call) {
  const std::string frame = call.text("frame");
  for (const auto& [name, value] : choices(OrbitFrame{})) {
    if (name == frame) return value;
  }
  throw ModelError({"--frame " + frame}, "", "expected stationary or rotating");
}

Trajectory after_transient(const Invocation& call, const Model& model, const Scene& scene) {
  const long discard = call.has("from") && !call.has("discard") ? 0 : call.integer("discard", 0);
  const double tolerance = call.number("tolerance", "");
  require_tolerance(tolerance, "--tolerance " + call.text("tolerance"));
  Trajectory transient{.system = &scene.contacts, .state = starting_state(call, model, scene)};
  if (scene.contacts.coordinates() == 0) {
    throw NumericalError("nothing moves: the system has no freedoms");
  }
  // an orbit is shot from phase 0: what is left of a revolution is gone through first
  transient.revolutions = transient.state.phase > 0.0 ? std::max(1L, discard) : discard;
  Progress progress("going through the transient", transient.revolutions, call.shows_progress);
  install_interrupt_handler();
  if (transient.revolutions > 0) {
    integrate_single(transient, {.tolerance = tolerance, .watch = [&](long done) {
                                   progress.update(done);
                                   return !is_interrupted();
                                 }});
  }
  return transient;
}

namespace {

/// An orbit that repeats as seen from the rotor, whose period is any.
Report rotating_orbit(const Invocation& call, const Model& model) {
  const auto file = call.result_file(model);
  const auto shared = std::make_shared<const Scene>(make_scene(model));
  const Scene& scene = *shared;
  const FreeFlow flow = rotating_flow(shared);
  const Trajectory transient = after_transient(call, model, scene);
  if (transient.outcome == Outcome::stopped_by_observer) {
    return {.record = begin_record(call, model), .failure = "stopped", .status = 130};
  }
  if (transient.outcome != Outcome::reached_end) throw NumericalError(transient.diagnosis);
  const Cycle cycle =
      shorten(flow, find_cycle(flow, transient.state.y, guessed_period(scene, transient.state.y)));
  const double turns = cycle.period / scene.contacts.period();
  Report report{.record = begin_record(call, model),
                .failure = cycle.failure,
                .status = cycle.is_good() ? 0 : 3};
  note_tables(call, model, report);
  MotionState on_it;
  on_it.y = cycle.state;
  Record floquet = Record::array();
  for (const Complex& m : cycle.multipliers) floquet.add(m);
  const long steps = std::max(1L, std::ssize(cycle.residuals)) - 1;
  Record& r = report.record;
  r.set("frame", "rotating").set("period_revs", turns).set("period_s", cycle.period);
  r.set("residual", cycle.residual).set("steps", steps).set("floquet", floquet);
  r.set("stable", cycle.is_good() ? Record(cycle.is_stable()) : Record(nullptr));
  r.set("state", on_it.y);
  add_reduction(r, scene);
  if (!cycle.failure.empty()) r.set("failure", cycle.failure);
  report.text = "Periodic orbit in the rotating frame" +
                (model.title.empty() ? "" : ": " + model.title) + "\n\n" +
                reduction_text(scene, model);
  if (cycle.is_good()) {
    report.text += fmt::format(
        "  {} orbit of {:.9g} revolutions, {:.6g} rpm seen from the rotor; residual {:.1e} length "
        "scales after {} steps of Newton's method\n\n",
        cycle.is_stable() ? "stable" : "unstable", turns,
        2.0 * std::numbers::pi / cycle.period / rpm, cycle.residual, steps);
    Table table({"multiplier", "real", "imaginary", "size"});
    for (Eigen::Index i = 0; i < cycle.multipliers.size(); ++i) {
      const Complex m = cycle.multipliers(i);
      table.row({std::to_string(i + 1), fmt::format("{:+.8f}", m.real()),
                 fmt::format("{:+.8f}", m.imag()), fmt::format("{:.8f}", std::abs(m))});
    }
    report.text += table.text();
  }
  if (file) {
    write_end(*file, model, scene, on_it);
    if (cycle.is_good()) {
      file->dataset("/orbit/multiplier", cycle.multipliers,
                    {"", "Floquet multipliers of the period, the largest first", {""}});
      file->attribute("/orbit", "period_revolutions", turns);
      file->attribute("/orbit", "residual", cycle.residual);
      file->attribute("/orbit", "stable", cycle.is_stable() ? 1 : 0);
    }
  }
  commit(call, file.get(), report);
  return report;
}

}  // namespace

OrbitMethod orbit_method(const Invocation& call) {
  const std::string method = call.text("method");
  if (method == "harmonic-balance") return OrbitMethod::harmonic_balance;
  if (method != "shooting") {
    throw ModelError({"--method " + method}, "", "expected shooting or harmonic-balance");
  }
  for (const std::string option : {"harmonics", "verify"}) {
    if (!call.has(option)) continue;
    throw ModelError({"--" + option}, "", "goes with --method harmonic-balance");
  }
  return OrbitMethod::shooting;
}

namespace {

FoundOrbit find_by_shooting(const Scene& scene, const Vec& start, int period) {
  const Flow flow = flow_of(scene.contacts);
  PeriodicOrbit orbit = find_orbit(flow, start, {.period = period});
  FoundOrbit found{.period = period, .shortest_period = period};
  found.residual = orbit.residual;
  found.steps = std::max(1L, std::ssize(orbit.residuals)) - 1;
  found.states = orbit.states;
  found.multipliers = orbit.multipliers;
  found.contacts = orbit.contacts;
  found.failure = orbit.failure;
  found.summary = fmt::format("residual {:.1e} length scales after {} steps of Newton's method",
                              orbit.residual, found.steps);
  if (!orbit.is_good()) return found;
  found.shortest_period = shortest_period(orbit, flow.scale);
  found.exponents = orbit.exponents();
  found.is_stable = orbit.is_stable();
  found.modes = modes_of_multipliers(scene, orbit);
  return found;
}

void write_orbit(ResultWriter& file, const Scene& scene, const FoundOrbit& orbit) {
  const auto n = scene.contacts.coordinates();
  const Mat map = scene.displacement_map();
  Mat displacements(map.rows(), std::ssize(orbit.states)), velocities = displacements;
  for (std::size_t i = 0; i < orbit.states.size(); ++i) {
    displacements.col(static_cast<Eigen::Index>(i)) = map * orbit.states[i].head(n);
    velocities.col(static_cast<Eigen::Index>(i)) = map * orbit.states[i].tail(n);
  }
  file.dataset("/orbit/multiplier", orbit.multipliers,
               {"", "Floquet multipliers of the period, the largest first", {""}});
  file.dataset("/orbit/exponent", orbit.exponents,
               {"1/s", "Floquet exponents, log(multiplier) / period", {"/orbit/multiplier"}});
  file.dataset("/orbit/displacement", displacements,
               {"m, rad", "displacement of all points at the starts of revolutions", {"", ""}});
  file.dataset("/orbit/velocity", velocities,
               {"m/s, rad/s", "velocity of all points at the starts of revolutions", {"", ""}});
  file.attribute("/orbit", "period_revolutions", orbit.period);
  file.attribute("/orbit", "residual", orbit.residual);
  file.attribute("/orbit", "stable", orbit.is_stable ? 1 : 0);
  if (orbit.write) orbit.write(file);
}

Report run_orbit(const Invocation& given) {
  std::optional<BranchStart> point;
  Invocation call = given;
  if (call.has("point")) {
    point = branch_start(call);
    call.sets.insert(call.sets.end(), point->sets.begin(), point->sets.end());
  }
  const Model model = call.model();
  require_speed(model);
  const OrbitMethod method = orbit_method(call);
  if (call.has("starts")) return search_orbits(call, model);
  if (orbit_frame(call) == OrbitFrame::rotating) {
    if (point) {
      throw ModelError({"--point"}, "", "expected an orbit of the stationary frame");
    }
    if (method == OrbitMethod::shooting) return rotating_orbit(call, model);
    throw ModelError({"--frame rotating"}, "",
                     "harmonic balance finds orbits in the stationary frame only");
  }
  const int period =
      point && !call.has("period") ? point->period : static_cast<int>(call.integer("period"));
  harmonics_of(call, period);  // before anything long
  const auto file = call.result_file(model);
  const Scene scene = make_scene(model);
  // an unstable orbit is not to be left before it is looked for
  const Trajectory transient =
      point ? Trajectory{.system = &scene.contacts,
                         .state = {.y = BasisChange(scene, point->first).to(point->state)}}
            : after_transient(call, model, scene);
  FoundOrbit orbit{.period = period, .shortest_period = period, .states = {transient.state.y}};
  orbit.residual = std::numeric_limits<double>::quiet_NaN();
  int status = status_of(transient.outcome);
  if (status == 0) {
    orbit = method == OrbitMethod::shooting
                ? find_by_shooting(scene, transient.state.y, period)
                : find_by_harmonic_balance(call, scene, transient.state.y, period);
    if (!orbit.is_good()) status = 3;
  } else {
    orbit.failure = transient.diagnosis.empty() ? "stopped in the transient" : transient.diagnosis;
  }

  Report report{.record = begin_record(call, model), .failure = orbit.failure, .status = status};
  note_tables(call, model, report);
  MotionState on_it;
  on_it.y = orbit.states.front();
  Record floquet = Record::array(), exponents = Record::array();
  for (const Complex& m : orbit.multipliers) floquet.add(m);
  for (const Complex& rate : orbit.exponents) exponents.add(rate);
  Record& r = report.record;
  r.set("frame", "stationary").set("method", call.text("method"));
  r.set("period_revs", period).set("shortest_period_revs", orbit.shortest_period);
  r.set("residual", orbit.residual).set("steps", orbit.steps);
  r.set("floquet", floquet).set("exponents_1_s", exponents);
  Record modes = Record::array();
  for (const MultiplierMode& m : orbit.modes) {
    Record mode;
    mode.set("mode", m.mode > 0 ? Record(m.mode) : Record(nullptr)).set("mac", m.mac);
    modes.add(mode);
  }
  r.set("floquet_modes", modes);
  r.set("stable", orbit.is_good() ? Record(orbit.is_stable) : Record(nullptr));
  r.set("state", on_it.y);
  add_contacts(r, orbit.contacts, period);
  if (orbit.more) r.set("harmonic_balance", *orbit.more);
  add_reduction(r, scene);
  if (!orbit.failure.empty()) r.set("failure", orbit.failure);

  report.text = "Periodic orbit" + (model.title.empty() ? "" : ": " + model.title) + "\n\n" +
                reduction_text(scene, model);
  if (orbit.is_good()) {
    double impacts = 0.0;
    for (const ContactMeasure& c : orbit.contacts) impacts += c.impacts;
    report.text += fmt::format("  {} orbit of {} revolution{}, {:.0f}/{} impacts; {}\n",
                               orbit.is_stable ? "stable" : "unstable", period,
                               period == 1 ? "" : "s", impacts, period, orbit.summary);
    if (orbit.shortest_period != period) {
      report.text += fmt::format("  it repeats after {} already: --period {}\n",
                                 orbit.shortest_period, orbit.shortest_period);
    }
    report.text += "\n" + multipliers_table(orbit);
    if (!orbit.contacts.empty()) report.text += "\n" + contacts_table(orbit.contacts, period);
  }
  if (file) {
    write_end(*file, model, scene, on_it);
    if (orbit.is_good()) write_orbit(*file, scene, orbit);
  }
  commit(call, file.get(), report);
  return report;
}

}  // namespace

Verb orbit_verb() {
  return {
      .name = "orbit",
      .group = "Contact",
      .summary = "one periodic orbit, stable or not, with its Floquet multipliers",
      .example = "whirl orbit models/jeffcott_stator.toml --period 1",
      .options = {{"period", "N",
                   "revolutions after which it repeats; with --point those of its branch", "1"},
                  frame_option,
                  {"point", "N",
                   "begins at this point of the branches of --from, its value included"},
                  orbit_method_option,
                  harmonics_option,
                  {"verify", "", "how far harmonic balance is from shooting"},
                  {"starts", "N", "all orbits near so many random starts, unstable ones too"},
                  seed_option,
                  start_size_option,
                  {"discard", "N",
                   "revolutions before it, for the transient; with --from none, with --starts 10",
                   "500"},
                  tolerance_option,
                  from_option},
      .run = run_orbit,
  };
}

}  // namespace whirl
