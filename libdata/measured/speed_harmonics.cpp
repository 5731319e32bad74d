#include "libdata/measured/speed_harmonics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libbase/numerics/dense.hpp"
#include "libbase/numerics/fourier.hpp"
#include "libbase/numerics/spectrum.hpp"

namespace whirl::inline data {

Vec constant_speed_phase(double Omega, double spacing, Eigen::Index samples) {
  return Vec::LinSpaced(samples, 0.0, Omega * spacing * static_cast<double>(samples - 1));
}

double mean_speed(const Vec& phase, double spacing) {
  return (phase(phase.size() - 1) - phase(0)) / (spacing * static_cast<double>(phase.size() - 1));
}

double refined_speed(const Mat& samples, double spacing, double Omega, int harmonics) {
  constexpr double within = 0.005;  // of the given speed
  constexpr double stands_out = 10.0;
  constexpr Eigen::Index around = 20;  // lines that a peak stands out of
  const Eigen::Index n = smooth_length(samples.rows());
  double refined = Omega, best = 0.0;
  for (Eigen::Index c = 0; c < samples.cols(); ++c) {
    const Vec part = samples.col(c).head(n).array() - samples.col(c).head(n).mean();
    const Spectrum s = hann_spectrum(part.cast<Complex>(), spacing);
    const Vec size = s.lines.head(n / 2).cwiseAbs();
    for (int k = 1; k <= harmonics; ++k) {
      const double line = k * Omega / s.bin;
      const auto reach = std::max<Eigen::Index>(2, std::lround(within * line));
      const auto first = std::lround(line) - reach - around, count = 2 * (reach + around) + 1;
      if (first < 1 || first + count > size.size()) continue;
      const Vec near = size.segment(first, count);
      Eigen::Index top = 0;
      near.segment(around, 2 * reach + 1).maxCoeff(&top);
      const double height = near(top + around) / near.mean();
      if (height < stands_out || height <= best) continue;
      for (const Peak& p : find_peaks(size.segment(first, count), s.bin, 0.5, 4)) {
        const auto bin = p.bin >= 0 ? p.bin : p.bin + count;
        if (bin != top + around) continue;
        const double offset = p.frequency / s.bin - static_cast<double>(p.bin);
        refined = (static_cast<double>(first + bin) + offset) * s.bin / k;
        best = height;
      }
    }
  }
  return refined;
}

Mat without_harmonics(const Mat& samples, const Vec& phase, int harmonics) {
  const auto n = samples.rows();
  const double per_sample = (phase(n - 1) - phase(0)) / static_cast<double>(n - 1);
  const int most = static_cast<int>(std::ceil(std::numbers::pi / std::abs(per_sample))) - 1;
  const int kept = std::min(harmonics, most);
  constexpr Eigen::Index block =
      4096;  // rows at a time, so that memory does not grow with harmonics
  const Eigen::Index size = 2 * kept + 1;
  const auto functions_of = [&](Eigen::Index first) {
    Mat functions(std::min(block, n - first), size);
    for (Eigen::Index t = 0; t < functions.rows(); ++t) {
      functions.row(t) = harmonic_functions(phase(first + t), kept).transpose();
    }
    return functions;
  };
  // normal equations: the functions are orthogonal over revolutions, nearly
  Mat gram = Mat::Zero(size, size), products = Mat::Zero(size, samples.cols());
  for (Eigen::Index first = 0; first < n; first += block) {
    const Mat functions = functions_of(first);
    gram += functions.transpose() * functions;
    products += functions.transpose() * samples.middleRows(first, functions.rows());
  }
  const Mat amplitudes = DenseLu<Mat>(gram).solve(products);
  Mat rest = samples;
  for (Eigen::Index first = 0; first < n; first += block) {
    const Mat functions = functions_of(first);
    rest.middleRows(first, functions.rows()) -= functions * amplitudes;
  }
  return rest;
}

int harmonic_at(double frequency, double damping_ratio, double speed, int harmonics,
                double tolerance) {
  if (!(speed > 0.0) || std::abs(damping_ratio) > line_damping) return 0;
  const int k = static_cast<int>(std::lround(frequency / speed));
  if (k < 1 || k > harmonics) return 0;
  return std::abs(frequency - k * speed) <= tolerance * frequency ? k : 0;
}

}  // namespace whirl::inline data
