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
  int periods = 0;   ///< whole ones in the record, as many were averaged
  Vec scatter;       ///< of a sample about the average, root mean square per probe [m]
  /// Between the averages over the first and over the second half, root mean square per probe [m].
  Vec drift;
};

/// Averages a record over its periods.
///
/// Samples are sorted by the angle that the rotor has gone through in its period, into as many bins
/// as a period has samples. A reading is the mean of its bin, corrected for where in the bin they
/// were:
///
///   reading_b = s(angle_b) + mean over the samples i of bin b of (sample_i - s(angle_i))
///
/// angle_b their mean angle, s the Fourier series of an eighth as many harmonics as there are bins
/// that has the same means. Where samples go evenly into the period it is their plain mean,
/// whatever harmonics the motion has; else it is without bias for all harmonics of s, and of
/// harmonic k above them to k^2 pi^2 / (6 bins^2) of its amplitude. Readings have independent
/// errors if samples have.
///
/// The standard error of a probe's readings is taken from what differs between periods, so that
/// noise that is alike within a few samples counts as it should. An unknown offset (FitRecord) may
/// wander: it is taken off period by period.
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
