#include "libdata/balancing/run_readings.hpp"

#include <fmt/format.h>

#include <cmath>

#include "libbase/error.hpp"
#include "libdata/measured/order_tracking.hpp"

namespace whirl::inline data {

RunReadings run_readings(const ProbeReadings& readings) {
  constexpr double most_variation = 0.02, revolutions = 24.0;
  if (!readings.clock) {
    throw OptionError("the phase of 1X needs a key-phasor: expected a table [keyphasor]");
  }
  if (readings.clock->variation() > most_variation) {
    throw OptionError(fmt::format("the speed changes by {:.1f} %, expected a run at one speed",
                                  100.0 * readings.clock->variation()));
  }
  const std::vector<std::string> names{"1/4", "1/3", "1/2", "2/3", "3/4"};
  const std::vector<double> orders{0.25, 1.0 / 3.0, 0.5, 2.0 / 3.0, 0.75, 1.0, 2.0, 3.0};
  const OrderTracking tracking =
      track_orders(readings, {.orders = orders, .revolutions = revolutions});
  const std::size_t probes = readings.probes.size(), count = orders.size();
  RunReadings found{tracking.speed.mean(), CVec(static_cast<Eigen::Index>(probes)), {}};
  for (std::size_t p = 0; p < probes; ++p) {
    const auto row = static_cast<Eigen::Index>(p);
    found.vectors(row) = tracking.curves[p * count + names.size()].response.mean();
    const std::string& name = readings.probes[p].name;
    for (std::size_t q = 0; q < names.size(); ++q) {
      const double share = std::sqrt(tracking.curves[p * count + q].response.cwiseAbs2().mean()) /
                           std::abs(found.vectors(row));
      if (share > most_subharmonic) {
        found.signs_of_rub.push_back(
            fmt::format("probe {} reads {:.2g} times its 1X at {} of the "
                        "speed",
                        name, share, names[q]));
      }
    }
    if (is_clipped(readings.displacement.col(row))) {
      found.signs_of_rub.push_back(
          fmt::format("probe {} rests at its largest or smallest value", name));
    }
  }
  return found;
}

}  // namespace whirl::inline data
