#include <fmt/format.h>

#include "apps/verbs/common.hpp"
#include "apps/verbs/measured.hpp"
#include "apps/verbs/running_modes.hpp"
#include "apps/verbs/simulation.hpp"
#include "libdyn/measured/measured_identification.hpp"
#include "libdyn/measured/station_motion.hpp"
#include "libio/texts/identification_text.hpp"
#include "libio/texts/running_modes_text.hpp"

namespace whirl::inline cli {

namespace {

struct IdentifyVerbOptions {
  Option<int> modes{"modes", "N", "how many modes to compare with", 8};
  Flag rotations{"rotations", "let tilts count too, times the rotor's length"};
  Flag mass_weighted{"mass-weighted", "weight the MAC with the mass matrix"};
  Flag stiffened{"stiffened", "modes of the rotor with its contacts closed for good"};
  MeasuredVerbOptions measured{};
  RunningModesVerbOptions running{};
  IntegrationVerbOptions integration{};
  auto fields() {
    return std::tie(modes, rotations, mass_weighted, stiffened, measured, running, integration);
  }
};

std::string mac_heading(const Model& model, const IdentifyOptions& options) {
  return fmt::format(
      "MAC of deflection shapes (rows) against complex modes at {:.6g} rpm{} (columns: number, "
      "whirl, rpm)\n\n",
      model.speed / rpm, options.stiffened ? " with contacts closed" : "");
}

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
  for (const Flag& flag : {asked.rotations, asked.mass_weighted}) {
    if (flag) throw flag.wrong("is for simulations: probes read displacements only");
  }
}

/// What a measured motion is made of.
Report identify_measured(const Invocation& call, const IdentifyVerbOptions& asked,
                         const IdentifyOptions& options) {
  const Measurement measurement =
      read_measurement(call.model(), source_of(call, asked.measured.record));
  const Model& model = measurement.model;
  const Scene scene = make_scene(model, ReductionEstimate::no);
  const MeasuredIdentification measured = identify(model, scene, measurement.readings, options);
  const ModesAtPoints modes({.oscillatory = measured.found.modes}, scene.system.dofs);
  const std::optional<OrderTracking> orders = tracked_orders(asked.measured, measurement.readings);
  const std::optional<RunningModes> running =
      find_running_modes(asked.running, measurement, measured, scene.assembler);
  Report report = begin_report(call, model, record_of(measured));
  report.record.merge(record_of(measured.found)).merge(record_of(modes));
  report.text = headline("Measured motion", model) + "\n" + text_of(measured) + "\n" +
                mac_heading(model, options) + text_of(measured.found, model.speed) +
                doubt_text(measured);
  if (orders) {
    report.record.set("orders", record_of(*orders));
    report.text += "\n" + text_of(*orders);
  }
  if (running) {
    report.record.set("running", record_of(*running));
    report.text += "\n" + text_of(*running);
  }
  report.add_notes(measured.notes);
  note_tables(call, model, report);
  report.add_notes(film_notes(model));
  write_file(call, model, report, [&](ResultWriter& file) {
    file.attribute("/", "speed", model.speed);
    write_points(file, model, scene.assembler);
    write_result(file, modes);
    write_result(file, measured.found);
    write_result(file, measured);
    if (orders) write_result(file, *orders);
    write_result(file, station_record(measurement.readings, scene.assembler));
    if (running) write_result(file, *running);
  });
  return report;
}

Report run_identify(const Invocation& call, const IdentifyVerbOptions& asked) {
  require_one_source(asked);
  const IdentifyOptions options{.modes = *asked.modes,
                                .rotations = asked.rotations,
                                .mass_weighted = asked.mass_weighted,
                                .stiffened = asked.stiffened};
  if (asked.measured.record.measured) return identify_measured(call, asked, options);
  const Model model = call.model();
  require_speed(model);
  const auto file = call.result_file(model);
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
      .summary = "says which complex modes make up the motion, simulated or measured (MAC)",
      .example = "whirl identify models/two_disk_mac.toml --out run.h5",
      .run = run_identify,
  };
}

}  // namespace whirl::inline cli
