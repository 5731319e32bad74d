#pragma once
/// What in a measured motion looks like a mistake in how it was measured or described.

#include <string>
#include <vector>

#include "libdata/measured/measured_spectra.hpp"

namespace whirl::inline data {

/// Adds to notes: probes of one station whose readings differ much in size; a sampling rate too low
/// for what moves; without a key-phasor, a speed at which nothing in the record turns; 1X that
/// turns backward.
///
/// @param spectra  of the readings at these stations
/// @param Omega    of the rotor [rad/s]
void add_doubts(const ProbeReadings& readings, const std::vector<ProbedStation>& stations,
                const MeasuredSpectra& spectra, double Omega, std::vector<std::string>& notes);
/// The same for probes on a rotor.
void add_doubts(const ProbeReadings& readings, const Assembler& assembler, double Omega,
                std::vector<std::string>& notes);

}  // namespace whirl::inline data
