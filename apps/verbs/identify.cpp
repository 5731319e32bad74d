#include <fmt/format.h>

#include "apps/verbs/common.hpp"
#include "apps/verbs/simulation.hpp"
#include "libio/texts/identification_text.hpp"

namespace whirl::inline cli {

namespace {

struct IdentifyVerbOptions {
  Option<int> modes{"modes", "N", "how many modes to compare with", 8};
  Flag rotations{"rotations", "let tilts count too, times the rotor's length"};
  Flag mass_weighted{"mass-weighted", "weight the MAC with the mass matrix"};
  Flag stiffened{"stiffened", "modes of the rotor with its contacts closed for good"};
  IntegrationVerbOptions integration{};
  auto fields() { return std::tie(modes, rotations, mass_weighted, stiffened, integration); }
};

/// What a motion is made of; without a motion, nothing.
void add_identification(const Model& model, const Run& run, const IdentifyOptions& options,
                        Report& report, ResultWriter* file) {
  Identification id;
  if (run.has_motion()) id = identify(model, run.scene, run.simulation.recording, options);
  const ModesAtPoints modes({.oscillatory = id.modes}, run.scene.system.dofs);
  report.record.merge(record_of(id)).merge(record_of(modes));
  report.add_notes(film_notes(model));
  if (!run.has_motion()) return;
  report.text += fmt::format(
      "\nMAC of deflection shapes (rows) against complex modes at {:.6g} rpm{} (columns: number, "
      "whirl, rpm)\n\n{}",
      model.speed / rpm, options.stiffened ? " with contacts closed" : "",
      text_of(id, model.speed));
  if (!file) return;
  write_result(*file, modes);
  write_result(*file, id);
}

Report run_identify(const Invocation& call, const IdentifyVerbOptions& asked) {
  const Model model = call.model();
  require_speed(model);
  const auto file = call.result_file(model);
  const IdentifyOptions options{.modes = *asked.modes,
                                .rotations = asked.rotations,
                                .mass_weighted = asked.mass_weighted,
                                .stiffened = asked.stiffened};
  const auto tell = [&](const auto& motion, const Run& run) {
    Report report = motion_report(call, model, run, station_summaries(run), "Identification");
    if (file) write_run(*file, motion, model);
    add_identification(model, run, options, report, file.get());
    commit(call, file.get(), report);
    return report;
  };
  if (!call.motion.empty()) {
    const auto& integration = asked.integration;
    const StoredRun stored = stored_run(call.motion, model, integration.stations.value_or(""),
                                        integration.method.value_or(""));
    return tell(stored, stored.run);
  }
  const Run run = run_simulation(call, model, asked.integration);
  return tell(run, run);
}

}  // namespace

Verb identify_verb() {
  return {
      .name = "identify",
      .alias = "modal-content",
      .group = "Contact",
      .summary = "says which complex modes make up the motion (MAC)",
      .example = "whirl identify models/two_disk_mac.toml --out run.h5",
      .run = run_identify,
  };
}

}  // namespace whirl::inline cli
