#pragma once
/// What orbit and continue share.

#include "apps/verb.hpp"
#include "libdyn/batch/batch.hpp"
#include "libdyn/scene.hpp"

namespace whirl {

/// Whether orbits are to be closed as seen from the rotor: --frame.
/// @throws ModelError  for other frames than the stationary and the rotating one
bool is_rotating_frame(const Invocation& call);

/// Time after which a motion from a start comes back as seen from the rotor [s].
/// @throws NumericalError  if it does not
double guessed_period(const Scene& scene, const Vec& start);

/// The motion after --discard revolutions from the model's start, or from --from (there left out: 0),
/// at phase 0; its outcome says whether it got there.
Trajectory after_transient(const Invocation& call, const Model& model, const Scene& scene);

}  // namespace whirl
