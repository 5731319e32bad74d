#include "libfe/analyses/campbell.hpp"

#include <fmt/format.h>

#include "libdyn/system/film_equilibrium.hpp"
#include "libio/results/columns.hpp"
#include "libio/texts/modes_text.hpp"
#include "libio/texts/stability_text.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/command/verb.hpp"
#include "libverbs/options/common.hpp"

namespace whirl::inline cli {

namespace {

struct CampbellVerbOptions {
  Option<int> modes{
      "modes", "N",
      "how many of the lowest modes; where bearings change with speed all that are among "
      "them at any speed",
      8, mode_range};
  Option<std::vector<double>> speeds = speeds_option();
  auto fields() { return std::tie(modes, speeds); }
};

Report run_campbell(const Invocation& call, const CampbellVerbOptions& options) {
  const Model model = call.model();
  const std::vector<double> speeds = options.speeds.value_or(usual_speeds(model.speed));
  const Campbell diagram = campbell(Assembler(linear_structure(model)), speeds, *options.modes);
  Report report = begin_report(call, model, record_of(diagram));
  report.text = text_of(diagram);
  if (std::ssize(diagram.branches) > *options.modes) {
    report.text += fmt::format(
        "\n  Bearings change with speed: each mode that is among the {} lowest at any speed is one "
        "of these {}.\n",
        *options.modes, diagram.branches.size());
  }
  report.add_notes(unstable_notes(diagram));
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
      .run = run_campbell,
  };
}

}  // namespace whirl::inline cli
