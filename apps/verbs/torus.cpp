#include "apps/invocation.hpp"
#include "apps/progress.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "apps/verbs/options.hpp"
#include "apps/verbs/orbits.hpp"
#include "apps/verbs/simulation.hpp"
#include "apps/verbs/study.hpp"
#include "apps/verbs/torus_text.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libio/results/torus_results.hpp"

namespace whirl::inline cli {

namespace {

TorusBranch followed_torus(const Invocation& call, const TorusCall& asked, const TorusBranch& begun,
                           const std::function<void(const TorusBranch&)>& save) {
  install_interrupt_handler();
  Progress progress("circles", asked.options.most_points, call.shows_progress);
  const FlowAt flow_at = [&](double value) {
    return flow_of(asked.parameters->scene(value), *asked.scene);
  };
  return follow_torus(flow_at, asked.scene->contacts.state_scale(), begun, asked.options,
                      {.progress = [&](long done, long) { progress.update(done); },
                       .is_stopped = is_interrupted,
                       .save = save});
}

Report run_torus(const Invocation& call) {
  const Model model = call.model();
  require_speed(model);
  const TorusCall asked = torus_call(call, model);
  Report report{.record = begin_record(call, model)};
  note_tables(call, model, report);
  TorusBranch torus;
  const TorusBranch* known = &torus;
  StudyFile file(
      study_place(call, model, earlier_start(call, model)),
      [&] {
        auto made = call.result_file(model);
        write_notes(*made, report);
        return made;
      },
      [&](ResultWriter& to) {
        MotionState on_it;
        on_it.y = known->circle.points.col(0);
        write_end(to, asked.at_first, *asked.scene, on_it);
        write_torus(to, *asked.scene, asked.axis(), *known);
      },
      [&](const ResultReader& earlier) {
        torus = read_torus(earlier, asked.scene->contacts.size());
      });
  const std::size_t resumed = torus.points().size();
  const bool is_begun = torus.circle.points.size() > 0;
  if (!is_begun) {
    const auto state = settled_state(call, asked.at_first, *asked.scene);
    if (!state) {
      report.failure = "stopped in the transient";
      report.status = 130;
      return report;
    }
    torus = find_torus(*asked.scene, *state, asked.options);
  }
  if (torus.circle.is_good()) {
    if (!is_begun) file.save();
    torus = followed_torus(call, asked, torus, [&](const TorusBranch& so_far) {
      known = &so_far;
      file.save();
    });
    known = &torus;
    if (!torus.is_complete) report.status = 130;
  } else {
    report.failure = failure_text(torus);
    report.status = 3;
  }

  say_torus(report, call, model, asked, torus, resumed);
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
