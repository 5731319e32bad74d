#pragma once
/// Static shapes that are added to the basis of a reduced system.

#include "libfe/analyses/reduce.hpp"

namespace whirl::inline fe {

/// A reduced system with the shapes K_s^-1 f for loads f, too, as far as its own do not have them.
///
/// @param loads  n x any number; free systems take them as `reduce` does
/// @throws NumericalError  if the stiffness is singular otherwise
/// @source [CraigChang1977]
ReducedSystem with_static_shapes(const System& system, const ReducedSystem& reduced,
                                 const Mat& loads);

}  // namespace whirl::inline fe
