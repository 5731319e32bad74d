#pragma once
/// The numbers that motions of a system follow from.

#include <vector>

#include "libdyn/system/contact_system.hpp"

namespace whirl::inline dyn {

/// All numbers of the equations of motion, in the form in which integrations use them, such as the
/// inverse of a film's clearance: where all of these numbers are polynomials of a parameter, slopes
/// of motions by this parameter follow from slopes of the polynomials.
///
/// @return  blocks of numbers of one kind and unit, such as a matrix; as many for every system with
///          the same loads, contacts and films
std::vector<Vec> numbers_of(const ContactSystem& system);

}  // namespace whirl::inline dyn
