#pragma once
/// What the verbs share that compute many points (sweep, map, basins): points from axes, and work in
/// threads that fills a table and its file (study_file.hpp).

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/invocation.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/simulation.hpp"
#include "libdyn/studies/classify.hpp"
#include "libdyn/system/scene.hpp"
#include "libio/model/model_family.hpp"
#include "libio/results/checkpoint.hpp"
#include "libio/text/parameter_axis.hpp"

namespace whirl {

/// Options of all of them, behind those of one.
std::vector<OptionSpec> study_options(std::vector<OptionSpec> own);

/// A motion at one point of a study.
struct StudyPoint {
  std::unique_ptr<Model> model;
  std::shared_ptr<const Scene> scene;
  Subject subject;
  std::string failure;  ///< why there is no scene

  bool is_good() const { return failure.empty() && subject.found.is_good(); }
  /// Why it is not.
  const std::string& why() const { return failure.empty() ? subject.found.diagnosis : failure; }
};

/// Calls f with the motions of all good points together, such as settle and average take them.
void together(const std::vector<StudyPoint*>& points,
              const std::function<void(std::span<Subject>)>& f);

/// What a study knows before its first point.
class StudySetup {
 public:
  /// Reads the model, the options and, for --from, where the earlier motion ended.
  /// @param least, most  numbers of axes that are right
  /// @throws ModelError  for a wrong model, option or axis, also at the ends of the axes
  StudySetup(const Invocation& call, std::size_t least, std::size_t most);

  const Model& model() const { return model_; }
  const std::vector<ParameterAxis>& axes() const { return axes_; }
  const ClassifyOptions& options() const { return options_; }
  ClassifyOptions& options() { return options_; }
  int threads() const { return threads_; }
  const std::optional<EarlierEnd>& earlier() const { return earlier_; }
  std::size_t points() const;

  /// Model, scene and start of a point; numbers of points run fastest along the last axis.
  /// @param from  where the motion goes on from; null: from the model's start
  StudyPoint point(std::size_t number, const FullState* from = nullptr) const;

  /// A result file with the facts of the call and the axes in it, below a group.
  std::unique_ptr<ResultWriter> file(const Invocation& call, const std::string& group) const;
  /// Paths of the axes in it.
  std::vector<std::string> axis_paths(const std::string& group) const;

  /// "operation.speed = 136 rad/s, contact.ring.friction = 0.1" of a point.
  std::string describe(std::size_t number) const;
  /// Entries of the axes for JSON.
  Record axes_record() const;

 private:
  std::vector<double> values_at(const std::vector<std::size_t>& indices) const;
  std::vector<std::size_t> indices_of(std::size_t number) const;

  Model model_;
  std::vector<ParameterAxis> axes_;
  std::optional<ModelFamily> family_;  ///< set with the axes
  ClassifyOptions options_;
  int threads_ = 1;
  std::optional<EarlierEnd> earlier_;
};

/// Rows of some points: what a piece of work finds.
struct StudyRows {
  std::vector<std::pair<std::size_t, PointRow>> rows;
  std::string failure;   ///< of the first point that failed, where it is
  bool is_whole = true;  ///< false: it was interrupted and finds nothing
  double seconds = 0.0;  ///< that it took
};

/// How a study becomes pieces of work.
struct StudyWork {
  std::string label;  ///< for the progress
  /// Points that are computed together, one piece after the other; none: any points may be, in
  /// their order, and pieces are cut as time and threads ask for.
  std::vector<std::vector<std::size_t>> pieces{};
  std::size_t most_together = 0;  ///< points of such a piece at most
  /// Makes the work of a piece, in order and in one thread; none for pieces that are done.
  std::function<std::function<StudyRows()>(const std::vector<std::size_t>&)> prepare;
  int threads = 1;  ///< that do the work
};

/// Computes what is not done of a table, and keeps the file of --out up to date meanwhile: killed
/// at any moment, it goes on where it was.
/// @param start  where the motions begin, where that is the end of another result
/// @param begin  makes a file with everything in it but the table
/// @return  exit status 0, 3 (every point failed) or 130, and what is to be said
struct StudyOutcome {
  int status = 0;
  std::string failure;
  std::size_t resumed = 0;  ///< points that were there already
};
StudyOutcome run_study(const Invocation& call, const StudyWork& work, PointTable& table,
                       const std::optional<EarlierEnd>& start,
                       const std::function<std::unique_ptr<ResultWriter>()>& begin);

/// What was there already, what failed, where the result is, for people.
void add_outcome(const Invocation& call, const StudyOutcome& outcome, const PointTable& table,
                 Report& report);

}  // namespace whirl
