#include "libverbs/verbs/identify_measured.hpp"

#include <fmt/format.h>

#include "libdata/measured/measured_identification.hpp"
#include "libdata/measured/station_motion.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/motion_results.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/texts/identification_text.hpp"
#include "libio/texts/running_modes_text.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/verbs/identify_machine.hpp"

namespace whirl::inline cli {

std::string mac_heading(const Model& model, const IdentifyOptions& options) {
  return fmt::format(
      "MAC of deflection shapes (rows) against complex modes at {}{} (columns: number, whirl, "
      "rpm)\n\n",
      shown_value(model.speed, "rpm", ".6g"),
      options.stiffened ? " with contacts closed"
      : options.reduced ? " of the reduced rotor"
                        : "");
}

namespace {

/// What the model says of 1X.
void add_model(const MeasuredVerbOptions& asked, const Model& model, const Assembler& assembler,
               const ProbeReadings& readings, const IdentifyOptions& options,
               MachineFindings& machine) {
  if (!machine.orders) {
    if (asked.model_curve) throw asked.model_curve.wrong("is for the orders that --orders names");
    return;
  }
  add_shapes(*machine.orders, model, readings.probes, options);
  if (asked.model_curve) {
    add_model_curve(*machine.orders, assembler, readings.probes, *asked.model_curve);
  }
}

}  // namespace

Report identify_measured(const Invocation& call, const MeasuredVerbOptions& asked,
                         const MachineVerbOptions& machine_asked,
                         const RunningModesVerbOptions& running_asked,
                         const IdentifyOptions& options) {
  const RecordSource source = source_of(call, asked.record);
  if (is_list_of_records(source)) {
    return trend_over_records(call, source, asked, machine_asked, running_asked);
  }
  const Measurement measurement = read_measurement(call.model(), source);
  const Model& model = measurement.model;
  const Scene scene = make_scene(model, ReductionEstimate::no);
  const MeasuredIdentification measured = identify(model, scene, measurement.readings, options);
  const ModesAtPoints modes({.oscillatory = measured.found.modes}, scene.system.dofs);
  MachineFindings machine = machine_findings(machine_asked, measurement.readings, model.speed);
  add_model(asked, model, scene.assembler, measurement.readings, options, machine);
  const std::optional<RunningModes> running =
      find_running_modes(running_asked, measurement, measured, scene.assembler);
  Report report = begin_report(call, model, record_of(measured));
  report.record.merge(record_of(measured.found)).merge(record_of(modes));
  report.text = headline("Measured motion", model) + "\n" + text_of(measured) + "\n" +
                mac_heading(model, options) +
                text_of(measured.found, model.speed, !measured.is_in_one_direction,
                        probe_told_like(measured)) +
                doubt_text(measured) + deflection_text(measured);
  machine.tell(report);
  if (running) {
    report.record.set("running", record_of(*running));
    report.text += "\n" + text_of(*running);
  }
  report.add_notes(measured.notes);
  note_model(call, model, report);
  report.add_notes(film_notes(model));
  write_file(call, model, report, [&](ResultWriter& file) {
    file.attribute("/", "speed", model.speed);
    write_points(file, model, scene.assembler);
    write_result(file, modes);
    write_result(file, measured.found);
    write_result(file, measured);
    machine.write(file);
    write_result(file, station_record(measurement.readings, scene.assembler));
    if (running) write_result(file, *running);
  });
  return report;
}

}  // namespace whirl::inline cli
