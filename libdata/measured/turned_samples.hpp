#pragma once
/// Samples of a record at which the angle of the rotor is known.

#include "libdata/measured/probe_readings.hpp"

namespace whirl::inline data {

/// Angles of the rotor at the samples of a record between the first pulse and the last one.
struct TurnedSamples {
  Eigen::Index first = 0;  ///< number of the first one in the record
  Vec angle;               ///< [rad]
};

/// @param clock  its pulses may lie before the first sample and behind the last one
TurnedSamples turned_samples(const ProbeReadings& readings, const TurnClock& clock);

}  // namespace whirl::inline data
