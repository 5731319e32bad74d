#include "libio/results/columns.hpp"
#include "libio/results/motion_results.hpp"
#include "libio/texts/static_text.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/command/verb.hpp"

namespace whirl::inline cli {

namespace {

Report run_static(const Invocation& call) {
  const Model model = call.model();
  const Assembler assembler(model.structure);
  const StaticStudy study = static_study(model, assembler);
  Report report = begin_report(call, model, record_of(study));
  report.text = text_of(study);
  report.add_notes(left_out_notes(model, {model.speed}));
  write_file(call, model, report, [&](ResultWriter& file) {
    write_points(file, model, assembler);
    write_rest(file, study);
  });
  return report;
}

}  // namespace

Verb static_verb() {
  return {
      .name = "static",
      .group = "The model",
      .summary = "sag under gravity and constant forces, and bearing loads",
      .example = "whirl static models/two_disk_double_rub.toml",
      .run = run_static,
  };
}

}  // namespace whirl::inline cli
