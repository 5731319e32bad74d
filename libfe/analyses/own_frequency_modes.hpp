#pragma once
/// Modes of systems whose matrices depend on the frequency of a motion.

#include <functional>

#include "libfe/analyses/modes.hpp"

namespace whirl::inline fe {

/// A system as motions of a frequency omega >= 0 [rad/s] see it; coordinates are the same at all.
using SystemAtFrequency = std::function<System(double omega)>;

/// The lowest modes, each of the system at its own damped frequency.
///
///   (lambda^2 M(w) + lambda D(w) + K(w)) q = 0,   w = |Im lambda|, to 1e-12
///
/// Modes at w = 0 are followed over w by their shapes until w is their frequency. Those of systems
/// at frequencies that were found are followed likewise, so that none is missing that only appears
/// there; none is there twice. What does not oscillate, and rigid-body motions, are those of w = 0.
/// A table in which stiffness rises faster than inertia can have modes in any number.
///
/// @param count         oscillatory modes wanted; fewer come back if there are fewer
/// @param completeness  of the modes at each frequency that is looked at
/// @throws NumericalError  if an eigensolver fails
Modes own_frequency_modes(const SystemAtFrequency& system, int count,
                          Completeness completeness = Completeness::proven);

}  // namespace whirl::inline fe
