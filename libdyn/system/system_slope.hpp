#pragma once
/// A system and its neighbors along a parameter, from which its coefficients get their slopes.

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "libdyn/system/scene.hpp"

namespace whirl::inline dyn {

/// Places of the neighbors [steps], and their weights in the slope of a coefficient c:
///
///   dc/dp = sum_j weight_j c(p + place_j step) / step + O(step^8 c^(9) / 630)
///
/// @source [Fornberg1988], table 1
inline constexpr std::array<double, 8> neighbor_places{1, -1, 2, -2, 3, -3, 4, -4};
inline constexpr std::array<double, 8> neighbor_weights{4.0 / 5.0,    -4.0 / 5.0,  -1.0 / 5.0,
                                                        1.0 / 5.0,    4.0 / 105.0, -4.0 / 105.0,
                                                        -1.0 / 280.0, 1.0 / 280.0};

/// Largest step over what a parameter is compared with; a step is more than half as large.
inline constexpr double largest_step = 1.0 / 128.0;
/// Where the farthest neighbors are [steps].
inline constexpr double farthest_neighbor = 4.0;

/// A parameter p of a system: anything that its coefficients follow from smoothly, as stiffness,
/// friction and clearance of a contact, viscosity of a film, unbalance, speed, mass of a body.
///
/// Only coefficients are compared, never motions: coefficients are polynomials of p or nearly so,
/// and their slopes come out to 1e-13. Slopes of motions follow from these slopes exactly.
struct SystemSlope {
  std::string name;                      ///< of the parameter
  double step = 0.0;                     ///< between neighbors [unit of p]
  std::vector<ContactSystem> neighbors;  ///< at p + neighbor_places step
};

/// The slope of systems that are made by a function of p.
///
/// @param value  of p
/// @param size   what p is compared with: see largest_step; 0: with the value
/// @param at     the system at p, in the same coordinates; asked up to 4 steps to either side
/// @throws ModelError  without a size of p, if value and size are 0
SystemSlope slope_of(std::string name, double value, double size,
                     const std::function<ContactSystem(double)>& at);

/// M, C, G, K of a model at its speed, in the degrees of freedom of a scene of another one.
///
/// @param assembler  of the model
/// @throws ModelError, NumericalError  as make_scene, and for another number of degrees of freedom
System system_beside(const Scene& scene, const Assembler& assembler, const Model& model);

/// A model in the shapes Phi that a scene of another one moves in.
///
/// @throws ModelError, NumericalError  as system_beside
Scene scene_in_shapes_of(const Scene& scene, const Model& model);

/// The system of such a scene. Where models differ in contacts, films and loads alone, nothing is
/// assembled.
ContactSystem in_shapes_of(const Scene& scene, const Model& model);

/// The slope of a scene by a parameter of its model.
///
/// The shapes Phi that the scene moves in are held: dM = Phi^T dM_full Phi, and so with C, G and K.
/// What the parameter would change in the shapes themselves is left out. This is nothing in a scene
/// that is not reduced, and nothing for contacts, films and unbalances; else it is as small as the
/// error of the reduction.
///
/// @param value, size  as of the other slope_of
/// @param model_at     the model at p, with as many degrees of freedom
/// @throws ModelError, NumericalError  as make_scene of the models
SystemSlope slope_of(std::string name, const Scene& scene, double value, double size,
                     const std::function<Model(double)>& model_at);

}  // namespace whirl::inline dyn
