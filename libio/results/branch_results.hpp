#pragma once
/// Branches of periodic orbits in a result file.

#include <string>
#include <vector>

#include "libdyn/studies/branch_tree.hpp"

namespace whirl::inline io {

class ResultReader;
class ResultWriter;

/// What a file says of branches beside their numbers.
struct BranchNames {
  std::string path, unit;             ///< of the parameter
  std::vector<std::string> stations;  ///< that their amplitudes are of
};

/// Group /branch: all points and bifurcations, and what the walk goes on from.
void write_branches(ResultWriter& file, const BranchTree& tree, const BranchNames& names);

/// The same branches again, bit by bit.
/// @param empty  a tree of the same layout, whatever its harmonics
/// @throws FileError  if the file holds something else
BranchTree read_branches(const ResultReader& file, BranchTree empty);

}  // namespace whirl::inline io
