#include "libbase/error.hpp"
#include "libdyn/studies/resonance_study.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/motion_results.hpp"
#include "libio/texts/motion_notes.hpp"
#include "libio/texts/resonance_text.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/command/verb.hpp"
#include "libverbs/options/common.hpp"
#include "libverbs/options/study.hpp"

namespace whirl::inline cli {

namespace {

struct ResonancesVerbOptions {
  Option<int> modes{"modes", "N", "how many modes", 4, mode_range};
  Option<std::vector<double>> speeds = speeds_option();
  Option<int> largest{"largest", "N", "of p and q", 4, Whole{1, 100}};
  Flag confirm{"confirm", "look for bouncing motions near each of them"};
  Option<int> starts{"starts", "N", "of them at every speed that is tried", 16, start_range};
  Option<std::uint64_t> seed = seed_option();
  Option<std::string> isa = isa_option();
  auto fields() { return std::tie(modes, speeds, largest, confirm, starts, seed, isa); }
};

ResonanceOptions resonance_options(const ResonancesVerbOptions& asked, const Model& model,
                                   int threads) {
  if (asked.confirm && model.contacts.empty()) {
    throw ModelError({"--confirm"}, "", "expected a model with contacts to bounce in");
  }
  return {.speeds = asked.speeds.value_or(usual_speeds(model.speed)),
          .modes = *asked.modes,
          .largest = *asked.largest,
          .confirms = asked.confirm,
          .search = {.starts = *asked.starts, .seed = *asked.seed},
          .threads = threads};
}

Report run_resonances(const Invocation& call, const ResonancesVerbOptions& asked) {
  const Model model = call.model();
  const Assembler assembler(linear_structure(model));
  const ResonanceOptions options = resonance_options(asked, model, study_threads(call));
  const auto file = call.result_file(model);
  const ResonanceStudy study =
      resonance_study(model, assembler, options,
                      {.progress = progress_of(call, "looking for bouncing motions"),
                       .is_stopped = options.confirms ? call.stop_asked() : nullptr,
                       .ranks = call.ranks});
  Report report = begin_report(call, model, record_of(study));
  report.status = study.is_whole ? exit_status::done : exit_status::stopped;
  report.text = headline("Internal resonances seen from the rotor", model) + "\n" + text_of(study) +
                (study.is_whole ? "" : "\n  stopped\n");
  if (options.confirms) {
    report.add_notes(film_notes(model));
    report.add_notes(table_notes(model.structure, options.speeds));
    report.add_notes(motion_notes(model, study));
  } else {
    report.add_notes(linear_notes(model, options.speeds));
  }
  if (file) write_resonances(*file, model, assembler, study);
  commit(call, file.get(), report);
  return report;
}

}  // namespace

Verb resonances_verb() {
  return {
      .name = "resonances",
      .alias = "internal-resonances",
      .group = "Linear rotordynamics",
      .summary =
          "speeds at which two modes are in p:q resonance seen from the rotor, where it may bounce",
      .example = "whirl resonances models/two_disk_mac.toml --speeds 1000:8000:50rpm --confirm",
      .run = run_resonances,
      .shares_work = true,
      .shares_with = "confirm",
  };
}

}  // namespace whirl::inline cli
