#pragma once
/// Signed spectra: one complex transform of z = x + i y, forward frequencies positive.

#include <vector>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline base {

/// Spectrum of equally spaced samples under a Hann window.
struct Spectrum {
  double bin = 0.0;  ///< distance of neighboring lines [rad/s]
  CVec lines;        ///< amplitude of line k at k * bin, k = 0 ... N/2-1, then -N/2 ... -1

  Eigen::Index size() const { return lines.size(); }
  /// Line at a signed number, -N/2 <= k < N/2 (and beyond, cyclic).
  Complex at(Eigen::Index k) const { return lines((k % size() + size()) % size()); }
  /// All lines by ascending frequency, the line -N/2 first, as signed_frequencies() has them.
  CVec ascending() const;
};

/// Frequencies of so many lines, ascending from -N/2 bins [rad/s].
Vec signed_frequencies(Eigen::Index count, double bin);

/// A line that stands out, located between the bins.
struct Peak {
  double frequency = 0.0;  ///< signed [rad/s]
  double amplitude = 0.0;  ///< radius of the circle that turns at this frequency
  Eigen::Index bin = 0;    ///< nearest bin, signed
};

/// Largest number up to n with no prime factor above five.
long smooth_length(long n);

/// How many of the last samples of a motion a spectrum is made of: a smooth_length() of whole
/// revolutions, so that harmonics of the speed are lines; if there is less than one revolution, a
/// smooth_length() of samples.
/// @param each  samples of a revolution
long whole_revolutions(long samples, long each);

/// Windowed spectrum of complex samples; a constant c gives a line c at zero.
/// @param spacing  time between samples [s]
/// @pre    samples.size() has no prime factor above five (see smooth_length)
Spectrum hann_spectrum(const CVec& samples, double spacing);

/// Local maxima above a share of the largest, strongest first.
///
/// Between bins a pure tone under a Hann window has lines of ratio a = |X_1| / |X_0|; its place is
/// (2 a - 1) / (a + 1) and its amplitude follows from the window's transform.
///
/// @param magnitude  per bin, in the order of Spectrum::lines
/// @param bin        distance of the bins [rad/s]
/// @param share      of the largest magnitude, below which nothing counts
/// @param most       how many at most
/// @source [Grandke1983], interpolation of windowed spectra
std::vector<Peak> find_peaks(const Vec& magnitude, double bin, double share, int most);

}  // namespace whirl::inline base
