#include "libbase/numerics/band_filter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/FFT>

namespace whirl::inline base {

Vec band_passed(const Vec& samples, double spacing, double low, double high) {
  const Eigen::Index n = samples.size();
  if (n < 2) return Vec::Zero(n);
  Eigen::FFT<double> fft;
  const CVec signal = samples.cast<Complex>();
  CVec lines(n), kept(n);
  fft.fwd(lines.data(), signal.data(), n);
  const double bin = 2.0 * std::numbers::pi / (static_cast<double>(n) * spacing);
  constexpr double rounding = 1e-9;  // of a bin
  for (Eigen::Index k = 0; k < n; ++k) {
    const double line = static_cast<double>(std::min(k, n - k));
    if (line * bin < low - rounding * bin || line * bin > high + rounding * bin) lines(k) = 0.0;
  }
  fft.inv(kept.data(), lines.data(), n);
  return kept.real();
}

}  // namespace whirl::inline base
