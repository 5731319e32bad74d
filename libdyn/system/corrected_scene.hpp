#pragma once
/// Scenes whose shapes follow parameters of the rotor.

#include <span>

#include "libdyn/system/scene.hpp"

namespace whirl::inline dyn {

/// A scene with static corrections for parameters: with further shapes for what these parameters
/// change in the equations of its own shapes.
///
///   Phi+ = [Phi, K_s^-1 dM Phi, K_s^-1 dC Phi, K_s^-1 dG Phi, K_s^-1 dK Phi]   of each parameter
///
/// Slopes by a parameter hold the shapes (slope_of). The further shapes are static answers to the
/// forces that the parameter makes in the shapes. Only the inertia of these answers is left out:
/// the square of the frequency over that of the lowest mode that is left out. A bearing or a mass
/// adds two or four shapes. Nothing is added for contacts, films and unbalances, and to scenes that
/// are not reduced.
///
/// @param model   of the scene
/// @param others  the same with another value of one parameter each
/// @throws ModelError, NumericalError  as system_beside
/// @source [CraigChang1977]
Scene corrected_scene(const Scene& scene, const Model& model, std::span<const Model> others);

}  // namespace whirl::inline dyn
