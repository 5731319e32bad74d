#include "libfe/critical_damping.hpp"

#include <cmath>

#include "libfe/campbell.hpp"

namespace whirl {

std::vector<double> critical_damping(const Assembler& assembler,
                                     const std::vector<Critical>& criticals,
                                     const CriticalOptions& options) {
  constexpr double meets = 1e-6;  // of a frequency: damped criticals are known to 1e-10
  const ModeFinder finder(assembler);
  std::vector<double> ratios;
  for (const Critical& c : criticals) {
    ratios.push_back(std::nan(""));
    if (!std::isfinite(c.damped_speed)) continue;
    const Sparse M = finder.system(c.damped_speed).M;
    const double frequency = options.order * c.damped_speed;
    double best = -1.0;
    for (const Mode& mode : finder.at(c.damped_speed, options.count + 6).oscillatory) {
      if (std::abs(mode.frequency() - frequency) > meets * frequency) continue;
      const double agreement = mac(mode.shape, c.shape, M);
      if (agreement <= best) continue;
      best = agreement;
      ratios.back() = mode.damping_ratio();
    }
  }
  return ratios;
}

}  // namespace whirl
