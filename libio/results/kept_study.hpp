#pragma once
/// Studies whose file holds what is done at every moment: killed, they go on where they were.

#include <functional>
#include <string>
#include <utility>

#include "libdyn/studies/monitor.hpp"
#include "libdyn/studies/study_outcome.hpp"
#include "libio/model/study_points.hpp"
#include "libio/results/study_columns.hpp"
#include "libio/results/study_file.hpp"

namespace whirl::inline io {

/// Where a study is kept, and how it is followed.
struct StudyKeeping {
  StudyPlace place{};
  StudyFile::Begin begin{};  ///< makes its file, with the facts of the call
  std::function<void(long done, long total)> progress{};  ///< as of Monitor
  std::function<bool()> is_stopped{};                     ///< likewise
  const Ranks* ranks = nullptr;                           ///< likewise
};

/// A study, and how its file has it.
template <class Study>
struct KeptStudy {
  std::function<void(ResultWriter&, const Study&)> write;
  /// What an earlier run of the same study has left.
  std::function<Study(const ResultReader&)> read;
  std::function<Study(Study begun, const Monitor<Study>&)> run;
};

/// Runs it, from what its file has already.
/// @param begun  where there is no such file
/// @throws FileError  as StudyFile
template <class Study>
Study run_kept(const StudyKeeping& keeping, const KeptStudy<Study>& kept, Study begun = {}) {
  const Study* so_far = nullptr;
  StudyFile file(
      keeping.place, keeping.begin, [&](ResultWriter& to) { kept.write(to, *so_far); },
      [&](const ResultReader& earlier) { begun = kept.read(earlier); });
  return kept.run(std::move(begun), {.progress = keeping.progress,
                                     .is_stopped = keeping.is_stopped,
                                     .save =
                                         [&](const Study& study) {
                                           so_far = &study;
                                           file.save();
                                         },
                                     .ranks = keeping.ranks});
}

/// A study of many points that has run, and what there is to say of all of them.
template <class Result>
struct StudyRun {
  Result result{};
  StudyOutcome outcome{};
};

/// Runs one.
/// @param size      how many points it has
/// @param study     called with what was there already and with a monitor
/// @param describe  names a point
template <class Result>
StudyRun<Result> run_study(const StudyKeeping& keeping, const StudyPoints& points, std::size_t size,
                           const std::function<Result(Result, const Monitor<Result>&)>& study,
                           const std::function<std::string(std::size_t)>& describe) {
  std::size_t resumed = 0;
  const KeptStudy<Result> kept{
      .write = [&](ResultWriter& to,
                   const Result& found) { write_study(to, points.axes(), found); },
      .read =
          [&](const ResultReader& from) {
            Result earlier = read_study<Result>(from, size);
            resumed = done_points(earlier.points);
            return earlier;
          },
      .run = study};
  Result result = run_kept(keeping, kept);
  StudyOutcome outcome = study_outcome(motions_of(result.points), resumed, describe);
  return {std::move(result), std::move(outcome)};
}

}  // namespace whirl::inline io
