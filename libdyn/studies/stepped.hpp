#pragma once
/// Motions by the classical Runge-Kutta method with equal steps, as many published studies have
/// them.

#include <span>

#include "libdyn/taylor/batch.hpp"

namespace whirl::inline dyn {

/// Distance between a motion and its copies, which give its exponents [length scales].
constexpr double copies_apart = 1e-8;

/// Integrates trajectories by the method of methods/rk4.hpp in this thread: the same results as of
/// integrate_batch, but of the motion that the steps make. Slow.
///
/// Exponents come from copies of the motion, as many as it has states, which begin displaced along
/// orthogonal directions and are integrated like the motion; after every revolution the
/// displacements are made orthogonal again, and as long as before. No variational equations are
/// integrated, which could be wrong over touches.
///
/// @param options  without tangents; its tolerance, order and threads mean nothing here
/// @param steps    of a revolution
/// @param apart    distance of the copies from the motion [length scales]
/// @source [Benettin1980]
void integrate_stepped(std::span<Trajectory> all, const BatchOptions& options, long steps,
                       double apart = copies_apart);

}  // namespace whirl::inline dyn
