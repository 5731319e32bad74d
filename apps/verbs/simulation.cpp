#include "apps/verbs/simulation.hpp"

#include "apps/verbs/common.hpp"
#include "apps/verbs/options.hpp"
#include "libio/text/interrupt.hpp"

namespace whirl::inline cli {

std::vector<OptionSpec> integration_options(std::vector<OptionSpec> own) {
  const std::vector<OptionSpec> shared{
      {"revolutions", "N", "revolutions that are recorded", "512"},
      discard_option,
      {"samples", "N", "samples per revolution", "64"},
      {"method", "M",
       "integrator: taylor, collocation (left out: the better of these), dop853, cvode-adams, "
       "cvode-bdf, arkode, arkode-dirk, rk4"},
      tolerance_option,
      from_option,
      {"stations", "NAME,...",
       "what is recorded and shown: names, node numbers, all; left out: contacts, disks, "
       "bearings"}};
  own.insert(own.end(), shared.begin(), shared.end());
  return own;
}

Start start_of(const Invocation& call, const Model& model) {
  Start start = model.start;
  if (!call.has("from")) return start;
  start.from = StartFrom::file;
  start.file = call.given.at("from");
  start.whirl.clear();  // it goes on as it was
  return start;
}

std::optional<EarlierEnd> earlier_start(const Invocation& call, const Model& model) {
  return earlier_end(start_of(call, model));
}

MotionState starting_state(const Invocation& call, Model model, const Scene& scene) {
  model.start = start_of(call, model);
  return start_state(model, scene, earlier_end(model.start));
}

Run run_simulation(const Invocation& call, const Model& model) {
  const auto method = [](const std::string& name) { return parse_method(name, method_names()); };
  const RunOptions options{
      .simulation = {.revolutions = call.integer("revolutions"),
                     .discard = call.integer("discard", 0),
                     .samples = static_cast<int>(call.integer("samples", 4)),
                     .integration = {.tolerance = call.parsed("tolerance", parse_tolerance)}},
      .method = call.text("method").empty() ? "" : call.parsed("method", method),
      .stations = call.text("stations"),
      .is_written = call.has("out"),
      .progress = progress_of(call, "simulating"),
      .is_stopped = is_interrupted};
  Model started = model;
  started.start = start_of(call, model);
  install_interrupt_handler();
  return run_model(started, options, earlier_end(started.start));
}

int status_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::reached_end:
      return 0;
    case Outcome::stopped_by_observer:
      return 130;
    default:
      return 3;
  }
}

Report motion_report(const Invocation& call, const Model& model, const Run& run,
                     const std::vector<StationSummary>& stations, std::string_view what) {
  const Integration& integration = run.simulation.integration;
  const RunSummary summary = run_summary(run);
  Report report = begin_report(call, model, record_of(summary));
  report.text = headline(what, model) + "\n" + text_of(run, model, summary, stations);
  report.failure = integration.failure;
  report.status = status_of(integration.outcome);
  note_tables(call, model, report);
  return report;
}

}  // namespace whirl::inline cli
