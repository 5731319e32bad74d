#include <fmt/format.h>

#include "libdyn/system/film_equilibrium.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/motion_results.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/texts/modes_text.hpp"
#include "libio/texts/over_text.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/command/verb.hpp"
#include "libverbs/options/over.hpp"

namespace whirl::inline cli {

namespace {

struct ModesVerbOptions {
  Option<int> modes{"modes", "N", "how many modes", 8, mode_range};
  Flag unproven{"unproven", "without the proof that none is missed: half the time of large rotors"};
  AxesVerbOptions axes{};
  auto fields() { return std::tie(modes, unproven, axes); }
};

Report run_modes_over(const Invocation& call, const ModesVerbOptions& options) {
  const LinearAxis over(call, options.axes);
  const ModesOver found =
      modes_over(over.model_at(), over.axis().name(), over.axis().values, *options.modes);
  return over_report(call, over, "Complex modes over a value", found, text_of(found, over.axis()));
}

Report run_modes(const Invocation& call, const ModesVerbOptions& options) {
  if (runs_over(options.axes)) {
    if (options.unproven) throw options.unproven.wrong("does not go with --over");
    return run_modes_over(call, options);
  }
  const Model model = call.model();
  const Assembler assembler(linear_structure(model));
  const auto completeness = options.unproven ? Completeness::unproven : Completeness::proven;
  const ModesAtPoints modes(complex_modes(assembler, model.speed, *options.modes, completeness),
                            assembler.at(model.speed).dofs);
  Report report = begin_report(call, model, record_of(modes));
  report.text = fmt::format("Complex modes at {}\n\n{}", shown_value(model.speed, "rpm", ".6g"),
                            text_of(modes));
  report.add_notes(linear_notes(model, {model.speed}));
  if (!modes.is_proven())
    report.add_notes({"a mode may be missing: --unproven leaves the proof out"});
  write_file(call, model, report, [&](ResultWriter& file) {
    file.attribute("/", "speed", model.speed);
    write_points(file, model, assembler);
    write_result(file, modes);
  });
  return report;
}

}  // namespace

Verb modes_verb() {
  return {
      .name = "modes",
      .group = "Linear rotordynamics",
      .summary = "complex modes at a speed, or over a value of the model",
      .example = "whirl modes models/two_disk_mac.toml --speed 4430rpm",
      .run = run_modes,
  };
}

}  // namespace whirl::inline cli
