#pragma once
/// Branches of periodic orbits and the curves of their bifurcations for people.

#include <string>

#include "libdyn/studies/branch_result.hpp"
#include "libdyn/studies/curve_result.hpp"

namespace whirl::inline io {

/// Each branch with its range, its end and its bifurcations.
std::string text_of(const BranchResult& result);

/// The curves, a line each.
std::string text_of(const CurveResult& result);

}  // namespace whirl::inline io
