// Orbits that repeat as seen from the rotor: `whirl orbit --frame rotating`.

#include "apps/verbs/orbits.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/orbit_results.hpp"
#include "libio/texts/orbit_text.hpp"

namespace whirl::inline cli {

Report rotating_orbit(const Invocation& call, const Model& model) {
  const auto scene = std::make_shared<const Scene>(make_scene(model));
  const FreeFlow flow = rotating_flow(scene);
  const auto state = settled_state(after_transient(call, model, *scene));
  if (!state) return {.record = begin_record(call, model), .failure = "stopped", .status = 130};
  const RotatingOrbit orbit = find_rotating_orbit(flow, *scene, state->y);
  Report report = orbit_report(call, model, "Periodic orbit in the rotating frame");
  report.failure = orbit.failure;
  report.status = orbit.is_good() ? 0 : 3;
  report.record.set("frame", "rotating").merge(record_of(orbit));
  report.record.set("reduction", record_of(reduction_facts(*scene)));
  report.text += "\n" + reduction_text(*scene, model) + text_of(orbit);
  write_file(call, model, report, [&](ResultWriter& to) { write_orbit(to, model, *scene, orbit); });
  return report;
}

}  // namespace whirl::inline cli
