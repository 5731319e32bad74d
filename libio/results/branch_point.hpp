#pragma once
/// A point of a branch in a result file, to begin an orbit from.

#include <filesystem>
#include <string>
#include <vector>

#include "libdyn/system/scene.hpp"

namespace whirl::inline io {

/// A point of /branch of a result file.
struct BranchStart {
  std::vector<std::string> sets;  ///< PATH=VALUE of the parameter there
  int period = 1;                 ///< of its branch [revolutions]
  Vec state;                      ///< reduced, at phase 0, in the basis of `first`
  Scene first;                    ///< scene at the first value of the branches

  /// The state in the basis of another scene.
  MotionState in(const Scene& scene) const;
};

/// A point, counted over all branches from 1.
/// @throws FileError   as open_result, and if the file holds no branches
/// @throws ModelError  if there is no such point
BranchStart read_branch_point(const std::filesystem::path& path, long number);

}  // namespace whirl::inline io
