#pragma once
/// What the verbs share that compute many points (sweep, map, basins): options, the file of --out,
/// and the report.

#include <functional>
#include <string>
#include <vector>

#include "apps/progress.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/simulation.hpp"
#include "libdyn/studies/monitor.hpp"
#include "libdyn/studies/study_outcome.hpp"
#include "libio/model/study_points.hpp"
#include "libio/results/study_columns.hpp"
#include "libio/results/study_file.hpp"

namespace whirl::inline cli {

/// Options of all of them, behind those of one.
std::vector<OptionSpec> study_options(std::vector<OptionSpec> own);

/// Points of a study from the model, --over and --from.
/// @param least, most  numbers of axes that are right
/// @throws ModelError  for a wrong model, option or axis, also at the ends of the axes
StudyPoints study_points(const Invocation& call, std::size_t least, std::size_t most);

ClassifyOptions study_classify(const Invocation& call);
int study_threads(const Invocation& call);

/// The study that a call asks for, and its file.
/// @param start  where its motions begin, where that is the end of another result
StudyPlace study_place(const Invocation& call, const Model& model, std::optional<EarlierEnd> start);

/// A study that has run, and what there is to say of all its points.
template <class Result>
struct StudyRun {
  Result result{};
  StudyOutcome outcome{};
};

/// Runs a study, and keeps the file of --out up to date meanwhile: killed at any moment, it goes on
/// where it was.
/// @param size      how many points it has
/// @param study     called with a monitor and with what was there already
/// @param describe  names a point
template <class Result>
StudyRun<Result> run_study(const Invocation& call, const StudyPoints& points,
                           const std::string& label, std::size_t size,
                           const std::function<Result(const Monitor<Result>&, Result)>& study,
                           const std::function<std::string(std::size_t)>& describe) {
  Result earlier;
  const Result* so_far = nullptr;
  StudyFile file(
      study_place(call, points.model(), points.earlier()),
      [&] { return call.result_file(points.model()); },
      [&](ResultWriter& to) { write_study(to, points.axes(), *so_far); },
      [&](const ResultReader& from) { earlier = read_study<Result>(from, size); });
  const std::size_t resumed = done_points(earlier.points);
  install_interrupt_handler();
  Result result = study({.progress = progress_of(call, label),
                         .is_stopped = is_interrupted,
                         .save =
                             [&](const Result& found) {
                               so_far = &found;
                               file.save();
                             }},
                        std::move(earlier));
  StudyOutcome outcome = study_outcome(motions_of(result.points), resumed, describe);
  return {std::move(result), std::move(outcome)};
}

/// Report on a study under a headline.
/// @param record, text  what is found at its points
Report study_report(const Invocation& call, const Model& model, const StudyOutcome& outcome,
                    const Record& record, const std::string& text);

}  // namespace whirl::inline cli
