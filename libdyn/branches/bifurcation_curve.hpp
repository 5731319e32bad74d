#pragma once
/// Curves of bifurcations in the plane of two parameters, where kinds of motion meet.

#include <functional>
#include <memory>
#include <span>

#include "libdyn/branches/branch_equations.hpp"
#include "libdyn/branches/plane_slopes.hpp"

namespace whirl::inline dyn {

/// Flows over a plane of two parameters; their states are the same throughout.
struct FlowPlane {
  std::function<Flow(double first, double second)> at;
  /// How far the motions of a revolution from each start are from grazing: see nearest_graze. Only
  /// called for grazings.
  std::function<NearestGraze(double first, double second, std::span<const Vec> starts)> graze;
  /// Derivatives of the revolution from a start; nothing where they are not known. A null function:
  /// they never are.
  std::function<std::optional<RevolutionSlopes>(double first, double second, const Vec& start,
                                                const RevolutionAsked& asked)>
      slopes{};
};

/// Equations of a bifurcation for the unknowns (x, u): those of its orbit by multiple shooting, the
/// first parameter, u = 0 at low and 1 at high, and along the second parameter
///
///   F(x, u) = 0,   g(x, u) = 0
///
///   g = mu - 1            fold, for the multiplier nearest to 1
///   g = mu + 1            period doubling, for that nearest to -1
///   g = |mu|^2 - 1        Neimark-Sacker, for the complex pair nearest to the unit circle
///   g = depth / clearance grazing, of the extremum of a contact's depth nearest to touching
///
/// With v and w the critical eigenvectors of the tangent T of a period, T v = mu v and w^T T = mu
/// w^T,
///
///   d(mu) = w^T dT v / w^T v
///
/// where dT v are slopes of the deviation v; exactly, or by differences of tangents. The
/// multipliers are the others: where one of them leaves the unit circle two bifurcations meet.
///
/// @param kind   a fold, period doubling, Neimark-Sacker point or grazing
/// @param scale  of the states
/// @throws NumericalError  for a pitchfork, which lives by a symmetry
/// @source [Kuznetsov2004], 10.3, where the determinants of the same are used
BranchEquations bifurcation_curve_equations(BifurcationKind kind, FlowPlane flows, Vec scale,
                                            double low, double high);

/// Depth over clearance where it comes nearest to zero with a rate of zero, over the revolutions
/// from several starts: negative just before a contact touches, positive where it just does. Of
/// contacts that touch for good, likewise the other way.
///
/// @param contact  name of the contact; empty: any
/// @param starts   of a revolution each
/// @return  the smallest in size
NearestGraze nearest_graze(const Scene& scene, const std::string& contact,
                           std::span<const Vec> starts);

}  // namespace whirl::inline dyn
