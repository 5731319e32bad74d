#pragma once
/// How far a study is, by its file alone: nothing is computed, and no model is made.

#include <filesystem>
#include <optional>
#include <string>

#include "libbase/structs/column.hpp"

namespace whirl::inline io {

class ResultReader;
class ResultWriter;

/// What a study's file tells of how it is computed, root attributes beside those of its origin.
/// Times and machines are no part of a result: two files of one study differ in them.
struct StudyWork {
  double seconds = 0.0;  ///< that all runs of it have computed so far [s]
  std::string host{};    ///< machine of the last one
  int process = 0;       ///< number of the last one there
};

/// This process, on this machine.
StudyWork this_work(double seconds);
void write_work(ResultWriter& file, const StudyWork& work);
/// Reads what write_work wrote; nothing: the file is of an early version, or of no study.
std::optional<StudyWork> read_work(const ResultReader& file);

/// Whether no group says that something is left to be computed; the file of a part of a study
/// always says that something is left.
bool says_complete(const ResultReader& file);

/// How far a study is.
struct StudyStatus {
  std::string file{}, verb{};
  std::string saved{};              ///< when its file was written [UTC]
  long done = 0;                    ///< points that are computed
  std::optional<long> points{};     ///< of all; nothing: of branches, not known beforehand
  std::optional<long> failed{};     ///< of those that are done; nothing: not marked, as of branches
  bool is_complete = false;         ///< nothing is left to be computed
  std::optional<bool> is_running;   ///< nothing: not known, as it ran on another machine
  std::optional<double> rate{};     ///< points per second of all runs so far [1/s]
  std::optional<double> left{};     ///< at that rate [s]
  std::optional<StudyWork> work{};  ///< the last one

  static constexpr auto columns() {
    using S = StudyStatus;
    return ColumnList{column("file", &S::file, "", "result file"),
                      column("verb", &S::verb, "", "that computes it"),
                      column("done", &S::done, "", "points that are computed"),
                      column("points", &S::points, "", "of all"),
                      column("failed", &S::failed, "", "of those that are computed"),
                      column("complete", &S::is_complete, "", "nothing is left to be computed"),
                      column("is_running", &S::is_running, "", "null: nobody knows"),
                      column("rate_per_s", &S::rate, "", "points per second, of all runs"),
                      column("left_s", &S::left, "", "at that rate [s]"),
                      column("saved", &S::saved, "", "when its file was written [UTC]")};
  }
};

/// @throws FileError  as ResultReader, and for results of no study
StudyStatus study_status(const std::filesystem::path& file);

}  // namespace whirl::inline io
