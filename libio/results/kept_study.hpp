#pragma once
/// Studies whose file holds what is done at every moment: killed, they go on where they were.

#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
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
  /// Makes, likewise, the writer that keeps the study in memory when the study has run; may give
  /// none.
  StudyFile::Begin begin_kept{};
  std::function<void(long done, long total)> progress{};  ///< as of Monitor
  std::function<bool()> is_stopped{};                     ///< likewise
  const Ranks* ranks = nullptr;                           ///< likewise
  Stripe stripe{};  ///< of a study of points: the points that it computes
};

/// A study, and how its file has it.
template <class Study>
struct KeptStudy {
  std::function<void(ResultWriter&, const Study&)> write;
  /// Adds what an earlier run of the same study, or of a part of it, has left.
  std::function<void(Study&, const ResultReader&)> take;
  std::function<Study(Study begun, const Monitor<Study>&)> run;
  /// A point of the study as bytes, and back: new rows are kept beside the file while saving the
  /// whole study would take long. Left out: the whole study is saved each time.
  std::function<std::string(const Study&, std::size_t point)> pack{};
  std::function<void(Study&, std::size_t point, std::string_view bytes)> unpack{};
};

/// Runs a kept study, from what its file has already.
/// @param begun  what it begins with, before what the file has is added
/// @throws FileError  as StudyFile
template <class Study>
Study run_kept(const StudyKeeping& keeping, const KeptStudy<Study>& kept, Study begun = {}) {
  const Study* so_far = nullptr;
  StudyFile file(
      keeping.place, keeping.begin, [&](ResultWriter& to) { kept.write(to, *so_far); },
      [&](const ResultReader& earlier) { kept.take(begun, earlier); }, keeping.is_stopped);
  Monitor<Study> monitor{.progress = keeping.progress,
                         .is_stopped = keeping.is_stopped,
                         .save =
                             [&](const Study& study) {
                               so_far = &study;
                               file.save();
                             },
                         .ranks = keeping.ranks};
  if (kept.pack) {
    file.take_rows(
        [&](std::size_t point, std::string_view bytes) { kept.unpack(begun, point, bytes); });
    monitor.add = [&](const Study& study, std::span<const std::size_t> points) {
      so_far = &study;
      file.add(points, [&](std::size_t point) { return kept.pack(study, point); });
    };
  }
  Study study = kept.run(std::move(begun), monitor);
  file.finish();
  if (const auto to = keeping.begin_kept ? keeping.begin_kept() : nullptr) {
    write_start(*to, keeping.place);
    kept.write(*to, study);
  }
  return study;
}

/// Adds points that a file has.
/// @throws FileError  if it has other numbers of a point that is there already
template <class Result>
void unite(PointRows<study_columns::RowOf<Result>>& points, std::size_t size,
           const ResultReader& from) {
  points.resize(size);
  each_stored_row<Result>(from, size, [&](std::size_t i, const auto& row) {
    if (!points.has(i)) return points.set(i, row);
    if (points.bytes(i) == packed(row)) return;
    throw FileError(fmt::format("{} has other numbers of point {} than the files before",
                                from.path().string(), i + 1));
  });
}

/// A study of many points that has run, and what there is to say of all of them.
template <class Result>
struct StudyRun {
  Result result{};
  StudyOutcome outcome{};
};

/// Runs such a study.
/// @param size      how many points it has
/// @param study     called with what was there already and with a monitor
/// @param describe  names a point
template <class Result>
StudyRun<Result> run_study(const StudyKeeping& keeping, const StudyPoints& points, std::size_t size,
                           const std::function<Result(Result, const Monitor<Result>&)>& study,
                           const std::function<std::string(std::size_t)>& describe) {
  using Row = study_columns::RowOf<Result>;
  std::size_t resumed = 0;
  const KeptStudy<Result> kept{
      .write = [&](ResultWriter& to,
                   const Result& found) { write_study(to, points.axes(), found); },
      .take =
          [&](Result& begun, const ResultReader& from) {
            unite<Result>(begun.points, size, from);
            resumed = done_points(begun.points);
          },
      .run = study,
      .pack = [](const Result& so_far, std::size_t point) { return so_far.points.bytes(point); },
      .unpack =
          [&](Result& begun, std::size_t point, std::string_view bytes) {
            if (point >= size) return;
            begun.points.resize(size);
            resumed += begun.points.has(point) ? 0 : 1;
            Row row;
            unpack(bytes, row);
            begun.points.set(point, row);
          }};
  Result begun;
  if (!keeping.place.file.empty()) {
    begun.points.overflow_into(std::filesystem::absolute(keeping.place.file).parent_path());
  }
  Result result = run_kept(keeping, kept, std::move(begun));
  StudyOutcome outcome = study_outcome(result.points, resumed, describe, keeping.stripe);
  return {std::move(result), std::move(outcome)};
}

}  // namespace whirl::inline io
