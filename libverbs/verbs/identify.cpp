#include "libio/texts/identification_text.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/options/simulation.hpp"
#include "libverbs/verbs/identify_machine.hpp"
#include "libverbs/verbs/identify_measured.hpp"

namespace whirl::inline cli {

namespace {

struct IdentifyVerbOptions {
  Option<int> modes{"modes", "N", "how many modes to compare with", 8, mode_range};
  Flag rotations{"rotations", "let tilts count too, times the rotor's length"};
  Flag mass_weighted{"mass-weighted", "weight the MAC with the mass matrix"};
  Flag reduced{"reduced", "modes of the reduced rotor that the motion was computed with"};
  Flag stiffened{"stiffened", "modes of the rotor with its contacts closed for good"};
  MeasuredVerbOptions measured{};
  MachineVerbOptions machine{};
  RunningModesVerbOptions running{};
  IntegrationVerbOptions integration{};
  auto fields() {
    return std::tie(modes, rotations, mass_weighted, reduced, stiffened, measured, machine, running,
                    integration);
  }
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
  report.text += "\n" + mac_heading(model, options) + text_of(id, model.speed);
  if (!file) return;
  write_result(*file, modes);
  write_result(*file, id);
}

/// Options of motions that are simulated mean nothing for measured ones, and the other way round.
void require_one_source(IdentifyVerbOptions asked) {
  if (!asked.measured.record.measured) {
    const auto refuse = [](const auto& option) {
      if constexpr (requires { option.wrong(""); }) {
        if (option.is_given) throw option.wrong("is for a record: give it by --measured");
      }
    };
    for_each_option(asked.measured, refuse);
    for_each_option(asked.running, refuse);
    return;
  }
  for_each_option(asked.integration, [](const auto& option) {
    if constexpr (requires { option.wrong(""); }) {
      if (option.is_given) throw option.wrong("is for simulations, and --measured is given");
    }
  });
  for (const Flag& flag : {asked.rotations, asked.mass_weighted, asked.reduced}) {
    if (flag)
      throw flag.wrong("is for simulations: records are of probes, which read displacements only");
  }
}

Report run_identify(const Invocation& call, const IdentifyVerbOptions& asked) {
  require_one_source(asked);
  const IdentifyOptions options{.modes = *asked.modes,
                                .rotations = asked.rotations,
                                .mass_weighted = asked.mass_weighted,
                                .reduced = asked.reduced,
                                .stiffened = asked.stiffened};
  if (asked.reduced && asked.stiffened) {
    throw asked.reduced.wrong(
        "does not go with --stiffened: contacts are no part of the reduced rotor");
  }
  if (asked.measured.record.measured) {
    return identify_measured(call, asked.measured, asked.machine, asked.running, options);
  }
  const Model model = call.model();
  require_speed(model);
  const auto file = call.result_file(model);
  const auto tell = [&](const auto& motion, const Run& run) {
    Report report = motion_report(call, model, run, station_summaries(run), "Identification");
    if (file) write_run(*file, motion, model);
    add_identification(model, run, options, report, file.get());
    add_machine(model, run, asked.machine, report, file.get());
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
      .summary = "says which complex modes make up the motion, simulated or measured (MAC)",
      .example = "whirl identify models/two_disk_mac.toml --out run.h5",
      .run = run_identify,
  };
}

}  // namespace whirl::inline cli
