#include "apps/invocation.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "apps/verbs/simulation.hpp"
#include "libio/results/hdf5.hpp"

namespace whirl::inline cli {

namespace {

Report run_simulate(const Invocation& call) {
  const Model model = call.model();
  const auto file = call.result_file(model);
  const Run run = run_simulation(call, model);

  Report report{.record = begin_record(call, model),
                .failure = run.simulation.integration.diagnosis,
                .status = status_of(run.simulation.integration.outcome)};
  note_tables(call, model, report);
  add_run(report.record, run);
  add_stations(report.record, run);
  report.text = "Simulation" + (model.title.empty() ? "" : ": " + model.title) + "\n\n" +
                run_text(run, model);
  if (file) write_run(*file, run, model);
  commit(call, file.get(), report);
  return report;
}

}  // namespace

Verb simulate_verb() {
  return {
      .name = "simulate",
      .group = "Contact",
      .summary = "integrates in time, contacts and all",
      .example = "whirl simulate models/two_disk_mac.toml --speed 4430rpm --out run.h5",
      .options = integration_options(),
      .run = run_simulate,
  };
}

}  // namespace whirl::inline cli
