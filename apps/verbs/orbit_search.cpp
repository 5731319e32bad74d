// Orbits near random starts: what `whirl orbit --starts` says.

#include "libdyn/studies/orbit_search.hpp"

#include <fmt/format.h>

#include "apps/progress.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "apps/verbs/orbit_text.hpp"
#include "apps/verbs/orbits.hpp"
#include "apps/verbs/simulation.hpp"
#include "libbase/error.hpp"
#include "libdyn/motions/start.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/text/table.hpp"

namespace whirl::inline cli {

namespace {

OrbitSearchOptions search_options(const Invocation& call) {
  for (const std::string option : {"frame", "method", "point", "from"}) {
    if (call.has(option)) throw ModelError({"--" + option}, "", "does not go with --starts");
  }
  OrbitSearchOptions options{.period = static_cast<int>(call.integer("period")),
                             .starts = call.integer("starts"),
                             .size = call.number("size", ""),
                             .seed = static_cast<std::uint64_t>(call.integer("seed"))};
  if (call.has("discard")) options.discard = call.integer("discard", 0);
  if (options.size > 0.0) return options;
  throw ModelError({"--size " + call.text("size")}, "", "expected a number above 0");
}

Record orbits_record(const OrbitSearch& search) {
  Record list = Record::array();
  for (const SearchedOrbit& s : search.orbits) {
    Record r;
    r.set("stable", s.orbit.is_stable()).set("period_revs", s.shortest_period);
    r.set("starts", s.starts).set("floquet", complex_list(s.orbit.multipliers));
    r.set("state", s.orbit.states[0]);
    r.merge(record_of(contact_shares(s.orbit.contacts, s.orbit.period)));
    list.add(r);
  }
  return list;
}

std::string orbits_table(const OrbitSearch& search) {
  Table table({"orbit", "", "repeats after", "impacts", "largest multiplier", "of starts"});
  int number = 0;
  for (const SearchedOrbit& s : search.orbits) {
    double impacts = 0.0;
    for (const ContactMeasure& c : s.orbit.contacts) impacts += c.impacts;
    const Complex m = s.orbit.multipliers(0);
    table.row({std::to_string(++number), s.orbit.is_stable() ? "stable" : "unstable",
               std::to_string(s.shortest_period), fmt::format("{:.0f}/{}", impacts, s.orbit.period),
               fmt::format("{:+.6f} {:+.6f} i", m.real(), m.imag()), std::to_string(s.starts)});
  }
  return table.text();
}

}  // namespace

Report search_orbits(const Invocation& call, const Model& model) {
  const OrbitSearchOptions options = search_options(call);
  const auto file = call.result_file(model);
  const Scene scene = make_scene(model);
  install_interrupt_handler();
  Progress progress("starts", options.starts, call.shows_progress);
  const OrbitSearch search = search_orbits(
      scene, start_state(model, scene, nullptr), options,
      {.progress = [&](long done, long) { progress.update(done); }, .is_stopped = is_interrupted});

  Report report{.record = begin_record(call, model),
                .status = search.done < options.starts ? 130 : 0};
  note_tables(call, model, report);
  Record& r = report.record;
  r.set("frame", "stationary").set("period_revs", options.period).set("starts", search.done);
  r.set("without_orbit", search.failed).set("orbits", orbits_record(search));
  r.set("reduction", record_of(reduction_facts(scene)));
  report.text = fmt::format("Orbits of {} revolution{} from {} random starts{}\n\n", options.period,
                            options.period == 1 ? "" : "s", search.done,
                            model.title.empty() ? "" : ": " + model.title);
  if (!search.orbits.empty()) report.text += orbits_table(search) + "\n";
  report.text += fmt::format("  {} starts led to none\n", search.failed);
  if (file && !search.orbits.empty()) {
    MotionState on_it;
    on_it.y = search.orbits[0].orbit.states[0];
    write_end(*file, model, scene, on_it);
  }
  commit(call, search.orbits.empty() ? nullptr : file.get(), report);
  return report;
}

}  // namespace whirl::inline cli
