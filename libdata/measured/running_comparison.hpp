#pragma once
/// Running modes of a rotor with probes, beside the modes of its model.

#include "libdata/measured/measured_identification.hpp"
#include "libdata/measured/running_modes.hpp"

namespace whirl::inline data {

/// Running modes from the readings of probes. If there is a key-phasor, it gives the phase of the
/// rotor, and only the record between its first and last pulse counts.
///
/// @param options  with a speed for records without a key-phasor; channels and phase are set here
/// @throws ModelError, OptionError  as running_modes
RunningModes running_modes(const ProbeReadings& readings, RunningModesOptions options);

/// Says of each running mode which mode of the model it is most like, by what the probes read of
/// both (of modes that probes cannot tell apart, the nearest in frequency), and its sense of whirl
/// where a station has probes in two directions.
void compare(RunningModes& found, const MeasuredIdentification& measured,
             const ProbeReadings& readings, const Assembler& assembler);

}  // namespace whirl::inline data
