#pragma once
/// Critical speeds of a rotor whose supports do not give.

#include "libfe/lateral/turning_shaft.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline fe {

/// The first undamped critical speed on rigid supports that a rotor does not whirl backward at:
/// bearings and linearized connections, as oil films, pin x and y to the ground, or one shaft to
/// another; seals are left out.
///
/// @param of  shaft whose unbalance excites; of several ones it is that which the mode moves most
/// @return    speed of the first shaft [rad/s]; NaN if none is found, or the rotor would be free
/// @throws NumericalError  if the eigensolver fails
/// @source [API617]: the critical speed that the critical speed ratio is told by
double critical_on_rigid_supports(const Structure& structure, const TurningShaft& of = {});

}  // namespace whirl::inline fe
