#include "libfe/critical.hpp"

#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "libio/results/columns.hpp"
#include "libio/texts/modes_text.hpp"

namespace whirl::inline cli {

namespace {

CriticalOptions critical_options(const Invocation& call) {
  CriticalOptions options{.count = static_cast<int>(call.integer("modes")),
                          .order = call.number("order", "")};
  if (options.order > 0.0) return options;
  throw call.wrong("order", "expected a number above zero");
}

Report run_critical(const Invocation& call) {
  const Model model = call.model();
  const CriticalOptions options = critical_options(call);
  const CriticalSpeeds found{critical_speeds(Assembler(model.structure), options), options.order};
  Report report = begin_report(call, model, record_of(found));
  report.text = text_of(found);
  std::vector<double> speeds;
  for (const Critical& c : found.criticals) speeds.push_back(c.speed);
  if (speeds.empty()) speeds = {model.speed};
  report.add_notes(linear_notes(model, speeds));
  write_file(call, model, report, [&](ResultWriter& file) { write_result(file, found); });
  return report;
}

}  // namespace

Verb critical_verb() {
  return {
      .name = "critical",
      .group = "Linear rotordynamics",
      .summary = "critical speeds, directly",
      .example = "whirl critical models/two_disk_mac.toml",
      .options = {{"modes", "N", "how many critical speeds", "6"},
                  {"order", "N", "excitation frequency over speed", "1"}},
      .run = run_critical,
  };
}

}  // namespace whirl::inline cli
