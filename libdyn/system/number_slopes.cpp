#include "libdyn/system/number_slopes.hpp"

#include <algorithm>

#include "libbase/error.hpp"

namespace whirl::inline dyn {

void require_smooth(const ContactSystem& system, const SystemSlope& parameter) {
  const auto sense = [](const ContactSystem& s) { return (s.Omega() > 0.0) - (s.Omega() < 0.0); };
  for (const ContactSystem& neighbor : parameter.neighbors) {
    if (sense(neighbor) != sense(system)) {
      throw NumericalError(parameter.name +
                           ": no derivative by a speed of zero, around which the rotor turns back");
    }
    for (std::size_t i = 0; i < std::min(neighbor.contacts().size(), system.contacts().size());
         ++i) {
      const ReducedContact& c = system.contacts()[i];
      if (neighbor.contacts()[i].friction.is_exact() != c.friction.is_exact()) {
        throw NumericalError(parameter.name + ": no derivative where contact \"" + c.name +
                             "\" has no friction that switches, but does beside it");
      }
    }
  }
}

}  // namespace whirl::inline dyn
