#include "libverbs/verbs/identify_measured.hpp"

#include <fmt/format.h>

#include "libdata/measured/measured_identification.hpp"
#include "libdata/measured/station_motion.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/motion_results.hpp"
#include "libio/texts/identification_text.hpp"
#include "libio/texts/running_modes_text.hpp"
#include "libverbs/command/reporting.hpp"

namespace whirl::inline cli {

std::string mac_heading(const Model& model, const IdentifyOptions& options) {
  return fmt::format(
      "MAC of deflection shapes (rows) against complex modes at {:.6g} rpm{} (columns: number, "
      "whirl, rpm)\n\n",
      model.speed / rpm,
      options.stiffened ? " with contacts closed"
      : options.reduced ? " of the reduced rotor"
                        : "");
}

Report identify_measured(const Invocation& call, const MeasuredVerbOptions& asked,
                         const RunningModesVerbOptions& running_asked,
                         const IdentifyOptions& options) {
  const Measurement measurement = read_measurement(call.model(), source_of(call, asked.record));
  const Model& model = measurement.model;
  const Scene scene = make_scene(model, ReductionEstimate::no);
  const MeasuredIdentification measured = identify(model, scene, measurement.readings, options);
  const ModesAtPoints modes({.oscillatory = measured.found.modes}, scene.system.dofs);
  const std::optional<OrderTracking> orders = tracked_orders(asked, measurement.readings);
  const std::optional<RunningModes> running =
      find_running_modes(running_asked, measurement, measured, scene.assembler);
  Report report = begin_report(call, model, record_of(measured));
  report.record.merge(record_of(measured.found)).merge(record_of(modes));
  report.text = headline("Measured motion", model) + "\n" + text_of(measured) + "\n" +
                mac_heading(model, options) +
                text_of(measured.found, model.speed, !measured.is_in_one_direction,
                        probe_told_like(measured)) +
                doubt_text(measured) + deflection_text(measured);
  if (orders) {
    report.record.set("orders", record_of(*orders));
    report.text += "\n" + text_of(*orders);
  }
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
    if (orders) write_result(file, *orders);
    write_result(file, station_record(measurement.readings, scene.assembler));
    if (running) write_result(file, *running);
  });
  return report;
}

}  // namespace whirl::inline cli
