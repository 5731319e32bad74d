#include "libfe/analyses/critical.hpp"

#include "libdyn/system/film_equilibrium.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/motion_results.hpp"
#include "libio/texts/modes_text.hpp"
#include "libio/texts/over_text.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/command/verb.hpp"
#include "libverbs/options/over.hpp"

namespace whirl::inline cli {

namespace {

Parsed<double> parse_order(std::string_view text) {
  const auto order = parse_as(text, "");
  if (!order || *order > 0.0) return order;
  return Parsed<double>::failed("expected a number above zero");
}

struct CriticalVerbOptions {
  Option<int> modes{"modes", "N", "how many critical speeds", 6, mode_range};
  Option<double> order{"order", "N", "excitation frequency over speed", 1.0, parse_order};
  AxesVerbOptions axes{};
  auto fields() { return std::tie(modes, order, axes); }
};

Report run_critical_over(const Invocation& call, const CriticalVerbOptions& options) {
  const LinearAxis over(call, options.axes);
  const CriticalOver found = critical_over(over.model_at(), over.axis().name(), over.axis().values,
                                           {.count = *options.modes, .order = *options.order});
  return over_report(call, over, "Critical speeds over a value", found,
                     text_of(found, over.axis()));
}

Report run_critical(const Invocation& call, const CriticalVerbOptions& options) {
  if (runs_over(options.axes)) return run_critical_over(call, options);
  const Model model = call.model();
  const Structure structure = linear_structure(model);
  const CriticalSpeeds found{
      critical_speeds_by_all(Assembler(structure),
                             {.count = *options.modes,
                              .order = *options.order,
                              .start = has_linear_films(model) ? model.speed : 0.0}),
      *options.order};
  Report report = begin_report(call, model, record_of(found));
  report.text = text_of(found);
  std::vector<double> speeds;
  for (const Critical& c : found.criticals) speeds.push_back(c.speed);
  if (speeds.empty()) speeds = {model.speed};
  report.add_notes(linear_notes(model, speeds));
  write_file(call, model, report,
             [&](ResultWriter& file) { write_criticals(file, structure, found); });
  return report;
}

}  // namespace

Verb critical_verb() {
  return {
      .name = "critical",
      .group = "Linear rotordynamics",
      .summary = "critical speeds, directly, at the model or over a value of it",
      .example = "whirl critical models/two_disk_mac.toml",
      .run = run_critical,
  };
}

}  // namespace whirl::inline cli
