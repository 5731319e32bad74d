#include "libverbs/options/simulation.hpp"

#include "libdyn/studies/travel.hpp"
#include "libio/texts/motion_notes.hpp"
#include "libverbs/command/reporting.hpp"

namespace whirl::inline cli {

Start start_of(const Option<std::string>& from, const Model& model) {
  Start start = model.start;
  if (!from) return start;
  start.from = StartFrom::file;
  start.file = *from;
  start.whirl.clear();  // it goes on as it was
  return start;
}

std::optional<EarlierEnd> earlier_start(const Option<std::string>& from, const Model& model,
                                        const Ranks* ranks) {
  const auto read = [&] { return earlier_end(start_of(from, model)); };
  if (!ranks) return read();
  const std::string bytes = ranks->share([&] { return packed(read()); });
  std::optional<EarlierEnd> end;
  unpack(bytes, end);
  return end;
}

MotionState starting_state(const Option<std::string>& from, Model model, const Scene& scene) {
  model.start = start_of(from, model);
  return start_state(model, scene, earlier_end(model.start));
}

Run run_simulation(const Invocation& call, const Model& model,
                   const IntegrationVerbOptions& options) {
  const RunOptions run{.simulation = {.revolutions = *options.revolutions,
                                      .discard = *options.discard,
                                      .samples = *options.samples,
                                      .integration = {.tolerance = *options.tolerance}},
                       .method = options.method.value_or(""),
                       .stations = options.stations.value_or(""),
                       .is_written = call.wants_result(),
                       .progress = progress_of(call, "simulating"),
                       .is_stopped = call.stop_asked()};
  Model started = model;
  started.start = start_of(options.from, model);
  return run_model(started, run, earlier_end(started.start));
}

int status_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::reached_end:
      return exit_status::done;
    case Outcome::stopped_by_observer:
      return exit_status::stopped;
    default:
      return exit_status::failed;
  }
}

Report motion_report(const Invocation& call, const Model& model, const Run& run,
                     const std::vector<StationSummary>& stations, std::string_view what) {
  const Integration& integration = run.simulation.integration;
  const RunSummary summary = run_summary(run);
  Report report = begin_report(call, model, record_of(summary));
  if (run.has_motion()) {
    report.record.set("clearances", columns::record_value(clearances_of(model, run), 1.0));
  }
  report.text = headline(what, model) + "\n" + text_of(run, model, summary, stations);
  report.failure = integration.failure;
  report.status = status_of(integration.outcome);
  note_model(call, model, report);
  report.add_notes(motion_notes(model, run));
  return report;
}

}  // namespace whirl::inline cli
