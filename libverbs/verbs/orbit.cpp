#include "libverbs/verbs/orbit.hpp"

#include "libbase/error.hpp"
#include "libio/results/branch_point.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/orbit_results.hpp"
#include "libio/texts/orbit_text.hpp"

namespace whirl::inline cli {

namespace {

OrbitOptions orbit_options(const OrbitVerbOptions& asked, const std::optional<BranchStart>& point) {
  const int period = point && !asked.period.is_given ? point->period : *asked.period;
  return {.method = *asked.how.method,
          .period = period,
          .harmonics = checked_harmonics(asked.how.harmonics, period),
          .is_verified = asked.verify};
}

const Vec& state_of(const FoundOrbit& orbit) {
  return orbit.state();
}
const Vec& state_of(const RotatingOrbit& orbit) {
  return orbit.state;
}

/// Report on an orbit, found or not, and its file.
/// @param asked  for its record
template <class Orbit>
Report orbit_found(const Invocation& call, const Model& model, const Scene& scene,
                   const Orbit& orbit, const std::string& what, const Record& asked) {
  Report report = orbit_report(call, model, what);
  report.failure = orbit.failure;
  report.status = orbit.is_good() ? exit_status::done : exit_status::failed;
  report.record.merge(asked).merge(record_of(orbit));
  report.record.set("reduction", record_of(reduction_facts(scene)));
  report.text += "\n" + reduction_text(scene, model) + text_of(orbit);
  std::optional<MotionLoads> loads;
  if (orbit.is_good()) loads = add_loads(report, model, scene, state_of(orbit), orbit.period);
  write_file(call, model, report, [&](ResultWriter& to) {
    write_orbit(to, model, scene, orbit);
    if (loads) write_result(to, *loads);
  });
  return report;
}

Report stationary_orbit(const Invocation& call, const OrbitVerbOptions& asked, const Model& model,
                        const std::optional<BranchStart>& point) {
  const OrbitOptions options = orbit_options(asked, point);
  const Scene scene = make_scene(model);
  // an unstable orbit is not to be left before it is looked for
  const Trajectory transient =
      point ? Trajectory{.system = &scene.contacts, .state = point->in(scene)}
            : after_transient(call, asked.settled, asked.from, model, scene);
  Report report =
      orbit_found(call, model, scene, find_orbit_after(transient, scene, options), "Periodic orbit",
                  Record().set("frame", "stationary").set("method", name_of(options.method)));
  if (transient.outcome != Outcome::reached_end) report.status = status_of(transient.outcome);
  return report;
}

/// An orbit that repeats as seen from the rotor, whose period is any.
Report rotating_orbit(const Invocation& call, const OrbitVerbOptions& asked, const Model& model,
                      const std::optional<BranchStart>& point) {
  const auto scene = std::make_shared<const Scene>(make_scene(model));
  const AutonomousFlow flow = rotating_flow(scene);
  const auto state =
      point ? std::optional(point->in(*scene))
            : settled_state(after_transient(call, asked.settled, asked.from, model, *scene));
  if (!state) {
    Report report = begin_report(call, model);
    report.failure = "stopped";
    report.status = exit_status::stopped;
    return report;
  }
  return orbit_found(call, model, *scene, find_rotating_orbit(flow, *scene, state->y),
                     "Periodic orbit in the rotating frame", Record().set("frame", "rotating"));
}

Report run_orbit(const Invocation& given, const OrbitVerbOptions& asked) {
  if (asked.starts) return search_orbits(given, asked);
  std::optional<BranchStart> point;
  Invocation call = given;
  if (asked.point) {
    if (!asked.from) {
      throw asked.point.wrong("of which branches? give the result of whirl continue with --from");
    }
    point = read_branch_point(*asked.from, *asked.point);
    call.sets.insert(call.sets.end(), point->sets.begin(), point->sets.end());
  }
  const Model model = call.model();
  require_speed(model);
  const OrbitMethod method = *asked.how.method;
  require_balance(method, asked.how.harmonics.is_given, "--harmonics");
  require_balance(method, asked.verify, "--verify");
  if (*asked.frame == OrbitFrame::stationary) {
    return stationary_orbit(call, asked, model, point);
  }
  if (method == OrbitMethod::shooting) return rotating_orbit(call, asked, model, point);
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
      .run = run_orbit,
      .shares_work = true,
      .shares_with = "starts",
  };
}

}  // namespace whirl::inline cli
