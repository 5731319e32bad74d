#include <optional>

#include "apps/invocation.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "apps/verbs/options.hpp"
#include "apps/verbs/orbit_text.hpp"
#include "apps/verbs/orbits.hpp"
#include "apps/verbs/simulation.hpp"
#include "libbase/error.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/results/orbit_results.hpp"

namespace whirl::inline cli {

namespace {

OrbitOptions orbit_options(const Invocation& call, const std::optional<BranchStart>& point) {
  OrbitOptions options{.method = orbit_method(call), .is_verified = call.has("verify")};
  options.period =
      point && !call.has("period") ? point->period : static_cast<int>(call.integer("period"));
  options.harmonics = harmonics_of(call, options.period);
  return options;
}

/// The orbit near where a motion has come; why there is none if that did not get there.
FoundOrbit orbit_after(const Trajectory& transient, const Scene& scene,
                       const OrbitOptions& options) {
  if (status_of(transient.outcome) == 0) return find_orbit_near(scene, transient.state.y, options);
  return {
      .period = options.period,
      .shortest_period = options.period,
      .states = {transient.state.y},
      .failure = transient.diagnosis.empty() ? "stopped in the transient" : transient.diagnosis};
}

Report stationary_orbit(const Invocation& call, const Model& model,
                        const std::optional<BranchStart>& point) {
  const OrbitOptions options = orbit_options(call, point);
  const auto file = call.result_file(model);
  const Scene scene = make_scene(model);
  // an unstable orbit is not to be left before it is looked for
  const Trajectory transient =
      point ? Trajectory{.system = &scene.contacts,
                         .state = {.y = BasisChange(scene, point->first).to(point->state)}}
            : after_transient(call, model, scene);
  const FoundOrbit orbit = orbit_after(transient, scene, options);
  const int status = status_of(transient.outcome);
  Report report{.record = begin_record(call, model),
                .failure = orbit.failure,
                .status = status == 0 && !orbit.is_good() ? 3 : status};
  note_tables(call, model, report);
  Record& r = report.record;
  r.set("frame", "stationary").set("method", call.text("method"));
  add_orbit(r, orbit);
  r.set("reduction", record_of(reduction_facts(scene)));
  if (!orbit.failure.empty()) r.set("failure", orbit.failure);
  report.text = "Periodic orbit" + (model.title.empty() ? "" : ": " + model.title) + "\n\n" +
                reduction_text(scene, model);
  if (orbit.is_good()) report.text += orbit_text(orbit);
  if (file) {
    MotionState on_it;
    on_it.y = orbit.states.front();
    write_end(*file, model, scene, on_it);
    if (orbit.is_good()) write_orbit(*file, scene, orbit);
  }
  commit(call, file.get(), report);
  return report;
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
  if (orbit_frame(call) == OrbitFrame::stationary) return stationary_orbit(call, model, point);
  if (point) throw ModelError({"--point"}, "", "expected an orbit of the stationary frame");
  if (method == OrbitMethod::shooting) return rotating_orbit(call, model);
  throw ModelError({"--frame rotating"}, "",
                   "harmonic balance finds orbits in the stationary frame only");
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

}  // namespace whirl::inline cli
