#include "libdyn/linear/sensitivity.hpp"

#include <optional>

#include "libdyn/linear/frequency_response.hpp"
#include "libdyn/linear/step_response.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/motion_results.hpp"
#include "libio/text/option_values.hpp"
#include "libio/text/value_range.hpp"
#include "libio/texts/sensitivity_text.hpp"
#include "libio/texts/stability_text.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/command/verb.hpp"

namespace whirl::inline cli {

namespace {

struct SensitivityVerbOptions {
  Option<std::vector<double>> frequencies{
      "frequencies", "A:B:STEP", "such as 1:500:0.5Hz; left out: those of the lowest modes",
      parse_frequencies};
  Option<double> steps{"steps", "T",
                       "step responses, too, of the reference and of a force, over a time such as "
                       "0.1s",
                       parse_duration};
  auto fields() { return std::tie(frequencies, steps); }
};

Report run_sensitivity(const Invocation& call, const SensitivityVerbOptions& options) {
  const Model model = call.model();
  const Assembler assembler(linear_structure(model));
  std::vector<double> frequencies =
      options.frequencies ? *options.frequencies : usual_frequencies(assembler, model.speed);
  std::erase_if(frequencies, [](double w) { return !(w > 0.0); });
  const Sensitivity found = loop_sensitivity(assembler, model.speed, frequencies);
  Report report = begin_report(call, model, record_of(found));
  report.text = text_of(found);
  std::optional<StepResponse> response;
  if (options.steps) {
    response = step_response(model, *options.steps);
    report.record.merge(record_of(*response));
    report.text += "\n" + text_of(*response);
  }
  report.add_notes(unstable_notes(assembler, {model.speed}));
  report.add_notes(linear_notes(model, {model.speed}));
  write_file(call, model, report, [&](ResultWriter& file) {
    write_points(file, model, assembler);
    write_result(file, found);
    if (response) write_result(file, *response);
  });
  return report;
}

}  // namespace

Verb sensitivity_verb() {
  return {
      .name = "sensitivity",
      .group = "Linear rotordynamics",
      .summary = "sensitivity of the control loops of magnetic bearings at a speed",
      .example = "whirl sensitivity models/magnetic_bearing.toml --speed 9000rpm",
      .run = run_sensitivity,
  };
}

}  // namespace whirl::inline cli
