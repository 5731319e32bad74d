#pragma once
/// The file of a study, which holds what is done at every moment, and from which the same line goes on.

#include <functional>
#include <memory>
#include <optional>

#include "apps/invocation.hpp"
#include "apps/verbs/simulation.hpp"

namespace whirl::inline cli {

/// The file of --out of a study: it holds what is done at every moment, and an earlier run of the same
/// line is gone on with. Without --out it does nothing.
class StudyFile {
 public:
  /// Makes a file with everything in it but what is computed.
  using Begin = std::function<std::unique_ptr<ResultWriter>()>;
  /// @param start  where the motions begin, where that is the end of another result
  /// @param write  adds what is computed so far
  /// @param take   takes over what an earlier run has left; not called with --restart
  /// @throws FileError  if the file cannot be written or is of another study
  StudyFile(const Invocation& call, const std::optional<EarlierEnd>& start, Begin begin,
            std::function<void(ResultWriter&)> write,
            const std::function<void(const ResultReader&)>& take);

  void save();

 private:
  bool has_file_;
  Begin begin_;
  std::function<void(ResultWriter&)> write_;
};

/// Where --from or the model's [start] ends, if there is one; read once, before the first point.
std::optional<EarlierEnd> earlier_start(const Invocation& call, const Model& model);
/// Group /from of a result file: so that a study does not go on from another start.
void write_start(ResultWriter& file, const std::optional<EarlierEnd>& start);

}  // namespace whirl::inline cli
