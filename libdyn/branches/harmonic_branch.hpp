#pragma once
/// Branches of orbits by harmonic balance.

#include <functional>
#include <memory>
#include <optional>

#include "libdyn/branches/branch.hpp"
#include "libdyn/orbits/harmonic_balance.hpp"

namespace whirl::inline dyn {

/// The equations of motion at a value of the parameter, with forces at the same places at every
/// value. May throw NumericalError where there are no equations.
using HarmonicProblemAt = std::function<std::shared_ptr<const HarmonicProblem>(double value)>;

/// Derivative of a HarmonicProblem by the value, in the coordinates of the problem
/// (HarmonicEquations::slope); nothing where the derivative is not known. A null function: it is
/// not known anywhere.
using HarmonicSlopeAt = std::function<std::optional<HarmonicProblem>(double value)>;

/// Equations of harmonic balance for a walk along the parameter, with the same harmonics at every
/// value.
///
/// Unknowns are the Fourier coefficients of the displacements at forces over the length scale;
/// these do not depend on the modes of the basis. Multipliers come from Hill's method; multipliers
/// that the method leaves out count as zero.
///
/// @param period, harmonics  of the orbits
/// @param scale              of displacements [m]
BranchEquations harmonic_equations(HarmonicProblemAt problem_at, int period, int harmonics,
                                   double scale, HarmonicSlopeAt slope_at = {});

/// The unknowns of an orbit.
Vec harmonic_unknowns(const HarmonicOrbit& orbit, double scale);

/// The orbit of unknowns x: its motion, ports and residual, without levels and truncation.
HarmonicOrbit orbit_of_unknowns(const HarmonicProblem& problem, const Vec& x, int period,
                                double scale);

}  // namespace whirl::inline dyn
