#pragma once
/// Slopes of a scene by values of its model file, as --set names them.

#include <span>
#include <vector>

#include "libdyn/system/system_slope.hpp"
#include "libio/model/model_family.hpp"

namespace whirl::inline io {

/// Slopes of a member of a family by each of its values, in the shapes that its scene moves in (see
/// slope_of): what motion_slopes asks for.
///
/// @param axes    of the family: contact.seal.stiffness, bearing.left.kxx, disk.fan.mass,
///                operation.speed, film.left.viscosity, ...
/// @param scene   of the member
/// @param values  of the member, one per axis, none of them zero [SI]
/// @throws ModelError  for a value that is zero, or so near to the end of what it may be that its
///                     neighbors, 3 % away, make no model
/// @throws NumericalError  for a value that changes the number of degrees of freedom
std::vector<SystemSlope> slopes_of(const ModelFamily& family, std::span<const ParameterAxis> axes,
                                   const Scene& scene, std::span<const double> values);

}  // namespace whirl::inline io
