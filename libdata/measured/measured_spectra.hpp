#pragma once
/// Spectra of a measured motion, of its probes and of their stations.

#include <vector>

#include "libdata/measured/probe_readings.hpp"
#include "libdata/measured/station_motion.hpp"

namespace whirl::inline data {

struct MeasuredSpectra {
  double bin = 0.0;  ///< distance of lines [rad/s]
  CMat probes;       ///< lines x probes, of their readings [m]
  CMat stations;     ///< lines x stations, of x + i y [m]

  /// The row of a line, which may be negative.
  Eigen::Index row(Eigen::Index k) const {
    return (k % probes.rows() + probes.rows()) % probes.rows();
  }
};

/// Spectra under a Hann window over the longest part at the end of the record with whole
/// revolutions, where samples go evenly into these; else over all but a few samples.
///
/// @param Omega  of the rotor [rad/s]
MeasuredSpectra spectra_of(const ProbeReadings& readings,
                           const std::vector<ProbedStation>& stations, double Omega);

}  // namespace whirl::inline data
