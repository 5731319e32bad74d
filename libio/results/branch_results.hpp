#pragma once
/// Branches of periodic orbits, and curves of their bifurcations, in a result file.

#include "libdyn/studies/branch_result.hpp"
#include "libdyn/studies/curve_result.hpp"

namespace whirl::inline io {

class ResultReader;
class ResultWriter;

/// Group /branch: all points and bifurcations, and what the walk goes on from.
/// @param result  of the tree
void write_branches(ResultWriter& file, const BranchTree& tree, BranchResult result);

/// Reads the branches that write_branches wrote, bit by bit.
/// @param empty  a tree of the same layout, whatever its harmonics
/// @throws FileError  if the file holds something else
BranchTree read_branches(const ResultReader& file, BranchTree empty);

/// Group /border: curves of bifurcations along a second parameter; nothing without curves.
/// @param result  of the curves
void write_curves(ResultWriter& file, const BifurcationCurves& curves, CurveResult result);

/// Reads the curves that write_curves wrote, bit by bit; none if the file has none.
/// @param layout  of the branches that the curves go through
/// @throws FileError  if the file holds something else
BifurcationCurves read_curves(const ResultReader& file, const BranchLayout& layout);

}  // namespace whirl::inline io
