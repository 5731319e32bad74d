#pragma once

#include "libbase/error.hpp"
#include "libdyn/system/contact_system.hpp"

namespace whirl::inline dyn {

/// @throws NumericalError  for a system that has no coordinates
inline void require_coordinates(const ContactSystem& system) {
  if (system.coordinates() > 0) return;
  throw NumericalError("nothing moves: the system has no degrees of freedom");
}

}  // namespace whirl::inline dyn
