#pragma once
/// Bifurcation curves in the plane of two parameters, along which kinds of motion meet.

#include <functional>
#include <memory>
#include <span>

#include "libdyn/branches/branch_equations.hpp"
#include "libdyn/branches/plane_slopes.hpp"

namespace whirl::inline dyn {

/// Flows over a plane of two parameters, with states in the same coordinates at every place.
struct FlowPlane {
  std::function<Flow(double first, double second)> at;
  /// How near to grazing the motions of a revolution from some starts come: see nearest_graze.
  /// Called only for curves of grazings.
  std::function<NearestGraze(double first, double second, std::span<const Vec> starts)> graze;
  /// Derivatives of the revolution from a start; nothing where no derivatives are known. A null
  /// function: none are known anywhere.
  std::function<std::optional<RevolutionSlopes>(double first, double second, const Vec& start,
                                                const RevolutionAsked& asked)>
      slopes{};
};

/// Equations of a bifurcation along the second parameter. Unknowns are x, the states of its orbit
/// by multiple shooting, and u, the first parameter, which is 0 at low and 1 at high:
///
///   F(x, u) = 0,   g(x, u) = 0
///
///   g = mu - 1            fold, for the multiplier nearest to 1
///   g = mu + 1            period doubling, for the multiplier nearest to -1
///   g = |mu|^2 - 1        Neimark-Sacker, for the complex pair nearest to the unit circle
///   g = depth / clearance grazing, for the extremum of a contact's depth nearest to touching
///
/// With v and w the critical eigenvectors of the tangent T of a period, T v = mu v and
/// w^T T = mu w^T,
///
///   d(mu) = w^T dT v / w^T v
///
/// where dT v is the slope of the deviation v, exact or by differences of tangents. The multipliers
/// of a solution are those that are not critical: where one of these leaves the unit circle, two
/// bifurcations meet.
///
/// @param kind   a fold, period doubling, Neimark-Sacker point or grazing
/// @param scale  of the states
/// @throws NumericalError  for a pitchfork, which needs a symmetry and so has no curve
/// @source [Kuznetsov2004], 10.3, with determinants in place of multipliers
BranchEquations bifurcation_curve_equations(BifurcationKind kind, FlowPlane flows, Vec scale,
                                            double low, double high);

/// The extremum of a contact's depth over its clearance that is nearest to zero, over the
/// revolutions from several starts: negative where the contact just does not touch, positive where
/// it just does. A contact that touches all the time grazes where it just parts, or just does not.
///
/// @param contact  name of the contact; empty: any
/// @param starts   state at the start of each revolution
/// @return  the extremum of the smallest size
NearestGraze nearest_graze(const Scene& scene, const std::string& contact,
                           std::span<const Vec> starts);

}  // namespace whirl::inline dyn
