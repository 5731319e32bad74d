#pragma once
/// Branches of orbits by harmonic balance.

#include <functional>
#include <memory>
#include <optional>

#include "libdyn/branches/branch.hpp"
#include "libdyn/orbits/harmonic_balance.hpp"

namespace whirl::inline dyn {

/// The equations of motion at a value of the parameter, with the same places of forces throughout.
/// May throw NumericalError where there are none.
using HarmonicProblemAt = std::function<std::shared_ptr<const HarmonicProblem>(double value)>;

/// Derivative of that problem by the value, in its coordinates (HarmonicEquations::slope); nothing
/// where it is not known. A null function: it never is.
using HarmonicSlopeAt = std::function<std::optional<HarmonicProblem>(double value)>;

/// Those of harmonic balance for a walk along the parameter, with the same harmonics throughout.
///
/// Unknowns are the Fourier coefficients of the displacements at forces over the length scale,
/// which no change of the modes touches. Multipliers are those of Hill's method; those that it
/// leaves out count as zero.
///
/// @param period, harmonics  of the orbits
/// @param scale              of displacements [m]
BranchEquations harmonic_equations(HarmonicProblemAt problem_at, int period, int harmonics,
                                   double scale, HarmonicSlopeAt slope_at = {});

/// The unknowns of an orbit.
Vec harmonic_unknowns(const HarmonicOrbit& orbit, double scale);

/// The orbit of unknowns x, with as much of it as follows from them at once.
HarmonicOrbit orbit_of_unknowns(const HarmonicProblem& problem, const Vec& x, int period,
                                double scale);

}  // namespace whirl::inline dyn
