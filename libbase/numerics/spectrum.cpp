#include "libbase/numerics/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/FFT>

namespace whirl::inline base {

long smooth_length(long n) {
  for (; n > 1; --n) {
    long rest = n;
    for (const long p : {2L, 3L, 5L}) {
      while (rest % p == 0) rest /= p;
    }
    if (rest == 1) return n;
  }
  return n;
}

long whole_revolutions(long samples, long each) {
  return each < 1 || samples < each ? smooth_length(samples) : smooth_length(samples / each) * each;
}

CVec Spectrum::ascending() const {
  CVec all(size());
  for (Eigen::Index k = 0; k < size(); ++k) all(k) = at(k - size() / 2);
  return all;
}

Vec signed_frequencies(Eigen::Index count, double bin) {
  Vec all(count);
  for (Eigen::Index k = 0; k < count; ++k) all(k) = static_cast<double>(k - count / 2) * bin;
  return all;
}

Spectrum hann_spectrum(const CVec& samples, double spacing) {
  const auto n = samples.size();
  CVec windowed(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(n);
    windowed(j) = (1.0 - std::cos(angle)) * samples(j);  // mean of the window is one
  }
  Spectrum spectrum;
  spectrum.bin = 2.0 * std::numbers::pi / (static_cast<double>(n) * spacing);
  spectrum.lines.resize(n);
  Eigen::FFT<double> fft;
  fft.fwd(spectrum.lines.data(), windowed.data(), n);
  spectrum.lines /= static_cast<double>(n);
  return spectrum;
}

std::vector<Peak> find_peaks(const Vec& magnitude, double bin, double share, int most) {
  const auto n = magnitude.size();
  std::vector<Peak> peaks;
  if (n < 8) return peaks;
  const double least = share * magnitude.maxCoeff();
  const auto at = [&](Eigen::Index k) { return magnitude((k % n + n) % n); };
  for (Eigen::Index k = 0; k < n; ++k) {
    const double here = at(k);
    if (here <= least || here <= 0.0) continue;
    if (at(k - 1) > here || at(k + 1) >= here || at(k - 2) > here || at(k + 2) >= here) continue;
    const bool right = at(k + 1) > at(k - 1);
    const double ratio = (right ? at(k + 1) : at(k - 1)) / here;
    const double offset = std::clamp((2.0 * ratio - 1.0) / (ratio + 1.0), 0.0, 0.5);
    // transform of the window at the offset: sin(pi d) / (pi d (1 - d^2))
    const double x = std::numbers::pi * offset;
    const double loss = offset < 1e-9 ? 1.0 : std::sin(x) / (x * (1.0 - offset * offset));
    const Eigen::Index signed_bin = k < (n + 1) / 2 ? k : k - n;
    peaks.push_back({(static_cast<double>(signed_bin) + (right ? offset : -offset)) * bin,
                     here / loss, signed_bin});
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Peak& a, const Peak& b) { return a.amplitude > b.amplitude; });
  if (static_cast<int>(peaks.size()) > most) peaks.resize(static_cast<std::size_t>(most));
  return peaks;
}

}  // namespace whirl::inline base
