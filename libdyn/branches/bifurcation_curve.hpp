#pragma once
/// Curves of bifurcations in the plane of two parameters, where kinds of motion meet.

#include <functional>
#include <memory>
#include <span>

#include "libdyn/branches/branch_equations.hpp"
#include "libdyn/system/scene.hpp"

namespace whirl::inline dyn {

/// Flows over a plane of two parameters; their states are the same throughout.
struct FlowPlane {
  std::function<Flow(double first, double second)> at;
  /// How far the motions of a revolution from each start are from grazing: see nearest_graze. Only
  /// called for grazings.
  std::function<double(double first, double second, std::span<const Vec> starts)> graze;
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
/// Derivatives of g are differences. The multipliers are the others: where one of them leaves the
/// unit circle two bifurcations meet.
///
/// @param kind   a fold, period doubling, Neimark-Sacker point or grazing
/// @param scale  of the states
/// @throws NumericalError  for a pitchfork, which lives by a symmetry
/// @source [Kuznetsov2004], 10.3, where the determinants of the same are used
BranchEquations bifurcation_curve_equations(BifurcationKind kind, FlowPlane flows, Vec scale,
                                            double low, double high);

/// Depth over clearance where it comes nearest to zero with a rate of zero, over the revolutions from
/// several starts: negative just before a contact touches, positive where it just does. Of contacts
/// that touch for good, likewise the other way.
///
/// @param contact  name of the contact; empty: any
/// @return  the smallest in size; 1e3 where no depth has an extremum
double nearest_graze(const Scene& scene, const std::string& contact, std::span<const Vec> starts);

}  // namespace whirl::inline dyn
