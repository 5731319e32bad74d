#include "libverbs/verbs/identify_machine.hpp"

#include <filesystem>

#include "libdata/measured/run_readings.hpp"
#include "libverbs/command/reporting.hpp"

namespace whirl::inline cli {

void add_machine(const Model& model, const Run& run, MachineVerbOptions asked, Report& report,
                 ResultWriter* file) {
  bool is_asked = false;
  for_each_option(asked, [&](const auto& option) {
    if constexpr (requires { option.is_given; }) is_asked = is_asked || option.is_given;
  });
  if (!run.has_motion() || !is_asked) return;
  const MachineFindings found = machine_findings(asked, readings_of(model, run), model.speed);
  found.tell(report);
  if (file) found.write(*file);
}

Report trend_over_records(const Invocation& call, const RecordSource& list,
                          const MeasuredVerbOptions& asked, const MachineVerbOptions& machine_asked,
                          const RunningModesVerbOptions& running_asked) {
  if (!machine_asked.trend && !machine_asked.zones) {
    throw asked.record.measured.wrong("a list of records is for --trend or --zones");
  }
  if (machine_asked.orders) {
    throw machine_asked.orders.wrong("is of one record, and --measured names a list");
  }
  if (running_asked.running_modes) {
    throw running_asked.running_modes.wrong("is of one record, and --measured names a list");
  }
  if (asked.model_curve) throw asked.model_curve.wrong("is for the orders that --orders names");
  const Model model = call.model();
  std::vector<Trend> trends;
  std::vector<std::string> names, notes;
  for (const SourcedRecord& record : read_records(list)) {
    const std::string name = std::filesystem::path(record.source.file).filename().string();
    const Measurement m = measurement_of(model_for(model, record.source), record);
    trends.push_back(*machine_findings(machine_asked, m.readings, m.model.speed).trend);
    for (const std::string& note : m.readings.notes) notes.push_back(name + ": " + note);
    names.push_back(name);
  }
  MachineFindings found;
  found.trend = trend_of_records(trends, names);
  found.trend->alarm = machine_asked.alarm.value;
  found.trend->trip = machine_asked.trip.value;
  if (machine_asked.zones) found.zones = zones_of(*found.trend, *machine_asked.zones);
  Report report = begin_report(call, model);
  report.text = headline("Trend of records", model);
  found.tell(report);
  report.add_notes(notes);
  note_model(call, model, report);
  write_file(call, model, report, [&](ResultWriter& file) { found.write(file); });
  return report;
}

}  // namespace whirl::inline cli
