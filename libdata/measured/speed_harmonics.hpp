#pragma once
/// What the rotor's turning puts into every record: harmonics of its speed, which are no modes.

#include <vector>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline data {

/// Phase of a rotor of constant speed, Omega t, from 0 on [rad].
Vec constant_speed_phase(double Omega, double spacing, Eigen::Index samples);

/// Mean speed over a record [rad/s].
double mean_speed(const Vec& phase, double spacing);

/// A constant speed, found more closely than it was given, within half a per cent of that.
///
/// Of the peaks at harmonics of the speed, in the spectra of the whole record, the one that stands
/// highest above its surroundings is located between the bins and gives the speed. Where no peak
/// stands ten times above its surroundings, the speed stays as it was given.
double refined_speed(const Mat& samples, double spacing, double Omega, int harmonics);

/// Takes the mean and the parts that turn with the rotor out of each channel:
///
///   y(t) - sum over k = 0 ... harmonics of (a_k cos(k phase) + b_k sin(k phase))
///
/// with a_k and b_k by least squares over the whole record. What is taken out is the average over
/// revolutions, whose samples need not be at equal angles. Harmonics at or above half the sampling
/// rate are left out.
///
/// @param samples  times x channels
/// @param phase    of the rotor at the samples [rad], as from a key-phasor
/// @source [Braun1975], synchronous averaging; before modal analysis [Peeters2007]
Mat without_harmonics(const Mat& samples, const Vec& phase, int harmonics);

/// Magnitude of the damping ratio below which a pole is that of a line, of a motion that goes on
/// forever.
constexpr double line_damping = 0.002;

/// The harmonic of a speed that a pole is; 0: none.
///
/// A harmonic is a line: its pole has hardly any damping. A mode that happens to lie at a harmonic
/// is told apart by its damping.
///
/// @param tolerance  relative distance of the frequencies
int harmonic_at(double frequency, double damping_ratio, double speed, int harmonics,
                double tolerance);

}  // namespace whirl::inline data
