#pragma once
/// What a record of a steady run says to who balances: 1X of every probe, and signs of a rub.

#include <string>
#include <vector>

#include "libdata/measured/probe_readings.hpp"

namespace whirl::inline data {

struct RunReadings {
  double speed = 0.0;  ///< mean [rad/s]
  CVec vectors;        ///< 1X per probe, reading = Re(V e^(i theta)) [m]
  /// Why the vibration does not follow its unbalance linearly, a sentence each: motion near
  /// 1/4, 1/3, 1/2, 2/3 or 3/4 of the speed, or a signal that rests at its largest or smallest
  /// value.
  std::vector<std::string> signs_of_rub;
};

/// Share of 1X from which motion at a part of the speed is a sign of a rub.
constexpr double most_subharmonic = 0.1;

/// Takes 1X as the mean over the record, as track_orders finds it from 24 revolutions each.
///
/// @throws OptionError  for readings without a key-phasor, for a speed that changes by more than 2
/// %,
///                      and as track_orders
RunReadings run_readings(const ProbeReadings& readings);

}  // namespace whirl::inline data
