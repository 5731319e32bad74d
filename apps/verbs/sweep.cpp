#include "libdyn/studies/sweep.hpp"

#include <fmt/format.h>

#include "apps/invocation.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "apps/verbs/options.hpp"
#include "apps/verbs/study.hpp"
#include "apps/verbs/sweep_text.hpp"

namespace whirl::inline cli {

namespace {

SweepOptions sweep_options(const Invocation& call, const StudySetup& setup) {
  SweepOptions options{.values = setup.axes()[0].values,
                       .start = call.has("fresh") ? SweepStart::fresh : SweepStart::carried,
                       .classify = setup.classify(),
                       .threads = setup.threads()};
  options.classify.sections = call.integer("sections");
  const StudyMember first = setup.first();
  options.portrait = {
      .stations = select_points(first.model, first.scene->assembler, call.text("stations")),
      .spectrum_revolutions = call.integer("spectra", 0)};
  return options;
}

Report run_sweep(const Invocation& call) {
  const StudySetup setup(call, 1, 1);
  const ParameterAxis& axis = setup.axes()[0];
  const StudyModels models = setup.models();
  const SweepOptions options = sweep_options(call, setup);
  const bool is_fresh = options.start == SweepStart::fresh;
  const std::size_t ways = is_fresh ? 1 : 2;
  const auto [result, resumed] =
      run_study<SweepResult>(call, setup, {"sweeping", ways * axis.values.size()},
                             [&](const auto& monitor, SweepResult earlier) {
                               return sweep(models, options, monitor, std::move(earlier));
                             });
  const StudyOutcome outcome =
      study_outcome(motions_of(result.points), resumed,
                    [&](std::size_t i) { return setup.describe(i % axis.values.size()); });

  Report report{.record = begin_record(call, setup.model()), .status = outcome.status};
  note_tables(call, setup.model(), report);
  Record& r = report.record;
  r.set("parameter", axis.path).set("unit", axis.unit).set("values", axis.values);
  r.set("up", sweep_entries({result, axis}));
  r.set("down", is_fresh ? Record::array() : sweep_entries({result, axis, 1}));
  r.set("resumed", static_cast<long>(resumed));
  const std::string& title = setup.model().title;
  report.text = "Sweep" + (title.empty() ? "" : ": " + title) + "\n";
  for (std::size_t way = 0; way < ways; ++way) {
    report.text += is_fresh   ? "\n  every value from the start of the model\n"
                   : way == 0 ? "\n  up\n"
                              : "\n  down\n";
    report.text += sweep_stretches({result, axis, way});
  }
  add_outcome(call, outcome, report);
  return report;
}

}  // namespace

Verb sweep_verb() {
  return {
      .name = "sweep",
      .group = "Contact",
      .summary = "bifurcation diagram and spectra along one parameter, up and down",
      .example =
          "whirl sweep models/jeffcott_stator.toml --over operation.speed=130:140:0.5rad/s --out "
          "sweep.h5",
      .options = study_options(
          {over_option,
           points_option,
           {"fresh", "", "every value from the model's start, not from the one before"},
           {"sections", "N", "Poincare sections kept of a motion", "64"},
           {"spectra", "N", "revolutions of a value's spectrum, 0: none", "32"},
           {"stations", "NAME,...",
            "of sections and spectra: names, node numbers, all; left out: contacts, disks, "
            "bearings"}}),
      .run = run_sweep,
  };
}

}  // namespace whirl::inline cli
