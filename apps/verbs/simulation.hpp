#pragma once
/// What the verbs share that integrate: options, where motions begin, and the run itself.

#include <optional>
#include <string>
#include <vector>

#include "apps/invocation.hpp"
#include "apps/verb.hpp"
#include "libdyn/motions/run_model.hpp"
#include "libio/model/model_file.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/motion_results.hpp"
#include "libio/texts/motion_text.hpp"

namespace whirl::inline cli {

/// Options of simulate and identify, behind those of one of them.
std::vector<OptionSpec> integration_options(std::vector<OptionSpec> own = {});

/// The start of a model's motions: with --from, where that result ended.
Start start_of(const Invocation& call, const Model& model);
/// Where that, or the model's [start], is the end of another result; nothing: it is not.
std::optional<EarlierEnd> earlier_start(const Invocation& call, const Model& model);
/// Where a motion begins.
MotionState starting_state(const Invocation& call, Model model, const Scene& scene);

/// Integrates a model as an invocation says.
/// @throws ModelError  as run_model
Run run_simulation(const Invocation& call, const Model& model);

/// Exit status of a run: 0, 3 (failed) or 130 (stopped by the user).
int status_of(Outcome outcome);

/// Report on a run under a headline: its record, its text, its notes and its status.
/// @param stations  station_summaries of the run
Report motion_report(const Invocation& call, const Model& model, const Run& run,
                     const std::vector<StationSummary>& stations, std::string_view what);

}  // namespace whirl::inline cli
