#pragma once
/// Zones of acceptance A to D of machines in operation.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "libbase/structs/field.hpp"
#include "libdata/measured/trend.hpp"

namespace whirl::inline data {

/// What is judged, and of which machines.
enum class ZoneClass {
  shaft,            ///< displacement of the shaft beside its bearings, peak to peak
  housing_1_rigid,  ///< velocity of bearing housings: large machines on rigid foundations
  housing_1_flexible,
  housing_2_rigid,  ///< machines of medium size
  housing_2_flexible
};
constexpr auto choices(ZoneClass) {
  return std::array{Choice<ZoneClass>{"shaft", ZoneClass::shaft},
                    Choice<ZoneClass>{"housing-1-rigid", ZoneClass::housing_1_rigid},
                    Choice<ZoneClass>{"housing-1-flexible", ZoneClass::housing_1_flexible},
                    Choice<ZoneClass>{"housing-2-rigid", ZoneClass::housing_2_rigid},
                    Choice<ZoneClass>{"housing-2-flexible", ZoneClass::housing_2_flexible}};
}

/// Boundaries between zones A and B, B and C, C and D.
struct ZoneLimits {
  double ab = 0.0, bc = 0.0, cd = 0.0;  ///< [m] peak to peak of the shaft, [m/s] r.m.s. of housings
};

/// Boundaries of zones, of the shaft with n in rpm
///
///   S_AB = 4800 / sqrt(n) um,   S_BC = 9000 / sqrt(n) um,   S_CD = 13200 / sqrt(n) um
///
/// of housings as a table has them. A contract may have others.
///
/// @param speed  of the rotor, above zero; counts for the shaft alone [rad/s]
/// @source [ISO7919], [ISO10816]; both are part of ISO 20816-3
ZoneLimits zone_limits(ZoneClass of, double speed);

/// "A", "B", "C", "D"; a value at a boundary is in the better zone.
std::string_view zone_of(double value, const ZoneLimits& limits);

/// In which zone a probe's reading is.
struct ZoneVerdict : ProbeLabel {
  double speed = 0.0;  ///< at which it was judged [rad/s]
  double value = 0.0;  ///< [m] peak to peak, [m/s] r.m.s.
  ZoneLimits limits;
  std::string zone;

  static constexpr auto columns() {
    using Z = ZoneVerdict;
    return joined(
        ProbeLabel::columns(),
        ColumnList{
            column("speed", &Z::speed, "rad/s", "at which it was judged"),
            column("value", &Z::value, "", "that was judged, in si_unit"),
            column(
                "ab", [](auto& z) -> auto& { return z.limits.ab; }, "", "boundary of A and B"),
            column(
                "bc", [](auto& z) -> auto& { return z.limits.bc; }, "", "boundary of B and C"),
            column(
                "cd", [](auto& z) -> auto& { return z.limits.cd; }, "", "boundary of C and D"),
            column("zone", &Z::zone, "", "A, B, C or D")});
  }
};

/// The zones of all probes; group /zones.
struct ZoneReport {
  std::string of;       ///< name of the class
  std::string si_unit;  ///< of values and boundaries: "m" peak to peak, "m/s" r.m.s.
  std::string zone;     ///< the worst of all probes
  std::vector<ZoneVerdict> probes;

  static constexpr std::string_view group = "/zones";
  static constexpr auto columns() {
    using Z = ZoneReport;
    return ColumnList{
        column("class", &Z::of, "", "class of machines"),
        column("si_unit", &Z::si_unit, "", "of values and boundaries: m peak to peak, m/s r.m.s."),
        column("zone", &Z::zone, "", "the worst of all probes"),
        rows(&Z::probes, "zone_probes+").prefixed("probe_")};
  }
};

/// Judges a trend: of one record where the speed is highest, at the points within 2 % of it, of
/// several all. Of these the reading counts that is largest beside its boundaries.
ZoneReport zones_of(const Trend& trend, ZoneClass of);

}  // namespace whirl::inline data
