#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/progress.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "apps/verbs/orbits.hpp"
#include "apps/verbs/simulation.hpp"
#include "libbase/error.hpp"
#include "libdyn/motions/start.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libdyn/studies/basins.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/text/table.hpp"

namespace whirl {

namespace {

constexpr long default_discard = 10;  ///< revolutions that bring a start near something
constexpr double same = 1e-6;         ///< of states at phase 0, in scales

/// An orbit, and how many starts led there.
struct Found {
  PeriodicOrbit orbit;
  int starts = 1;
};

/// Whether two orbits are one, begun at any revolution of their period.
bool is_same(const PeriodicOrbit& a, const PeriodicOrbit& b, const Vec& scale) {
  return std::any_of(b.states.begin(), b.states.end(), [&](const Vec& y) {
    return (y - a.states[0]).cwiseQuotient(scale).lpNorm<Eigen::Infinity>() < same;
  });
}

}  // namespace

Report search_orbits(const Invocation& call, const Model& model) {
  for (const std::string option : {"frame", "method", "point", "from"}) {
    if (call.has(option)) throw ModelError({"--" + option}, "", "does not go with --starts");
  }
  const int period = static_cast<int>(call.integer("period"));
  const long starts = call.integer("starts"),
             discard = call.has("discard") ? call.integer("discard", 0) : default_discard;
  const auto seed = static_cast<std::uint64_t>(call.integer("seed"));
  const double size = call.number("size", "");
  if (!(size > 0.0))
    throw ModelError({"--size " + call.text("size")}, "", "expected a number above 0");
  const auto file = call.result_file(model);
  const Scene scene = make_scene(model);
  const MotionState around = start_state(model, scene, nullptr);
  const Flow flow = flow_of(scene.contacts);
  std::vector<Found> all;
  long failed = 0;
  install_interrupt_handler();
  Progress progress("starts", starts, call.shows_progress);
  long done = 0;
  for (; done < starts && !is_interrupted(); ++done) {
    progress.update(done);
    Trajectory t{
        .system = &scene.contacts,
        .state = random_start(scene.contacts, around, size, seed, static_cast<std::uint64_t>(done)),
        .revolutions = discard};
    if (discard > 0) integrate_single(t, {.tolerance = 1e-8});
    PeriodicOrbit orbit{.failure = t.diagnosis};
    if (t.outcome == Outcome::reached_end) orbit = find_orbit(flow, t.state.y, {.period = period});
    if (!orbit.is_good()) {
      ++failed;
      continue;
    }
    const auto known = std::find_if(all.begin(), all.end(), [&](const Found& f) {
      return is_same(orbit, f.orbit, flow.scale);
    });
    if (known != all.end()) {
      ++known->starts;
    } else {
      all.push_back({std::move(orbit), 1});
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Found& a, const Found& b) {
    return std::pair(a.orbit.is_stable(), a.starts) > std::pair(b.orbit.is_stable(), b.starts);
  });

  Report report{.record = begin_record(call, model), .status = done < starts ? 130 : 0};
  note_tables(call, model, report);
  Record list = Record::array();
  Table table({"orbit", "", "repeats after", "impacts", "largest multiplier", "of starts"});
  for (std::size_t i = 0; i < all.size(); ++i) {
    const PeriodicOrbit& o = all[i].orbit;
    Record r, floquet = Record::array();
    for (const Complex& m : o.multipliers) floquet.add(m);
    const int shortest = shortest_period(o, flow.scale);
    r.set("stable", o.is_stable()).set("period_revs", shortest).set("starts", all[i].starts);
    r.set("floquet", floquet).set("state", o.states[0]);
    add_contacts(r, o.contacts, period);
    list.add(r);
    double impacts = 0.0;
    for (const ContactMeasure& c : o.contacts) impacts += c.impacts;
    const Complex m = o.multipliers(0);
    table.row({std::to_string(i + 1), o.is_stable() ? "stable" : "unstable",
               std::to_string(shortest), fmt::format("{:.0f}/{}", impacts, period),
               fmt::format("{:+.6f} {:+.6f} i", m.real(), m.imag()),
               std::to_string(all[i].starts)});
  }
  report.record.set("frame", "stationary").set("period_revs", period);
  report.record.set("starts", done).set("without_orbit", failed).set("orbits", list);
  add_reduction(report.record, scene);
  report.text =
      fmt::format("Orbits of {} revolution{} from {} random starts{}\n\n", period,
                  period == 1 ? "" : "s", done, model.title.empty() ? "" : ": " + model.title) +
      (all.empty() ? "" : table.text() + "\n") + fmt::format("  {} starts led to none\n", failed);
  if (file && !all.empty()) {
    MotionState on_it;
    on_it.y = all[0].orbit.states[0];
    write_end(*file, model, scene, on_it);
  }
  commit(call, all.empty() ? nullptr : file.get(), report);
  return report;
}

}  // namespace whirl
