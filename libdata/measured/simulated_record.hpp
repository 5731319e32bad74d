#pragma once
/// What a measurement of a simulated motion would have recorded.

#include <cstdint>

#include "libdata/measured/probe_readings.hpp"
#include "libdyn/motions/run_result.hpp"

namespace whirl::inline data {

/// Noise of channels.
struct ChannelNoise {
  double share = 0.0;      ///< standard deviation over that of the signal
  std::uint64_t seed = 1;  ///< each channel has a sequence of its own
};

/// A record of a run: a channel per probe, by its gain, and a channel of the key-phasor. Its pulses
/// are twice as high as the threshold, or 1 high without a threshold, and their edge crosses half
/// of the height where the rotor is at the key-phasor's angle. Channels that are named by a number
/// have that place, others the places between.
///
/// @pre  run.has_motion()
/// @throws OptionError  for more pulses than samples can show
MeasuredRecord simulated_record(const Run& run, const MeasurementSetup& setup,
                                const ChannelNoise& noise);

}  // namespace whirl::inline data
