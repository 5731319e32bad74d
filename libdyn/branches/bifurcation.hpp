#pragma once
/// Bifurcations of branches of periodic orbits: test functions, and the branches that begin there.

#include <optional>

#include "libdyn/branches/branch_equations.hpp"

namespace whirl::inline dyn {

/// A test function, whose sign changes where the branch passes a bifurcation of a kind; for a
/// grazing, which has none, it is always 1.
///
///   fold             the parameter's share of the tangent
///   period doubling  prod (mu_i + 1)
///   pitchfork        prod (mu_i - 1); its sign changes at folds, too
///   Neimark-Sacker   prod_(i<j) (mu_i mu_j - 1); its sign changes at a real pair mu, 1 / mu, too
///
/// A product gives the sign of the test function, the smallest factor its size.
///
/// @source [Kuznetsov2004], 10.2.3
double test_function(BifurcationKind kind, const BranchPoint& point);

/// The critical multiplier: the nearest to 1, at a period doubling to -1, at a Neimark-Sacker point
/// one of the pair with the product nearest to 1; NaN at a grazing.
Complex critical_multiplier(BifurcationKind kind, const CVec& multipliers);

/// Start of a branch that begins at a bifurcation of another branch.
struct SwitchedBranch {
  int period;  ///< [revolutions]
  BranchPoint start;
};

/// First point of the branch that begins at a period doubling or a pitchfork, with its tangent
/// along the critical direction; nothing for other kinds, or where that direction is not found.
///
/// @param flow_at, scale  of the branch that the bifurcation is on
/// @param period          of that branch [revolutions]
/// @return  the start of a walk within the same range of the parameter
std::optional<SwitchedBranch> switch_branch(const FlowAt& flow_at, const Vec& scale, int period,
                                            const Bifurcation& at);

}  // namespace whirl::inline dyn
