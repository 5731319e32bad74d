#pragma once
/// Scenes that differ little, as those of a study do.

#include <memory>

#include "libdyn/system/scene.hpp"

namespace whirl::inline dyn {

/// The scene of a model with the same mesh, matrices and shapes as another scene, at another speed,
/// with other loads, contacts and films: to the last bit what make_scene makes without an estimate
/// of the reduction's error, without assembling or reducing anything again.
///
/// @param scene  of a model of the same reduction; its contacts and films act at the same places
/// @return  null where the structure differs in more than the sizes of its loads, where
///          coefficients change with the speed, or where the shapes do: those of damped modes
///          change with the speed, as many modes as a tolerance needs with every frequency, static
///          shapes with the bow and with accelerations of the base
std::shared_ptr<const Scene> scene_beside(const Scene& scene, const Model& model);

}  // namespace whirl::inline dyn
