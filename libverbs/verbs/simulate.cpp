#include "libverbs/command/reporting.hpp"
#include "libverbs/options/measured.hpp"
#include "libverbs/options/simulation.hpp"

namespace whirl::inline cli {

namespace {

struct SimulateVerbOptions {
  IntegrationVerbOptions integration{};
  RecordingVerbOptions recording{};
  auto fields() { return std::tie(integration, recording); }
};

Report run_simulate(const Invocation& call, const SimulateVerbOptions& options) {
  const Model model = call.model();
  require_speed(model);
  const auto setup = recording_setup(options.recording, model);
  const auto file = call.result_file(model);
  const Run run = run_simulation(call, model, options.integration);
  const std::vector<StationSummary> stations = station_summaries(run);
  Report report = motion_report(call, model, run, stations, "Simulation");
  report.record.set("stations", columns::record_value(stations, 1.0));
  if (file) write_run(*file, run, model);
  commit(call, file.get(), report);
  if (setup) write_recording(call, options.recording, *setup, run, report);
  return report;
}

}  // namespace

Verb simulate_verb() {
  return {
      .name = "simulate",
      .group = "Contact",
      .summary = "integrates in time, contacts and all",
      .example = "whirl simulate models/two_disk_mac.toml --speed 4430rpm --out run.h5",
      .run = run_simulate,
  };
}

}  // namespace whirl::inline cli
