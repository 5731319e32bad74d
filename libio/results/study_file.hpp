#pragma once
/// The file of a study, which holds what is done at every moment, and from which the same line goes on.

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "libdyn/motions/start.hpp"
#include "libio/results/call.hpp"

namespace whirl::inline io {

class ResultReader;
class ResultWriter;

/// Which study it is, and where its file is.
struct StudyPlace {
  std::string file{};     ///< empty: there is none
  bool restarts = false;  ///< whatever the file holds is replaced
  Call call{};
  std::string model{};                ///< text of the model
  std::string version{};              ///< of the program
  std::string start_file{};           ///< result that its motions go on from; empty: none
  std::optional<EarlierEnd> start{};  ///< the end of that
};

/// It holds what is done at every moment, and an earlier run of the same study is gone on with.
/// Without a file it does nothing.
class StudyFile {
 public:
  /// Makes a file with the facts of the call in it.
  using Begin = std::function<std::unique_ptr<ResultWriter>()>;
  /// @param write  adds what is computed so far
  /// @param take   takes over what an earlier run has left; not called if it restarts
  /// @throws FileError  if the file cannot be written or is of another study
  StudyFile(StudyPlace place, Begin begin, std::function<void(ResultWriter&)> write,
            const std::function<void(const ResultReader&)>& take);

  void save();

 private:
  StudyPlace place_;
  double seconds_before_ = 0.0;  ///< that earlier runs have computed
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  Begin begin_;
  std::function<void(ResultWriter&)> write_;
};

}  // namespace whirl::inline io
