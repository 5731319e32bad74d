#pragma once
/// Periodic motions as Fourier series.

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline base {

/// 1, cos theta, sin theta, cos 2 theta, sin 2 theta, ... up to harmonic H: 2 H + 1 functions.
Vec harmonic_functions(double theta, int harmonics);

/// Derivatives of harmonic_functions by theta.
Vec harmonic_slopes(double theta, int harmonics);

/// Coefficients of values at evenly spaced angles from 0 on.
///
/// @param values     a column for each angle, more than 2 H of them
/// @return           rows x (2 H + 1)
Mat fourier_coefficients(const Mat& values, int harmonics);

/// Coefficients of the derivative by theta.
Mat differentiated(const Mat& coefficients);

/// A series with another number of harmonics: cut off, or filled up with zeros.
Mat with_harmonics(const Mat& coefficients, int harmonics);

/// A motion with a period of some revolutions, x = sum_k c_k phi_k(theta), theta = phase / period.
struct Periodic {
  Mat coefficients;   ///< displacements x (2 H + 1), of harmonic_functions
  int period = 1;     ///< [revolutions]
  double rate = 1.0;  ///< of the phase [rad/s]

  int harmonics() const { return static_cast<int>(coefficients.cols() / 2); }
  /// Rate of the angle theta, which is the frequency of the motion [rad/s].
  double frequency() const { return rate / period; }
  double phase(double theta) const { return theta * period; }
  /// Displacements and their rates.
  struct Instant {
    Vec x, rate;
  };
  Instant at(double theta) const;
};

}  // namespace whirl::inline base
