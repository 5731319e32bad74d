#include <fmt/format.h>

#include "libdyn/system/film_equilibrium.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/motion_results.hpp"
#include "libio/texts/over_text.hpp"
#include "libio/texts/stability_text.hpp"
#include "libio/texts/unbalance_text.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/command/verb.hpp"
#include "libverbs/options/common.hpp"
#include "libverbs/options/over.hpp"

namespace whirl::inline cli {

namespace {

/// Speeds where none are given. A bent rotor on oil films, or one under forces, has no response at
/// rest, where films carry nothing.
std::vector<double> speeds_of(const Model& model) {
  std::vector<double> speeds = usual_speeds(model.speed);
  const Structure& s = model.structure;
  const bool is_loaded_at_rest = s.is_bent() || !s.forces.empty();
  if (has_linear_films(model) && is_loaded_at_rest) speeds.erase(speeds.begin());
  return speeds;
}

struct UnbalanceVerbOptions {
  Option<std::vector<double>> speeds = speeds_option();
  Option<std::string> stations{"stations", "NAME,...", "names, node numbers or all", "all"};
  AxesVerbOptions axes{};
  auto fields() { return std::tie(speeds, stations, axes); }
};

/// Whether the rotor is unstable at its operating speed with the first or last of the values.
std::vector<std::string> notes_at_ends(const LinearAxis& over) {
  std::vector<std::string> notes;
  const std::vector<double>& values = over.axis().values;
  for (const double value : {values.front(), values.back()}) {
    const Model model = over.model_at()(value);
    for (const std::string& note :
         unstable_notes(Assembler(linear_structure(model)), {model.speed})) {
      notes.push_back(
          fmt::format("at the {} value {}", value == values.back() ? "last" : "first", note));
    }
  }
  return notes;
}

Report run_response_over(const Invocation& call, const UnbalanceVerbOptions& options) {
  const LinearAxis over(call, options.axes);
  const UnbalanceOver found = unbalance_over(
      over.model_at(), over.axis().name(), over.axis().values,
      {.speeds = [&](const Model& m) { return options.speeds.value_or(speeds_of(m)); },
       .stations = options.stations.is_given ? *options.stations : ""});
  std::vector<std::string> notes = notes_of_unbalance_over(over.model());
  for (const std::string& note : notes_at_ends(over)) notes.push_back(note);
  return over_report(call, over, "Unbalance response over a value", found,
                     text_of(found, over.axis()), notes);
}

Report run_unbalance(const Invocation& call, const UnbalanceVerbOptions& options) {
  if (runs_over(options.axes)) return run_response_over(call, options);
  const Model model = call.model();
  const Assembler assembler(linear_structure(model));
  const UnbalanceStudy study =
      unbalance_study(model, assembler,
                      {.speeds = options.speeds.value_or(speeds_of(model)),
                       .has_given_speeds = options.speeds.is_given,
                       .stations = select_points(model, assembler, *options.stations)});
  Report report = begin_report(call, model, record_of(study));
  report.text = text_of(study, model);
  report.notes = notes_of(study);
  report.add_notes(unstable_notes(assembler, {study.speeds.back(), model.speed}));
  report.add_notes(linear_notes(model, study.speeds));
  write_file(call, model, report, [&](ResultWriter& file) {
    write_points(file, model, assembler);
    write_result(file, study);
  });
  return report;
}

}  // namespace

Verb unbalance_verb() {
  return {
      .name = "unbalance",
      .group = "Linear rotordynamics",
      .summary =
          "steady response to unbalance and forces over speeds, or over a value of the model",
      .example = "whirl unbalance models/two_disk_mac.toml --speeds 0:8000:10rpm",
      .run = run_unbalance,
  };
}

}  // namespace whirl::inline cli
