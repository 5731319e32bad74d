#include "apps/verbs/options.hpp"
#include "apps/verbs/orbits.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/kept_branches.hpp"
#include "libio/texts/torus_text.hpp"

namespace whirl::inline cli {

namespace {

/// @throws ModelError  for options that are wrong
TorusSetup asked_torus(const Invocation& call, const Model& model) {
  const TorusOptions options{.circle = {.period = static_cast<int>(call.integer("period")),
                                        .harmonics = static_cast<int>(call.integer("harmonics"))},
                             .sections = call.integer("revolutions", 200),
                             .most_points = static_cast<int>(call.integer("most"))};
  if (call.over.empty()) return torus_setup(model, std::nullopt, options);
  return torus_setup(model, asked_parameters(call, model), options);
}

Report run_torus(const Invocation& call) {
  const Model model = call.model();
  require_speed(model);
  const TorusSetup asked = asked_torus(call, model);
  Report report = orbit_report(call, model, "Quasi-periodic motion");
  const auto settled = [&] {
    return settled_state(after_transient(call, asked.at_first, *asked.scene));
  };
  const auto [torus, resumed] = keep_torus(
      asked, study_keeping(call, model, earlier_start(call, model), "circles", report.notes),
      settled);
  if (torus.circle.points.size() == 0) {
    report.text.clear();
    report.failure = "stopped in the transient";
    report.status = 130;
    return report;
  }
  const TorusResult result = asked.result(torus);
  report.failure = result.failure;
  report.status = !result.is_good ? 3 : torus.is_complete ? 0 : 130;
  report.record.merge(record_of(result));
  if (!torus.walks.empty()) report.record.set("resumed", resumed);
  report.text += "\n" + text_of(result);
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
      .options = {{"over", "PATH=A:B:STEP",
                   "a value of the model along which the circle is followed"},
                  branch_points_option,
                  {"at", "VALUE",
                   "where the first circle is looked for, between first and last; left out: first"},
                  {"period", "N", "revolutions of the map that it is a circle of", "1"},
                  {"harmonics", "N", "of the circle at first, doubled up to 64", "16"},
                  {"revolutions", "N", "sections from which it is guessed", "1000"},
                  {"most", "N", "circles at most", "200"},
                  branch_discard_option,
                  tolerance_option,
                  from_option,
                  restart_option},
      .run = run_torus,
  };
}

}  // namespace whirl::inline cli
