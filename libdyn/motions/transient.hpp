#pragma once
/// What comes before a motion is looked at: its transient.

#include <functional>
#include <optional>

#include "libdyn/system/scene.hpp"
#include "libdyn/taylor/batch.hpp"

namespace whirl::inline dyn {

struct TransientOptions {
  long revolutions = 0;
  double tolerance = 1e-10;  ///< of a step, displacements by the length scale
  /// Called with the revolutions done and all of them; may be empty.
  std::function<void(long done, long total)> progress{};
  /// Asked often; true: stop. May be empty.
  std::function<bool()> is_stopped{};
};

/// Revolutions after a number of them until all forces begin anew, where orbits begin; 0 where they
/// never do.
long until_forces_repeat(const ContactSystem& system, long revolution);

/// A motion after some revolutions, at phase 0: what is left of the revolution that it begins in is
/// gone through in any case, and it goes on until its forces begin anew. Its outcome says whether
/// it got there.
/// @throws NumericalError  if the system has no degrees of freedom
Trajectory run_transient(const Scene& scene, const MotionState& start,
                         const TransientOptions& options);

/// The state that a transient ended in; nothing: it was stopped before.
/// @throws NumericalError  if the motion failed
std::optional<MotionState> settled_state(const Trajectory& transient);

}  // namespace whirl::inline dyn
