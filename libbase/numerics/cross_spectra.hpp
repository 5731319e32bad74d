#pragma once
/// Spectral densities of several channels and between them, averaged over overlapping segments.

#include <vector>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline base {

/// One-sided spectral densities G(f) of channels x(t), E[x_a x_b] = integral of Re G_ab over f.
struct CrossSpectra {
  double bin = 0.0;          ///< distance of neighboring lines [rad/s]
  int segments = 0;          ///< that were averaged
  std::vector<CMat> matrix;  ///< of line k at k * bin: channels x channels, Hermitian [1/Hz, units]

  Eigen::Index size() const { return std::ssize(matrix); }
};

/// Welch's average over segments under a Hann window, each overlapping the next by half.
///
///   G_ab(f_k) = 2 / (1.5 df) mean of X_a(k) conj(X_b(k)),  X under a window of mean 1
///
/// 1.5 lines are the equivalent noise bandwidth of the window. The mean of each channel is removed
/// first.
///
/// @param samples  times x channels
/// @param spacing  time between samples [s]
/// @param length   samples of a segment; cut to a smooth_length() that fits into the record
/// @source [Welch1967]
CrossSpectra cross_spectra(const Mat& samples, double spacing, long length);

}  // namespace whirl::inline base
