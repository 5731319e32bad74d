#include <algorithm>
#include <filesystem>

#include "libdyn/system/model_facts.hpp"
#include "libio/drawing/terminal_layout.hpp"
#include "libio/measured/law_file.hpp"
#include "libio/model/file_text.hpp"
#include "libio/model/fitted_laws.hpp"
#include "libio/model/model_doubts.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/motion_results.hpp"
#include "libio/text/terminal.hpp"
#include "libio/texts/problems_text.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/command/verb.hpp"

namespace whirl::inline cli {

namespace {

/// The rotor as wide as the terminal allows.
std::string drawn(const Model& model, const Assembler& assembler) {
  constexpr std::size_t most = 72, margin = 4;
  const std::size_t columns = terminal_columns();
  const std::size_t width = columns == 0 ? most : std::min(most, columns - margin);
  return draw_layout(model, assembler, static_cast<int>(width)) + "\n";
}

/// What the model says and few mean.
std::vector<Problem> doubts_of(const Invocation& call, const ModelFacts& facts,
                               const Model& model) {
  const std::string text = call.model_text.empty() ? file_text(call.file) : call.model_text;
  std::vector<Problem> doubts =
      model_doubts(text, call.file, call.sets,
                   NamedFiles(std::filesystem::path(call.file).parent_path()).with(law_table));
  for (const Problem& doubt : rest_doubts(facts, model)) doubts.push_back(doubt);
  return doubts;
}

Report run_check(const Invocation& call) {
  const Model model = call.model();
  const Assembler assembler(model.structure);
  const ModelFacts facts = model_facts(model, assembler);
  Report report = begin_report(call, model, record_of(facts));
  if (!model.films.empty()) report.record.set("oil_films", static_cast<long>(model.films.size()));
  if (const auto rolling = std::ssize(rolling_bearings(model.contacts)); rolling > 0) {
    report.record.set("rolling_bearings", static_cast<long>(rolling));
  }
  const SupportFits fitted = fitted_laws(model);
  if (!fitted.fits.empty()) {
    Record list = Record::array();
    for (const SupportFit& fit : fitted.fits) list.add(record_of(fit));
    report.record.set("support_fits", std::move(list));
  }
  report.text = shown_line(model.title.empty() ? call.file : model.title) + "\n\n";
  if (!model.structure.shaft.empty()) report.text += drawn(model, assembler);
  const std::vector<Problem> doubts = doubts_of(call, facts, model);
  report.record.set("warnings", record_of_problems(doubts));
  report.text += text_of(facts, model) + warnings_text(doubts);
  write_file(call, model, report, [&](ResultWriter& file) {
    write_points(file, model, assembler);
    if (!fitted.fits.empty()) write_result(file, fitted);
  });
  return report;
}

}  // namespace

Verb check_verb() {
  return {
      .name = "check",
      .group = "The model",
      .summary = "reads and checks a model, draws its layout",
      .example = "whirl check models/two_disk_mac.toml",
      .run = run_check,
  };
}

}  // namespace whirl::inline cli
