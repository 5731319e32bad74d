#pragma once
/// A scene at other speeds, as studies over the speed ask for them.

#include <optional>

#include "libdyn/system/scene.hpp"

namespace whirl::inline dyn {

/// The scene of a model with the same rotor and reduction at another speed: to the last bit what
/// make_scene makes, without assembling or reducing anything again.
///
/// @param model  its contacts and films act at the stations of those of the scene
/// @return  nothing where the rotor's matrices depend on the speed, or the basis of its reduction
///          does: that of damped modes, or of a number of modes that is not given
std::optional<Scene> scene_at_speed(const Scene& scene, const Model& model);

}  // namespace whirl::inline dyn
