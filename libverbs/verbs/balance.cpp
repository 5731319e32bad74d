#include "libdyn/system/film_equilibrium.hpp"
#include "libio/measured/balancing_file.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/motion_results.hpp"
#include "libio/texts/balancing_text.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/command/verb.hpp"
#include "libverbs/options/common.hpp"

namespace whirl::inline cli {

namespace {

struct BalanceVerbOptions {
  Option<std::string> runs = file_option(
      "runs", "FILE.toml", "planes, probes and runs with trial weights; see docs/balancing.md");
  Option<BalancingCriterion> criterion{
      "criterion", "C", "what is made small: least-squares, or min-max, the largest reading",
      BalancingCriterion::least_squares};
  Option<CoefficientSource> coefficients{
      "coefficients", "C",
      "influence coefficients of the runs or of the model; left out: of the runs, if one of them "
      "has a weight"};
  Option<std::vector<double>> speeds{
      "speeds", "A:B:STEP",
      "where the model itself is balanced, such as 3000rpm or 0:8000:50rpm; left out: its speed",
      parse_speeds};
  Flag anyway{"anyway", "balance a rotor that looks as if it rubs, and say so in a note"};
  auto fields() { return std::tie(runs, criterion, coefficients, speeds, anyway); }
};

Report run_balance(const Invocation& call, const BalanceVerbOptions& options) {
  if (!options.runs) {
    throw ModelError({"--runs"}, "", "missing, expected a file with planes, probes and runs");
  }
  const Model model = call.model();
  BalancingAsked asked{.criterion = *options.criterion,
                       .coefficients = options.coefficients.value,
                       .accepts_nonlinear = options.anyway};
  if (options.speeds) asked.speeds = *options.speeds;
  if (!options.speeds && model.speed > 0.0) asked.speeds = {model.speed};
  const BalancingCase read = read_balancing_file(*options.runs, model, asked);
  const Balancing found = balance(read.input);
  Report report = begin_report(call, model, record_of(found));
  report.text = text_of(found);
  report.add_notes(read.notes);
  report.add_notes(found.notes);
  write_file(call, model, report, [&](ResultWriter& file) {
    write_points(file, model, Assembler(linear_structure(model)));
    write_result(file, found);
  });
  return report;
}

}  // namespace

Verb balance_verb() {
  return {
      .name = "balance",
      .group = "Linear rotordynamics",
      .summary = "correction weights by influence coefficients, of trial runs or of the model",
      .example = "whirl balance models/two_disk_mac.toml --runs balance.toml --coefficients model",
      .run = run_balance,
  };
}

}  // namespace whirl::inline cli
