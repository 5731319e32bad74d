#pragma once
/// What the verbs share that integrate: options, where motions begin, and the run itself.

#include <optional>
#include <string>
#include <vector>

#include "libdyn/motions/run_model.hpp"
#include "libio/model/model_file.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/motion_results.hpp"
#include "libio/texts/motion_text.hpp"
#include "libverbs/command/invocation.hpp"
#include "libverbs/command/verb.hpp"
#include "libverbs/options/common.hpp"

namespace whirl::inline cli {

/// Options of simulate, and of identify behind its own.
struct IntegrationVerbOptions {
  Option<long> revolutions{"revolutions", "N", "revolutions that are recorded", 512,
                           revolution_range};
  Option<long> discard = discard_option();
  Option<int> samples{"samples", "N", "samples per revolution", 64, Whole{4, 100'000}};
  Option<std::string> method{
      "method", "M",
      "integrator: taylor, collocation (left out: the better of these), dop853, cvode-adams, "
      "cvode-bdf, arkode, arkode-dirk, rk4",
      [](const std::string& name) {
        return name.empty() ? Parsed(name) : parse_method(name, method_names());
      }};
  Option<double> tolerance = tolerance_option();
  Option<std::string> isa = isa_option();
  Option<std::string> from = from_option();
  Option<std::string> stations{
      "stations", "NAME,...",
      "what is recorded and shown: names, node numbers, all; left out: contacts, disks, bearings"};
  auto fields() {
    return std::tie(revolutions, discard, samples, method, tolerance, isa, from, stations);
  }
};

/// The start of a model's motions.
/// @param from  the result where the motions go on, if there is one
Start start_of(const Option<std::string>& from, const Model& model);
/// The end of the result that --from or the model's [start] names; nothing: neither names one.
/// @param ranks  that share the work: their leader reads it; null: there are none
std::optional<EarlierEnd> earlier_start(const Option<std::string>& from, const Model& model,
                                        const Ranks* ranks);
/// Where a motion begins.
MotionState starting_state(const Option<std::string>& from, Model model, const Scene& scene);

/// Integrates a model.
/// @throws ModelError  as run_model
Run run_simulation(const Invocation& call, const Model& model,
                   const IntegrationVerbOptions& options);

/// Exit status of a run.
int status_of(Outcome outcome);

/// Report on a run under a headline: its record, its text, its notes and its status.
/// @param stations  station_summaries of the run
Report motion_report(const Invocation& call, const Model& model, const Run& run,
                     const std::vector<StationSummary>& stations, std::string_view what);

}  // namespace whirl::inline cli
