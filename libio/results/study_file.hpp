#pragma once
/// The file of a study, which at every moment holds what is done, and from which the same command
/// line goes on.

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "libdyn/motions/start.hpp"
#include "libio/results/call.hpp"
#include "libio/results/row_journal.hpp"

namespace whirl::inline io {

class ResultReader;
class ResultWriter;

/// Which study it is, and where its file is.
struct StudyPlace {
  std::string file{};  ///< empty: there is none
  /// Files of parts of the study, whose points the study has from the beginning.
  std::vector<std::string> joins{};
  bool restarts = false;  ///< whatever the file holds is replaced
  Call call{};
  std::string model{};                       ///< text of the model
  std::string version{};                     ///< of the program
  std::string start_file{};                  ///< result that the motions go on from; empty: none
  std::optional<EarlierEnd> start{};         ///< the end of that result
  std::chrono::milliseconds patience{2000};  ///< what a saving may take once the study is to stop
};

/// Writes where the motions of a study begin, if that is the end of another result.
void write_start(ResultWriter& file, const StudyPlace& place);

/// Holds at every moment what is done, and goes on with an earlier run of the same study. Without a
/// file it does nothing.
class StudyFile {
 public:
  /// Makes a file with the facts of the call in it.
  using Begin = std::function<std::unique_ptr<ResultWriter>()>;
  /// @param write  adds what is computed so far
  /// @param take   takes over what an earlier run has left in the file, unless the study restarts,
  ///               and what files of parts hold
  /// @param is_stopped  whether the study ends at once: a saving that takes long is given up then
  /// @throws FileError  if the file cannot be written or is of another study
  StudyFile(StudyPlace place, Begin begin, std::function<void(ResultWriter&)> write,
            const std::function<void(const ResultReader&)>& take,
            std::function<bool()> is_stopped = {});

  /// Calls f with the rows that an earlier run has left beside the file.
  /// @throws FileError
  void take_rows(const RowJournal::ReadRow& f);

  /// Keeps points that are new: beside the file while writing the whole file takes long, and now
  /// and then in the file.
  /// @param pack  gives the bytes of a point
  void add(std::span<const std::size_t> points,
           const std::function<std::string(std::size_t point)>& pack);

  /// Writes the whole file.
  void save();

  /// To be called when nothing more comes: removes what is beside the file, if the file has it all.
  void finish();

 private:
  using clock = std::chrono::steady_clock;
  std::string key() const;
  RowJournal& journal();
  bool is_dear() const;
  /// Whether to give up writing the whole file, as somebody waits for the end: the file has been
  /// written before, and what is new is beside it.
  /// @param since  when the writing was begun
  bool is_given_up(clock::time_point since) const;

  StudyPlace place_;
  double seconds_before_ = 0.0;  ///< that earlier runs have computed
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  Begin begin_;
  std::function<void(ResultWriter&)> write_;
  std::function<bool()> is_stopped_;
  std::optional<RowJournal> journal_{};
  bool is_current_ = false;         ///< the file has all that was added
  clock::duration cost_{};          ///< of writing the whole file, the last time
  clock::time_point next_whole_{};  ///< when to write it again, with a journal
};

}  // namespace whirl::inline io
