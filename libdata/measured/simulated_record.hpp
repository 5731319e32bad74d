#pragma once
/// What a measurement of a simulated motion would have recorded.

#include <cstdint>

#include "libdata/measured/probe_readings.hpp"
#include "libdyn/motions/run_result.hpp"

namespace whirl::inline data {

/// Noise of channels.
struct ChannelNoise {
  double share = 0.0;      ///< standard deviation, of that of the signal without noise
  std::uint64_t seed = 1;  ///< each channel has a sequence of its own
};

/// A record of a run: a channel per probe as its gain says, and of the key-phasor pulses of height
/// one, whose edge crosses one half where the rotor is at its angle. Channels that are numbers are
/// at these places, others by their names in between.
///
/// @pre  run.has_motion()
/// @throws OptionError  for more pulses than samples can show
MeasuredRecord simulated_record(const Run& run, const MeasurementSetup& setup,
                                const ChannelNoise& noise);

}  // namespace whirl::inline data
