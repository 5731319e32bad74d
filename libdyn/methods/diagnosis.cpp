#include "libdyn/methods/diagnosis.hpp"

#include <fmt/format.h>

#include <numbers>

namespace whirl {

std::string diagnosis(const ContactSystem& system, const MotionState& state,
                      std::string_view what) {
  constexpr const char* words[] = {"apart", "receding", "sliding", "sticking"};
  std::string contacts;
  for (std::size_t i = 0; i < state.contacts.size(); ++i) {
    const ReducedContact& c = system.contacts()[i];
    const ContactForces f = kinematics(c, state.y.data(), system.coordinates());
    contacts += fmt::format(
        "; contact \"{}\" {}, {:.4g} clearances from its centre, slip {:.3g} m/s", c.name,
        words[static_cast<int>(state.contacts[i].touch)], f.r / c.clearance, f.slip);
  }
  return fmt::format("{} in revolution {} at {:.3f} of it{}; largest coordinate {:.3g} scales",
                     what, state.revolution, state.phase / (2.0 * std::numbers::pi), contacts,
                     (state.y.array() / system.state_scale().array()).abs().maxCoeff());
}

}  // namespace whirl
