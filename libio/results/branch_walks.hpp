#pragma once
/// What branches go on from, as numbers of a result file.

#include <string>
#include <vector>

#include "libdyn/studies/bifurcation_curves.hpp"
#include "libdyn/studies/branch_tree.hpp"

namespace whirl::inline io {

class ResultReader;
class ResultWriter;

/// Dataset `walk` of a group: all of the branches but names and ends, which stand beside it.
void write_branch_walk(ResultWriter& file, const std::string& group,
                       const std::vector<TracedBranch>& branches);
void write_curve_walk(ResultWriter& file, const std::string& group,
                      const std::vector<BifurcationCurve>& curves);

/// The same again, bit by bit.
/// @param layout  of the branches, or of those that the curves go through
/// @throws FileError  where the numbers do not fit the layout, or each other
std::vector<TracedBranch> read_branch_walk(const ResultReader& file, const std::string& group,
                                           const BranchLayout& layout);
std::vector<BifurcationCurve> read_curve_walk(const ResultReader& file, const std::string& group,
                                              const BranchLayout& layout);

}  // namespace whirl::inline io
