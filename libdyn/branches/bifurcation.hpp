#pragma once
/// Where branches of periodic orbits change: test functions, and branches that begin there.

#include <optional>

#include "libdyn/branches/branch_equations.hpp"

namespace whirl::inline dyn {

/// A function that changes its sign where a bifurcation of a kind is passed; none for grazings.
///
///   fold             the parameter's share of the tangent
///   period doubling  prod (mu_i + 1)
///   pitchfork        prod (mu_i - 1), which folds change, too
///   Neimark-Sacker   prod_(i<j) (mu_i mu_j - 1), which real pairs change, too
///
/// Of a product, only the sign is taken; the size is that of its smallest factor.
///
/// @source [Kuznetsov2004], 10.2.3
double test_function(BifurcationKind kind, const BranchPoint& point);

/// The multiplier that a bifurcation is about.
Complex critical_multiplier(BifurcationKind kind, const CVec& multipliers);

/// Where a branch begins that another one leads to.
struct SwitchedBranch {
  int period;  ///< [revolutions]
  BranchPoint start;
};

/// First point of the branch that begins at a period doubling or a pitchfork, its tangent along the
/// critical direction; nothing for other kinds, or where the direction cannot be told.
///
/// @param flow_at, scale  of the branch that it is on
/// @param period          of that branch [revolutions]
/// @return  to be continued within the same range of the parameter
std::optional<SwitchedBranch> switch_branch(const FlowAt& flow_at, const Vec& scale, int period,
                                            const Bifurcation& at);

}  // namespace whirl::inline dyn
