#pragma once
/// What probes read of a simulation, as they would of a machine.

#include "libdata/measured/probe_readings.hpp"
#include "libdyn/motions/run_result.hpp"

namespace whirl::inline data {

/// Readings of a run with a key-phasor whose mark is seen at angle 0: those of the probes of the
/// model, or if it has none, of two at each recorded station, along x and y.
///
/// @pre  run.has_motion(); the rotor spins and made three revolutions or more, else there is no
///       clock
ProbeReadings readings_of(const Model& model, const Run& run);

}  // namespace whirl::inline data
