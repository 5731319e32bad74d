#pragma once
/// The transient of a motion, which comes before the motion is looked at.

#include <functional>
#include <optional>

#include "libdyn/system/scene.hpp"
#include "libdyn/taylor/batch.hpp"

namespace whirl::inline dyn {

struct TransientOptions {
  long revolutions = 0;
  double tolerance = 1e-10;  ///< of a step, displacements by the length scale
  /// Called with the revolutions done and their number in all; may be empty.
  std::function<void(long done, long total)> progress{};
  /// Asked often; true: stop. May be empty.
  std::function<bool()> is_stopped{};
};

/// Revolutions from a revolution of a given number until all forces begin anew, where orbits begin;
/// 0 if forces never do.
long until_forces_repeat(const ContactSystem& system, long revolution);

/// Takes a motion through some revolutions, and on to phase 0 of one in which its forces begin
/// anew; at least through what is left of the revolution in which the motion begins. The outcome
/// says whether the motion got there.
/// @throws NumericalError  if the system has no degrees of freedom
Trajectory run_transient(const Scene& scene, const MotionState& start,
                         const TransientOptions& options);

/// The state that a transient ended in; nothing: the transient was stopped.
/// @throws NumericalError  if the motion failed
std::optional<MotionState> settled_state(const Trajectory& transient);

}  // namespace whirl::inline dyn
