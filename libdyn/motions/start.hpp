#pragma once
/// Where a motion begins.

#include "libdyn/system/scene.hpp"

namespace whirl {

/// State at the start of a simulation, from the model's [start].
///
/// @param end  end of an earlier result, for `from = "file"`; may be null otherwise
/// @throws ModelError  if the start asks for a mode that does not exist, or for a file that is
///                     not given
MotionState start_state(const Model& model, const Scene& scene, const FullState* end);

}  // namespace whirl
