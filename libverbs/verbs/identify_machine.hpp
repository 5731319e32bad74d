#pragma once
/// What identify says of a machine in operation, beside modes: of simulations, and of lists of
/// records.

#include "libverbs/options/measured.hpp"
#include "libverbs/options/running_modes.hpp"

namespace whirl::inline cli {

/// What the probes of a simulated machine tell; without a motion, nothing.
void add_machine(const Model& model, const Run& run, MachineVerbOptions asked, Report& report,
                 ResultWriter* file);

/// The trend from record to record of a list; each record has its own speed and probes.
Report trend_over_records(const Invocation& call, const RecordSource& list,
                          const MeasuredVerbOptions& asked, const MachineVerbOptions& machine_asked,
                          const RunningModesVerbOptions& running_asked);

}  // namespace whirl::inline cli
