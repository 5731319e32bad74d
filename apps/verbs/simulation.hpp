#pragma once
/// What the verbs that integrate share: options, the run itself, its tables and its result group.

#include <memory>
#include <string>
#include <vector>

#include "apps/invocation.hpp"
#include "apps/verb.hpp"
#include "libdyn/motions/run_result.hpp"

namespace whirl::inline cli {

/// Options of simulate and identify, behind those of one of them.
std::vector<OptionSpec> integration_options(std::vector<OptionSpec> own = {});

/// @throws ModelError  for a model without an operating speed
void require_speed(const Model& model);
/// @throws ModelError  naming the option and its value, if a method is none of these, or if a
///                     tolerance is out of its range
void require_method(const std::string& method, const std::vector<std::string_view>& methods,
                    const std::string& option);
void require_tolerance(double tolerance, const std::string& option);

/// The end of an earlier result; a stopped one ends within a turn.
struct EarlierEnd {
  FullState state;
  double phase = 0.0;  ///< [rad]
};
/// @throws FileError, ModelError  if there is none in the file
EarlierEnd earlier_end(const std::string& path);

/// Where a motion begins: at the model's [start], or where the result of --from ended.
MotionState starting_state(const Invocation& call, Model model, const Scene& scene);

/// Integrates a model as an invocation says. @throws ModelError for a model without a speed
Run run_simulation(const Invocation& call, const Model& model);

/// Exit status of a run: 0, 3 (failed) or 130 (stopped by the user).
int status_of(Outcome outcome);

/// `contacts` entry: what contacts did over so many revolutions, and the same for people.
void add_contacts(Record& record, const std::vector<ContactMeasure>& contacts, long revolutions);
std::string contacts_table(const std::vector<ContactMeasure>& contacts, long revolutions);
/// `reduction` entry, and a line or two for people.
void add_reduction(Record& record, const Scene& scene);
std::string reduction_text(const Scene& scene, const Model& model);

/// `revolutions`, `contacts`, `cost`, `reduction` entries.
void add_run(Record& record, const Run& run);
/// `stations` entry with peaks in both frames.
void add_stations(Record& record, const Run& run);

/// What was integrated, how, at what cost, and what the contacts did, for people.
std::string run_text(const Run& run, const Model& model);

/// Speed, group /points, and where a motion ended, for --from, in group /trajectory.
void write_end(ResultWriter& file, const Model& model, const Scene& scene, const MotionState& end);

/// Groups /trajectory and /contacts, and /spectra of the stations.
void write_run(ResultWriter& file, const Run& run, const Model& model);

}  // namespace whirl::inline cli
