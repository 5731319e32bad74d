#include "libdyn/system/film_equilibrium.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/motion_results.hpp"
#include "libio/text/value_range.hpp"
#include "libio/texts/frequency_response_text.hpp"
#include "libio/texts/stability_text.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/command/verb.hpp"

namespace whirl::inline cli {

namespace {

struct FrfVerbOptions {
  Option<std::string> from{
      "from", "STATION:D,...",
      "forces: stations with a direction each, x, y, theta_x, theta_y, forward "
      "or backward; left out: all that have a name, along x and y"};
  Option<std::string> to{"to", "STATION:D,...",
                         "motions, likewise; left out: where the forces are"};
  Option<std::vector<double>> frequencies{
      "frequencies", "A:B:STEP", "such as 0:500:0.5Hz; left out: those of the lowest modes",
      parse_frequencies};
  auto fields() { return std::tie(from, to, frequencies); }
};

/// Ends of an option; what is wrong with them is told under its name.
std::vector<ResponseEnd> ends_of(const Option<std::string>& option, const Model& model,
                                 const Assembler& assembler) {
  try {
    return select_ends(model, assembler, option.value_or(""));
  } catch (const ModelError& error) {
    throw option.wrong(error.problems().front().message);
  }
}

Report run_frf(const Invocation& call, const FrfVerbOptions& options) {
  const Model model = call.model();
  const Assembler assembler(linear_structure(model));
  const std::vector<ResponseEnd> from = ends_of(options.from, model, assembler);
  const FrequencyResponse found = frequency_response(
      assembler, model.speed,
      options.frequencies ? *options.frequencies : usual_frequencies(assembler, model.speed), from,
      options.to ? ends_of(options.to, model, assembler) : from);
  Report report = begin_report(call, model, record_of(found));
  report.text = text_of(found);
  report.add_notes(unstable_notes(assembler, {model.speed}));
  report.add_notes(linear_notes(model, {model.speed}));
  write_file(call, model, report, [&](ResultWriter& file) {
    write_points(file, model, assembler);
    write_result(file, found);
  });
  return report;
}

}  // namespace

Verb frf_verb() {
  return {
      .name = "frf",
      .group = "Linear rotordynamics",
      .summary = "frequency responses between stations at a speed",
      .example =
          "whirl frf models/two_disk_mac.toml --speed 3000rpm --from 7:forward --to 7:forward",
      .run = run_frf,
  };
}

}  // namespace whirl::inline cli
