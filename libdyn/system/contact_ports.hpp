#pragma once
/// Contacts and oil films of a rotor as forces on periodic motions, and what contacts do on these.

#include <vector>

#include "libdyn/system/contact_measures.hpp"
#include "libdyn/system/number_slopes.hpp"
#include "libdyn/system/port_forces.hpp"

namespace whirl::inline dyn {

/// The forces of all contacts and films, at one place each; all blades of a contact share one
/// place.
///
/// Contacts are sampled while they touch only, from event to event: touch and release, and
/// reversals of slip where friction switches exactly, are located on the series, and Gauss points
/// lie between them, so that kinks cost no accuracy. A force that jumps at an event adds to the
/// slopes:
///
///   d/dm int g d(theta) = int dg/dm d(theta) + sum [g] (dh/dm) / |dh/d(theta)|
///
/// with h = 0 at the event.
///
/// Exact friction has the sign of the slip. Contacts cannot stick here: see sticks_on.
std::vector<PortForces> port_forces(const ContactSystem& system);

/// The derivatives of these forces by a parameter, on motions that are held at their ports: U and B
/// are derivatives of the rows, g of a sample is the derivative of the force, by_u and by_rate are
/// empty.
///
/// The series of the motion is held, so that its rates go with the rate of the phase. Jumps move
/// with h_p / |dh/d(theta)|, as above.
std::vector<PortForces> port_force_slopes(const ContactSystem& system, const NumberSlopes& slopes);

/// What the contacts do over a period; duties are shares of the period.
/// @param motion  of the coordinates eta
std::vector<ContactMeasure> measures_on(const ContactSystem& system, const Periodic& motion);

/// Name of a contact that would stick where the motion lets its slip change sign; empty: none
/// would.
std::string sticks_on(const ContactSystem& system, const Periodic& motion);

}  // namespace whirl::inline dyn
