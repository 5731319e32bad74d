#pragma once
/// A point of a branch that `continue` wrote, to begin an orbit from.

#include <string>
#include <vector>

#include "apps/invocation.hpp"
#include "libdyn/system/scene.hpp"

namespace whirl {

/// A point of /branch of a result file.
struct BranchStart {
  std::vector<std::string> sets;  ///< PATH=VALUE of the parameter there
  int period = 1;                 ///< of its branch [revolutions]
  Vec state;                      ///< reduced, at phase 0, in the basis of `first`
  Scene first;                    ///< scene at the first value of the branches
};

/// The point number --point of the file of --from, counted over all branches from 1.
/// @throws ModelError  if there is no such point
/// @throws FileError   if the file holds no branches
BranchStart branch_start(const Invocation& call);

}  // namespace whirl
