#pragma once
/// Where a motion begins.

#include <optional>

#include "libdyn/system/scene.hpp"
#include "libfe/analyses/modes.hpp"

namespace whirl::inline dyn {

struct Start;

/// State at the start of a simulation, from the model's [start].
///
/// @param end  end of an earlier result, for `from = "file"`; may be null otherwise
/// @throws ModelError  if the start asks for a mode that does not exist, or for a file that is
///                     not given
MotionState start_state(const Model& model, const Scene& scene, const FullState* end);

/// The end of an earlier motion; a motion that was stopped ends within a revolution.
struct EarlierEnd {
  FullState state;
  double phase = 0.0;   ///< [rad]
  long revolution = 0;  ///< its number, where forces do not repeat every revolution
};

/// State at the start of a simulation that goes on from an earlier motion, if there is one: at the
/// phase at which that motion ended, and in the same revolution where forces do not repeat every
/// revolution.
MotionState start_state(const Model& model, const Scene& scene,
                        const std::optional<EarlierEnd>& earlier);

/// How many of the lowest modes a start asks for, 0 for none.
int modes_of(const Start& start);

/// State at the start of a simulation with given modes of the scene's system, for many scenes that
/// have the same system.
MotionState start_state(const Model& model, const Scene& scene, const FullState* end,
                        const Modes& modes);

}  // namespace whirl::inline dyn
