#include "libbase/numerics/cross_spectra.hpp"

#include <algorithm>

#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/spectrum.hpp"

namespace whirl::inline base {

CrossSpectra cross_spectra(const Mat& samples, double spacing, long length) {
  constexpr double noise_bandwidth = 1.5;  // of the Hann window, in lines
  const auto channels = samples.cols();
  const Eigen::Index n = smooth_length(std::min<long>(length, samples.rows()));
  const Eigen::Index step = std::max<Eigen::Index>(1, n / 2), lines = n / 2 + 1;
  const Eigen::RowVectorXd mean = samples.colwise().mean();

  CrossSpectra found;
  found.bin = turn / (static_cast<double>(n) * spacing);
  found.matrix.assign(static_cast<std::size_t>(lines), CMat::Zero(channels, channels));
  CMat of_segment(channels, lines);
  for (Eigen::Index first = 0; first + n <= samples.rows(); first += step) {
    for (Eigen::Index c = 0; c < channels; ++c) {
      const Vec part = samples.col(c).segment(first, n).array() - mean(c);
      const Spectrum spectrum = hann_spectrum(part.cast<Complex>(), spacing);
      of_segment.row(c) = spectrum.lines.head(lines).transpose();
    }
    for (Eigen::Index k = 0; k < lines; ++k) {
      found.matrix[static_cast<std::size_t>(k)] += of_segment.col(k) * of_segment.col(k).adjoint();
    }
    ++found.segments;
  }
  const double df = found.bin / turn;
  for (CMat& G : found.matrix) G *= 2.0 / (noise_bandwidth * df * found.segments);
  found.matrix.front() *= 0.5;  // zero, and the highest of an even number, have no negative partner
  if (n % 2 == 0) found.matrix.back() *= 0.5;
  return found;
}

}  // namespace whirl::inline base
