#pragma once
/// What `whirl continue` says.

#include <string>

#include "libdyn/studies/branch_tree.hpp"
#include "libio/results/curve_results.hpp"
#include "libio/text/parameter_axis.hpp"
#include "libio/text/record.hpp"

namespace whirl {

/// Entries `branches`, `points`, `bifurcations` of JSON.
Record branches_record(const BranchTree& tree);
Record points_record(const BranchTree& tree);
Record bifurcations_record(const BranchTree& tree);
/// Entry `borders`.
Record curves_record(const BifurcationCurves& curves, const ParameterRange& along);

/// The same for people.
std::string branches_text(const BranchTree& tree, const ParameterAxis& axis);
std::string curves_text(const BifurcationCurves& curves, const CurveAxes& axes);

}  // namespace whirl
