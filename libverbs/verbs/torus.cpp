#include "libio/results/columns.hpp"
#include "libio/results/kept_branches.hpp"
#include "libio/texts/motion_notes.hpp"
#include "libio/texts/torus_text.hpp"
#include "libverbs/options/orbits.hpp"

namespace whirl::inline cli {

namespace {

struct TorusVerbOptions {
  AlongVerbOptions along{
      .over = {"over", "PATH=A:B:STEP", "a value of the model along which the circle is followed"},
      .at = {"at", "VALUE",
             "where the first circle is looked for, between first and last; left out: first"}};
  Option<int> period{"period", "N", "revolutions of the map that it is a circle of", 1,
                     period_range};
  Option<int> harmonics{"harmonics", "N", "of the circle at first, doubled up to 64", 16,
                        Whole{1, 1000}};
  Option<long> revolutions{"revolutions", "N", "sections from which it is guessed", 1000,
                           Whole{200, 1'000'000}};
  Option<int> most{"most", "N", "circles at most", 200, Whole{1, 1'000'000}};
  SettledVerbOptions settled{};
  KeptVerbOptions kept{};
  auto fields() { return std::tie(along, period, harmonics, revolutions, most, settled, kept); }
};

TorusSetup asked_torus(const TorusVerbOptions& asked, const Model& model) {
  const TorusOptions options{.circle = {.period = *asked.period, .harmonics = *asked.harmonics},
                             .sections = *asked.revolutions,
                             .most_points = *asked.most};
  if (asked.along.over.values.empty()) return torus_setup(model, std::nullopt, options);
  return torus_setup(model, asked_parameters(asked.along, model), options);
}

Report run_torus(const Invocation& call, const TorusVerbOptions& asked) {
  const Model model = call.model();
  require_speed(model);
  const TorusSetup setup = asked_torus(asked, model);
  Report report = orbit_report(call, model, "Quasi-periodic motion");
  const auto settled = [&] {
    return settled_state(
        after_transient(call, asked.settled, asked.kept.from, setup.at_first, *setup.scene));
  };
  const auto [torus, resumed] =
      keep_torus(setup, study_keeping(call, model, asked.kept, "circles", report.notes), settled);
  if (torus.circle.points.size() == 0) {
    report.text.clear();
    report.failure = "stopped before the circle was found";
    report.status = exit_status::stopped;
    return report;
  }
  const TorusResult result = setup.result(torus);
  report.failure = result.failure;
  report.status = !result.is_good     ? exit_status::failed
                  : torus.is_complete ? exit_status::done
                                      : exit_status::stopped;
  report.record.merge(record_of(result));
  if (!torus.walks.empty()) report.record.set("resumed", resumed);
  report.text += "\n" + text_of(result);
  report.add_notes(motion_notes(setup.at_first, *setup.scene, {.y = torus.circle.points.col(0)},
                                noted_revolutions));
  if (result.is_good) add_kept(call, "circles", resumed, report);
  return report;
}

}  // namespace

Verb torus_verb() {
  return {
      .name = "torus",
      .group = "Contact",
      .summary =
          "a quasi-periodic motion as an invariant circle, and along a parameter until it locks or "
          "breaks",
      .example = "whirl torus models/two_disk_mac.toml --discard 1500 --harmonics 33",
      .run = run_torus,
  };
}

}  // namespace whirl::inline cli
