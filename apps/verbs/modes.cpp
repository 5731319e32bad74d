#include <fmt/format.h>

#include "apps/invocation.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "libio/results/columns.hpp"

namespace whirl::inline cli {

namespace {

Report run_modes(const Invocation& call) {
  const Model model = call.model();
  const Assembler assembler(model.structure);
  const System system = assembler.at(model.speed);
  const ModesAtPoints modes(complex_modes(system, static_cast<int>(call.integer("modes"))),
                            system.dofs);

  Report report{.record = begin_record(call, model)};
  report.record.merge(record_of(modes));
  report.text =
      fmt::format("Complex modes at {:.6g} rpm\n\n{}", model.speed / rpm, modes_table(modes));
  note_left_out(model, report);
  note_tables(model, model.speed, model.speed, report);
  if (const auto file = call.result_file(model)) {
    file->attribute("/", "speed", model.speed);
    write_points(*file, model, assembler);
    write_result(*file, modes);
    commit(call, file.get(), report);
  }
  return report;
}

}  // namespace

Verb modes_verb() {
  return {
      .name = "modes",
      .group = "Linear rotordynamics",
      .summary = "complex modes at a speed",
      .example = "whirl modes models/two_disk_mac.toml --speed 4430rpm",
      .options = {{"modes", "N", "how many modes", "8"}},
      .run = run_modes,
  };
}

}  // namespace whirl::inline cli
