#include "libdata/measured/zones.hpp"

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"

namespace whirl::inline data {

namespace {

constexpr double near_highest = 0.02;
constexpr double um = 1e-6, mm_per_s = 1e-3;

}  // namespace

ZoneLimits zone_limits(ZoneClass of, double speed) {
  const double root = std::sqrt(speed / rpm);
  switch (of) {
    case ZoneClass::shaft:
      return {4800.0 * um / root, 9000.0 * um / root, 13200.0 * um / root};
    case ZoneClass::housing_1_rigid:
    case ZoneClass::housing_2_flexible:
      return {2.3 * mm_per_s, 4.5 * mm_per_s, 7.1 * mm_per_s};
    case ZoneClass::housing_1_flexible:
      return {3.5 * mm_per_s, 7.1 * mm_per_s, 11.0 * mm_per_s};
    default:
      return {1.4 * mm_per_s, 2.8 * mm_per_s, 4.5 * mm_per_s};
  }
}

std::string_view zone_of(double value, const ZoneLimits& limits) {
  if (value <= limits.ab) return "A";
  if (value <= limits.bc) return "B";
  return value <= limits.cd ? "C" : "D";
}

ZoneReport zones_of(const Trend& trend, ZoneClass of) {
  ZoneReport report;
  report.of = name_of(of);
  report.si_unit = of == ZoneClass::shaft ? "m" : "m/s";
  const double fastest = trend.speed.maxCoeff();
  for (const TrendCurve& curve : trend.probes) {
    ZoneVerdict verdict;
    static_cast<ProbeLabel&>(verdict) = curve;
    double worst = -1.0;
    for (Eigen::Index k = 0; k < trend.speed.size(); ++k) {
      const bool is_judged =
          !trend.records.empty() || trend.speed(k) >= (1.0 - near_highest) * fastest;
      if (!is_judged) continue;
      const double value = of == ZoneClass::shaft ? curve.overall(k) : curve.velocity(k);
      const ZoneLimits limits = zone_limits(of, trend.speed(k));
      if (value / limits.ab <= worst) continue;
      worst = value / limits.ab;
      verdict.value = value;
      verdict.speed = trend.speed(k);
      verdict.limits = limits;
    }
    verdict.zone = zone_of(verdict.value, verdict.limits);
    report.zone = std::max(report.zone, verdict.zone);
    report.probes.push_back(std::move(verdict));
  }
  return report;
}

}  // namespace whirl::inline data
