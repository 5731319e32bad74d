#pragma once
/// A point of a branch in a result file, to begin an orbit from.

#include <string>
#include <vector>

#include "libdyn/system/scene.hpp"

namespace whirl::inline io {

class ResultReader;

/// A point of /branch of a result file.
struct BranchStart {
  std::vector<std::string> sets;  ///< PATH=VALUE of the parameter there
  int period = 1;                 ///< of its branch [revolutions]
  Vec state;                      ///< reduced, at phase 0, in the basis of `first`
  Scene first;                    ///< scene at the first value of the branches
};

/// Points of all branches.
/// @throws FileError  if the file holds no branches
long count_branch_points(const ResultReader& file);

/// A point, counted over all branches from 1.
/// @param file  a result that was checked
BranchStart read_branch_point(const ResultReader& file, long number);

}  // namespace whirl::inline io
