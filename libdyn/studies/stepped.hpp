#pragma once
/// Motions by the classical Runge-Kutta method with equal steps, as many published studies have
/// them.

#include <span>

#include "libdyn/taylor/batch.hpp"

namespace whirl::inline dyn {

/// How far copies of a motion are away from it, from which its exponents are taken [length scales].
constexpr double copies_apart = 1e-8;

/// Integrates trajectories by the method of methods/rk4.hpp in this thread: what integrate_batch
/// gives, but sections, measures and exponents of the motion that the steps make. Slow.
///
/// Exponents come from copies of the motion, as many as it has states, which begin displaced along
/// orthogonal directions and are integrated as it is; after every revolution their displacements
/// are made orthogonal again, and as long as they were. No variational equations are integrated, so
/// none are wrong over touches.
///
/// @param options  without tangents; its tolerance, order and threads mean nothing here
/// @param steps    of a revolution
/// @param apart    how far the copies are away [length scales]
/// @source [Benettin1980]
void integrate_stepped(std::span<Trajectory> all, const BatchOptions& options, long steps,
                       double apart = copies_apart);

}  // namespace whirl::inline dyn
