// Orbits that repeat as seen from the rotor: what `whirl orbit --frame rotating` says.

#include <fmt/format.h>

#include <algorithm>

#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "apps/verbs/orbit_text.hpp"
#include "apps/verbs/orbits.hpp"
#include "apps/verbs/simulation.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/results/orbit_results.hpp"
#include "libio/text/table.hpp"

namespace whirl::inline cli {

namespace {

long steps_of(const Cycle& cycle) {
  return std::max(1L, std::ssize(cycle.residuals)) - 1;
}

std::string cycle_text(const Cycle& cycle, double turns) {
  std::string text = fmt::format(
      "  {} orbit of {:.9g} revolutions, {:.6g} rpm seen from the rotor; residual {:.1e} length "
      "scales after {} steps of Newton's method\n\n",
      cycle.is_stable() ? "stable" : "unstable", turns, turn / cycle.period / rpm, cycle.residual,
      steps_of(cycle));
  Table table({"multiplier", "real", "imaginary", "size"});
  for (Eigen::Index i = 0; i < cycle.multipliers.size(); ++i) {
    const Complex m = cycle.multipliers(i);
    table.row({std::to_string(i + 1), fmt::format("{:+.8f}", m.real()),
               fmt::format("{:+.8f}", m.imag()), fmt::format("{:.8f}", std::abs(m))});
  }
  return text + table.text();
}

}  // namespace

Report rotating_orbit(const Invocation& call, const Model& model) {
  const auto file = call.result_file(model);
  const auto scene = std::make_shared<const Scene>(make_scene(model));
  const FreeFlow flow = rotating_flow(scene);
  const auto state = settled_state(call, model, *scene);
  if (!state) return {.record = begin_record(call, model), .failure = "stopped", .status = 130};
  const Cycle cycle = find_rotating_orbit(flow, *scene, state->y);
  const double turns = cycle.period / scene->contacts.period();
  Report report{.record = begin_record(call, model),
                .failure = cycle.failure,
                .status = cycle.is_good() ? 0 : 3};
  note_tables(call, model, report);
  MotionState on_it;
  on_it.y = cycle.state;
  Record& r = report.record;
  r.set("frame", "rotating").set("period_revs", turns).set("period_s", cycle.period);
  r.set("residual", cycle.residual).set("steps", steps_of(cycle));
  r.set("floquet", complex_list(cycle.multipliers));
  r.set("stable", cycle.is_good() ? Record(cycle.is_stable()) : Record(nullptr));
  r.set("state", on_it.y);
  r.set("reduction", record_of(reduction_facts(*scene)));
  if (!cycle.failure.empty()) r.set("failure", cycle.failure);
  report.text = "Periodic orbit in the rotating frame" +
                (model.title.empty() ? "" : ": " + model.title) + "\n\n" +
                reduction_text(*scene, model);
  if (cycle.is_good()) report.text += cycle_text(cycle, turns);
  if (file) {
    write_end(*file, model, *scene, on_it);
    if (cycle.is_good()) write_rotating_orbit(*file, *scene, cycle);
  }
  commit(call, file.get(), report);
  return report;
}

}  // namespace whirl::inline cli
