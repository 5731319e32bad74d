#pragma once
/// Where a motion begins.

#include <optional>

#include "libdyn/system/scene.hpp"
#include "libfe/analyses/modes.hpp"

namespace whirl::inline dyn {

/// State at the start of a simulation, from the model's [start].
///
/// @param end  end of an earlier result, for `from = "file"`; may be null otherwise
/// @throws ModelError  if the start asks for a mode that does not exist, or for a file that is
///                     not given
MotionState start_state(const Model& model, const Scene& scene, const FullState* end);

/// The end of an earlier motion; a stopped one ends within a turn.
struct EarlierEnd {
  FullState state;
  double phase = 0.0;   ///< [rad]
  long revolution = 0;  ///< where forces do not repeat with it
};

/// The same at the phase at which the earlier motion ended, and in its revolution where forces do
/// not repeat with it; nothing: there is none.
MotionState start_state(const Model& model, const Scene& scene,
                        const std::optional<EarlierEnd>& earlier);

/// How many of the lowest modes a start asks for, 0 for none.
int modes_of(const Start& start);

/// The same with these modes of the scene's system, where many scenes have the same one.
MotionState start_state(const Model& model, const Scene& scene, const FullState* end,
                        const Modes& modes);

}  // namespace whirl::inline dyn
