// Orbits near random starts: `whirl orbit --starts`.

#include "libdyn/studies/orbit_search.hpp"

#include <fmt/format.h>

#include "libbase/error.hpp"
#include "libdyn/motions/start.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/orbit_results.hpp"
#include "libio/texts/motion_notes.hpp"
#include "libio/texts/orbit_text.hpp"
#include "libverbs/verbs/orbit.hpp"

namespace whirl::inline cli {

namespace {

OrbitSearchOptions search_options(const OrbitVerbOptions& asked, int threads) {
  const auto refuse = [](bool is_given, const char* option) {
    if (is_given) throw ModelError({option}, "", "does not go with --starts");
  };
  refuse(asked.frame.is_given, "--frame");
  refuse(asked.how.method.is_given, "--method");
  refuse(asked.how.harmonics.is_given, "--harmonics");
  refuse(asked.verify, "--verify");
  refuse(asked.point.is_given, "--point");
  refuse(asked.from.is_given, "--from");
  OrbitSearchOptions options{
      .period = *asked.period, .starts = *asked.starts, .size = *asked.size, .seed = *asked.seed};
  if (asked.settled.discard.is_given) options.discard = *asked.settled.discard;
  options.threads = threads;
  if (options.size > 0.0) return options;
  throw asked.size.wrong("expected a number above 0");
}

}  // namespace

Report search_orbits(const Invocation& call, const OrbitVerbOptions& asked) {
  const OrbitSearchOptions options = search_options(asked, study_threads(call));
  const Model model = call.model();
  require_speed(model);
  const Scene scene = make_scene(model);
  const OrbitSearch search = search_orbits(scene, start_state(model, scene, nullptr), options,
                                           {.progress = progress_of(call, "starts"),
                                            .is_stopped = call.stop_asked(),
                                            .ranks = call.ranks});
  Report report =
      orbit_report(call, model,
                   fmt::format("Orbits of {} revolution{} from {} random starts", options.period,
                               options.period == 1 ? "" : "s", search.done));
  report.status = search.done < options.starts ? exit_status::stopped : exit_status::done;
  report.record.set("frame", "stationary").set("period_revs", options.period);
  report.record.merge(record_of(search));
  report.record.set("reduction", record_of(reduction_facts(scene)));
  report.text += "\n" + text_of(search);
  HardestTouches hardest;
  for (std::size_t i = 0; i < search.orbits.size(); ++i)
    hardest.add(i, search.orbits[i].orbit.contacts);
  report.add_notes(touch_notes(
      hardest, [&](std::size_t) { return model; },
      [](std::size_t i) { return fmt::format("orbit {}", i + 1); }));
  if (search.orbits.empty()) return report;
  write_file(call, model, report,
             [&](ResultWriter& to) { write_orbit(to, model, scene, search.orbits[0]); });
  return report;
}

}  // namespace whirl::inline cli
