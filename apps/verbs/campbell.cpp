#include "libfe/campbell.hpp"

#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/options.hpp"
#include "libio/results/columns.hpp"
#include "libio/texts/modes_text.hpp"

namespace whirl::inline cli {

namespace {

Report run_campbell(const Invocation& call) {
  const Model model = call.model();
  const std::vector<double> speeds = call.speeds(model);
  const Campbell diagram =
      campbell(Assembler(model.structure), speeds, static_cast<int>(call.integer("modes")));
  Report report = begin_report(call, model, record_of(diagram));
  report.text = text_of(diagram);
  report.add_notes(linear_notes(model, speeds));
  write_file(call, model, report, [&](ResultWriter& file) { write_result(file, diagram); });
  return report;
}

}  // namespace

Verb campbell_verb() {
  return {
      .name = "campbell",
      .group = "Linear rotordynamics",
      .summary = "modes followed over speeds, with the critical speeds",
      .example = "whirl campbell models/two_disk_mac.toml --speeds 0:8000:50rpm",
      .options = {{"modes", "N", "how many modes", "8"}, speeds_option},
      .run = run_campbell,
  };
}

}  // namespace whirl::inline cli
