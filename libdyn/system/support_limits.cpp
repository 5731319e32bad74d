#include "libdyn/system/support_limits.hpp"

#include <fmt/format.h>

#include <utility>

namespace whirl::inline dyn {

void add_limits(Model& model) {
  constexpr double length = 1e-4;  // that stands for a limit, of the size of clearances [m]
  const std::vector<Support>& supports = model.structure.supports;
  for (std::size_t s = 0; s < supports.size(); ++s) {
    for (std::size_t l = 0; l < supports[s].limits.size(); ++l) {
      const SignalLimit& limit = supports[s].limits[l];
      const InterfaceCoordinate& port = supports[s].acts_on.front();
      Contact contact{.name = fmt::format("{}, {}", supports[s].name, limit.name),
                      .at = port.at,
                      .against = port.to,
                      .clearance = length,
                      .law = Radial<>{.k = limit.force * limit.limit / length},
                      .geometry = geometry::Saturation{},
                      .limits = LimitOfSupport{s, l},
                      .where = supports[s].where};
      model.contacts.push_back(std::move(contact));
    }
  }
}

}  // namespace whirl::inline dyn
