#include "libfe/lateral/lateral_rules.hpp"

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"

namespace whirl::inline fe {

double analysis_unbalance(double mass, double maximum) {
  constexpr double allowed = 6350e-6;  // [kg.m rpm / kg]
  return 2.0 * allowed * mass / (maximum / rpm);
}

double vibration_limit(double maximum) {
  return 25.4e-6 * std::min(1.0, std::sqrt(12000.0 / (maximum / rpm)));
}

SeparationMargin separation_margin(const ResponsePeak& peak, const OperatingRange& range) {
  if (peak.speed < range.minimum) return separation_margin(peak, range.minimum);
  SeparationMargin margin = separation_margin(peak, range.maximum);
  if (peak.speed <= range.maximum) margin.actual = 0.0;
  return margin;
}

double largest_speed_ratio(double density) {
  constexpr double densest = 60.0;  // [kg/m^3]
  return density > densest ? 0.0 : std::min(2.5, 2.69 - 0.0115 * density);
}

StabilityRegion stability_region(double speed_ratio, double density) {
  return speed_ratio > largest_speed_ratio(density) ? StabilityRegion::b : StabilityRegion::a;
}

double anticipated_coupling(const Stage& stage, double maximum) {
  constexpr double wachel = 3.0;
  const double torque = stage.power / maximum;
  return wachel * torque / (stage.diameter * stage.width) * stage.density_ratio;
}

}  // namespace whirl::inline fe
