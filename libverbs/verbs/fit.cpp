#include "libverbs/options/fit.hpp"

#include <fmt/format.h>

#include "libio/measured/law_file.hpp"
#include "libio/measured/model_fit.hpp"
#include "libio/measured/record_values.hpp"
#include "libio/model/model_file.hpp"
#include "libio/results/columns.hpp"
#include "libio/text/parameter_axis.hpp"
#include "libio/texts/fit_text.hpp"
#include "libio/texts/motion_notes.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/command/verb.hpp"
#include "libverbs/options/study.hpp"

namespace whirl::inline cli {

namespace {

/// The models that are fitted, the call's own first.
std::vector<Model> models_of(const Invocation& call, const FitVerbOptions& asked) {
  std::vector<Model> models{call.model()};
  if (!asked.against) return models;
  for (const std::string& file : split(*asked.against, ',')) {
    models.push_back(read_model(file, call.sets, law_table));
  }
  return models;
}

MeasuredFitOptions fit_options(const Invocation& call, const FitVerbOptions& asked) {
  return {.noise = asked.noise.value,
          .period = asked.steady.value_or(0),
          .finds_offsets = asked.offsets,
          .runout_orders = asked.runout.value_or(0),
          .starts = *asked.starts,
          .seed = *asked.seed,
          .threads = study_threads(call),
          .search = {.is_stopped = call.stop_asked(), .progress = progress_of(call, "fitting")}};
}

Report run_fit(const Invocation& call, const FitVerbOptions& asked) {
  const auto missing = [](const char* option, const char* example) {
    return ModelError({option}, "", fmt::format("missing, expected {} {}", option, example));
  };
  if (!asked.record.measured) throw missing("--measured", "run.csv");
  if (!asked.free) throw missing("--free", "contact.ring.friction=0.05:0.4");
  const std::vector<Model> models = models_of(call, asked);
  const Model& model = models.front();
  const std::vector<FreeParameters> free = free_parameters(models, *asked.free);
  const std::vector<SourcedRecord> records = read_records(source_of(call, asked.record));
  const bool is_all = asked.steady && !asked.revolutions.is_given;
  const FitWindow window{.from = *asked.from, .revolutions = is_all ? 0.0 : *asked.revolutions};
  std::vector<std::string> names, notes;
  std::vector<MeasuredFit> fits;
  for (std::size_t i = 0; i < models.size(); ++i) {
    ModelFit fit = fit_model(models[i], free[i], records, window, fit_options(call, asked));
    if (i == 0) notes = motion_notes(fit.motions);
    fits.push_back(std::move(fit.found));
    names.push_back(models[i].path);
  }
  MeasuredFit& found = fits.front();
  if (fits.size() > 1) found.candidates = compared(fits, names);
  Report report = begin_report(call, model, record_of(found));
  report.text = headline("Fit to measured motions", model) + "\n" + text_of(found, model.path);
  report.add_notes(found.notes);
  report.add_notes(notes);
  if (!found.has_converged) {
    const bool is_stopped = call.stop_asked()();
    report.failure = is_stopped ? "stopped" : "the fit did not converge: " + found.why_not;
    report.status = is_stopped ? exit_status::stopped : exit_status::failed;
  }
  write_file(call, model, report, [&](ResultWriter& file) {
    if (!found.files.empty()) file.attribute("/", "speed", found.files.front().speed);
    write_result(file, found);
  });
  return report;
}

}  // namespace

Verb fit_verb() {
  return {
      .name = "fit",
      .group = "Contact",
      .summary = "finds values of the model in measured motions, and how sure they are",
      .example =
          "whirl fit models/two_disk_mac.toml --measured run.csv --probes probes.toml --free "
          "contact.ring.stiffness,contact.ring.friction=0:0.3 --out fit.h5",
      .run = run_fit,
  };
}

}  // namespace whirl::inline cli
