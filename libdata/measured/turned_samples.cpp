#include "libdata/measured/turned_samples.hpp"

#include <algorithm>
#include <cmath>

namespace whirl::inline data {

TurnedSamples turned_samples(const ProbeReadings& readings, const TurnClock& clock) {
  constexpr double rounding = 1e-9;  // of sample numbers
  const auto sample = [&](double t) { return (t - readings.start) * readings.rate; };
  const auto first = static_cast<Eigen::Index>(std::ceil(sample(clock.first()) - rounding)),
             last = static_cast<Eigen::Index>(std::floor(sample(clock.last()) + rounding));
  TurnedSamples turned{std::max<Eigen::Index>(0, first), {}};
  const Eigen::Index end = std::min(readings.displacement.rows(), last + 1);
  turned.angle.resize(std::max<Eigen::Index>(0, end - turned.first));
  for (Eigen::Index j = 0; j < turned.angle.size(); ++j) {
    turned.angle(j) = clock.angle(readings.time(turned.first + j));
  }
  return turned;
}

}  // namespace whirl::inline data
