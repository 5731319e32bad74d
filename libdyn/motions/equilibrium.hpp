#pragma once
/// Where a rotor lies at rest, on its stators if its sag is more than their clearance.

#include "libdyn/system/contact_system.hpp"

namespace whirl::inline dyn {

/// Coordinates eta at which weight, springs and the normal forces of contacts balance, without
/// unbalance and friction:
///
///   f0 + sum_i B_i F_i = K eta + sum_j B_j N_j n_j
///
/// Without oil films and where no contact is reached this is the linear sag. Films F carry as they
/// do at the speed. The balance is found as for linear analyses (PortBalance), but in the
/// coordinates of a motion, so that a motion that starts there stays there.
///
/// @throws NumericalError  if nothing holds the rotor, or if the iteration does not converge
Vec equilibrium(const ContactSystem& system);

}  // namespace whirl::inline dyn
