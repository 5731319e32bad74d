#pragma once
/// The file of a study, which holds what is done at every moment, and from which the same line goes
/// on.

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
  /// Files of parts of the study, whose points it has from the beginning.
  std::vector<std::string> joins{};
  bool restarts = false;  ///< whatever the file holds is replaced
  Call call{};
  std::string model{};                       ///< text of the model
  std::string version{};                     ///< of the program
  std::string start_file{};                  ///< result that its motions go on from; empty: none
  std::optional<EarlierEnd> start{};         ///< the end of that
  std::chrono::milliseconds patience{2000};  ///< what a saving may take once the study is to stop
};

/// Writes where the motions of a study begin, if that is the end of another result.
void write_start(ResultWriter& file, const StudyPlace& place);

/// It holds what is done at every moment, and an earlier run of the same study is gone on with.
/// Without a file it does nothing.
class StudyFile {
 public:
  /// Makes a file with the facts of the call in it.
  using Begin = std::function<std::unique_ptr<ResultWriter>()>;
  /// @param write  adds what is computed so far
  /// @param take   takes over what an earlier run has left; not called if it restarts
  /// @param is_stopped  whether the study ends at once: a saving that takes long is given up then
  /// @throws FileError  if the file cannot be written or is of another study
  StudyFile(StudyPlace place, Begin begin, std::function<void(ResultWriter&)> write,
            const std::function<void(const ResultReader&)>& take,
            std::function<bool()> is_stopped = {});

  /// Calls f with the rows that an earlier run has left beside the file.
  /// @throws FileError
  void take_rows(const RowJournal::ReadRow& f);

  /// Keeps points that are new: beside the file while writing all of it takes long, and in it now
  /// and then.
  /// @param pack  gives the bytes of a point
  void add(std::span<const std::size_t> points,
           const std::function<std::string(std::size_t point)>& pack);

  /// Writes the whole file.
  void save();

  /// Nothing more comes: what is beside the file and in it, too, is taken away.
  void finish();

 private:
  using clock = std::chrono::steady_clock;
  std::string key() const;
  RowJournal& journal();
  bool is_dear() const;
  /// Whether somebody waits for the end while the whole file is written, and need not: it has been
  /// written before, and what is new is beside it.
  /// @param since  when that was begun
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
  clock::time_point next_whole_{};  ///< when to do so again, with a journal
};

}  // namespace whirl::inline io
