#pragma once
/// What the verbs share that compute many points (sweep, map, basins): points from axes, the file of
/// --out, and what is said of all motions together.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/invocation.hpp"
#include "apps/progress.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/simulation.hpp"
#include "apps/verbs/study_file.hpp"
#include "libdyn/studies/monitor.hpp"
#include "libdyn/studies/parameter_grid.hpp"
#include "libdyn/studies/study_models.hpp"
#include "libio/model/model_family.hpp"
#include "libio/results/study_columns.hpp"
#include "libio/text/parameter_axis.hpp"

namespace whirl::inline cli {

/// Options of all of them, behind those of one.
std::vector<OptionSpec> study_options(std::vector<OptionSpec> own);

/// What a study knows before its first point.
class StudySetup {
 public:
  /// Reads the model, the options and, for --from, where the earlier motion ended.
  /// @param least, most  numbers of axes that are right
  /// @throws ModelError  for a wrong model, option or axis, also at the ends of the axes
  StudySetup(const Invocation& call, std::size_t least, std::size_t most);

  const Model& model() const { return model_; }
  const std::vector<ParameterAxis>& axes() const { return axes_; }
  const ParameterGrid& grid() const { return grid_; }
  const ClassifyOptions& classify() const { return classify_; }
  int threads() const { return threads_; }
  const std::optional<EarlierEnd>& earlier() const { return earlier_; }

  /// Models at the points; they live no longer than this.
  StudyModels models() const;
  /// The model at the first point.
  /// @throws NumericalError  that names the point, if it cannot be computed with
  StudyMember first() const;

  /// A result file with the facts of the call in it.
  std::unique_ptr<ResultWriter> file(const Invocation& call) const;
  /// "operation.speed = 136 rad/s, contact.ring.friction = 0.1" of a point.
  std::string describe(std::size_t point) const;
  /// Entries of the axes for JSON.
  Record axes_record() const;

 private:
  Model model_;
  std::vector<ParameterAxis> axes_;
  ParameterGrid grid_;
  std::optional<ModelFamily> family_;  ///< set with the axes
  ClassifyOptions classify_;
  int threads_ = 1;
  std::optional<EarlierEnd> earlier_;
};

/// What is said of all points of a study together.
struct StudyOutcome {
  int status = 0;           ///< 3: every point failed; 130: stopped
  std::string failure;      ///< how many points failed, and one of them
  std::size_t resumed = 0;  ///< points that were there already
  std::size_t done = 0, points = 0;
  long unsettled = 0;      ///< motions that have not settled
  long would_settle = 0;   ///< of these, with a longer transient
  long settles_after = 0;  ///< revolutions of transient after which these would have settled
};

/// @param motions   those of all points; null where none is known
/// @param describe  names a point
StudyOutcome study_outcome(const std::vector<const ClassifiedMotion*>& motions, std::size_t resumed,
                           const std::function<std::string(std::size_t)>& describe);

/// Adds what was there already, what has not settled, what failed, and where the result is.
void add_outcome(const Invocation& call, const StudyOutcome& outcome, Report& report);

/// The motions of a study's points; null where none is known.
template <class Row>
std::vector<const ClassifiedMotion*> motions_of(const PointRows<Row>& points) {
  std::vector<const ClassifiedMotion*> motions;
  for (const auto& p : points) motions.push_back(p ? &study_columns::motion_of(*p) : nullptr);
  return motions;
}

/// A study that has run.
template <class Result>
struct StudyRun {
  Result result;
  std::size_t resumed = 0;  ///< points that were there already
};

/// What is to be run: how its progress is called, and how many points it has.
struct StudyTask {
  std::string label;
  std::size_t points = 0;
};

/// Runs a study, and keeps the file of --out up to date meanwhile: killed at any moment, it goes on
/// where it was.
/// @param study  called with a monitor and with what was there already
template <class Result>
StudyRun<Result> run_study(const Invocation& call, const StudySetup& setup, const StudyTask& task,
                           const std::function<Result(const Monitor<Result>&, Result)>& study) {
  Result earlier;
  const Result* so_far = nullptr;
  StudyFile file(
      call, setup.earlier(), [&] { return setup.file(call); },
      [&](ResultWriter& to) { write_study(to, setup.axes(), *so_far); },
      [&](const ResultReader& from) { earlier = read_study<Result>(from, task.points); });
  const std::size_t resumed = done_points(earlier.points);
  install_interrupt_handler();
  Progress progress(task.label, static_cast<long>(task.points - resumed), call.shows_progress);
  const Monitor<Result> monitor{.progress = [&](long done, long) { progress.update(done); },
                                .is_stopped = is_interrupted,
                                .save =
                                    [&](const Result& result) {
                                      so_far = &result;
                                      file.save();
                                    }};
  return {study(monitor, std::move(earlier)), resumed};
}

}  // namespace whirl::inline cli
