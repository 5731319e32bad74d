#pragma once
/// Critical speeds of a rotor whose supports do not give.

#include "libfe/parts/structure.hpp"

namespace whirl::inline fe {

/// The first undamped critical speed on rigid supports that a rotor does not whirl backward at:
/// bearings and linearized connections, as oil films, pin x and y to the ground; seals are left
/// out.
///
/// @return  [rad/s]; NaN if none is found, or the rotor would be free
/// @throws NumericalError  if the eigensolver fails
/// @source [API617]: the critical speed that the critical speed ratio is told by
double critical_on_rigid_supports(const Structure& structure);

}  // namespace whirl::inline fe
