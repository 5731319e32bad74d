#pragma once
/// Records of steady motions: many periods averaged to one.

#include "libdata/fit/fit_problem.hpp"

namespace whirl::inline data {

struct SteadyOptions {
  int revolutions = 1;  ///< of a period
  int readings = 0;     ///< of the period; 0: as many as it has samples, up to 256 a revolution
};

/// A period of a steady motion, and what it was averaged from.
struct SteadyRecord {
  FitRecord period;  ///< for fits; its noise is the standard error of each reading
  int periods = 0;   ///< whole periods in the record, all of which were averaged
  Vec scatter;       ///< of a sample about the average, root mean square per probe [m]
  /// Difference of the averages over the first and over the second half, root mean square per probe
  /// [m].
  Vec drift;
};

/// Averages a record over its periods.
///
/// Samples are sorted by the angle that the rotor has gone through in its period, into as many bins
/// as a period has samples. A reading is the mean of its bin, corrected for where in the bin its
/// samples were:
///
///   reading_b = s(angle_b) + mean over the samples i of bin b of (sample_i - s(angle_i))
///
/// where angle_b is the mean angle of these samples, and s the Fourier series that has the same
/// means and an eighth as many harmonics as there are bins. Where samples go evenly into the
/// period, a reading is their plain mean, whatever harmonics the motion has. Else the harmonics of
/// s give the reading no bias, and a higher harmonic k one of up to k^2 pi^2 / (6 bins^2) of its
/// amplitude. The errors of readings are independent if those of samples are.
///
/// The standard error of a probe's readings is taken from what differs between periods, so that
/// noise that is correlated over a few samples counts as it should. An unknown offset (FitRecord)
/// may wander: what the mean of a period differs by from the mean of the record is taken off.
///
/// A motion counts as steady if samples scatter about the average by no more than 1.5 times the
/// noise (FitRecord::noise; where that is empty or zero, from differences of successive samples),
/// and if the averages over the two halves of the record, over every second and over every third
/// period differ by no more than chance lets them (six deviations).
///
/// @param record  noise may be empty; samples with a probe missing are left out
/// @param speed   of the rotor [rad/s]
/// @throws ModelError  for fewer than four periods or eight samples a revolution, for a probe
///                     without readings, and for motions that are not steady, with figures and, if
///                     there is one up to four times as long, with the period after which they
///                     repeat
SteadyRecord steady_record(const FitRecord& record, double speed,
                           const SteadyOptions& options = {});

}  // namespace whirl::inline data
