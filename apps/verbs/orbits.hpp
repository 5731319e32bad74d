#pragma once
/// What orbit and continue share.

#include "apps/verb.hpp"
#include "libdyn/batch/batch.hpp"
#include "libdyn/scene.hpp"

namespace whirl {

/// @throws ModelError  for a --frame that orbits are not looked for in
void require_stationary_frame(const Invocation& call);

/// The motion after --discard revolutions from the model's start, or from --from (there left out: 0),
/// at phase 0; its outcome says whether it got there.
Trajectory after_transient(const Invocation& call, const Model& model, const Scene& scene);

}  // namespace whirl
