#include "libdata/measured/decomposition.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/dense.hpp"

namespace whirl::inline data {

namespace {

/// Correlation of a Hann window of length one with itself, 1 at 0.
double hann_correlation(double t) {
  constexpr double pi = std::numbers::pi;
  return (1.0 - t) * (2.0 + std::cos(2.0 * pi * t)) / 3.0 + std::sin(2.0 * pi * t) / (2.0 * pi);
}

/// Lowest value between a line and the next higher one to a side; of the highest line, to the end.
double lowest_towards(const Vec& values, Eigen::Index from, Eigen::Index step) {
  double least = values(from);
  for (Eigen::Index k = from + step; k >= 0 && k < values.size(); k += step) {
    if (values(k) > values(from)) break;
    least = std::min(least, values(k));
  }
  return least;
}

/// A straight line through points, by least squares.
struct Slope {
  double n = 0.0, t = 0.0, tt = 0.0, y = 0.0, ty = 0.0;
  void add(double time, double value) {
    n += 1.0, t += time, tt += time * time, y += value, ty += time * value;
  }
  double value() const { return (n * ty - t * y) / (n * tt - t * t); }
};

/// Lines of one oscillator around its highest one.
struct Bell {
  Vec values;
  Eigen::Index first = 0, peak = 0;  ///< numbers of lines
};

Bell bell_around(const CrossSpectra& spectra, const CVec& u, Eigen::Index peak) {
  constexpr double low = 1.0 / 30.0, rise = 2.0;  // of the peak; over the lowest line so far
  const auto along = [&](Eigen::Index k) {
    return u.dot(spectra.matrix[static_cast<std::size_t>(k)] * u).real();
  };
  const double top = along(peak);
  const auto end = [&](Eigen::Index step) {
    double least = top;
    Eigen::Index k = peak;
    while (k + step > 0 && k + step < spectra.size()) {
      const double next = along(k + step);
      if (next < low * top || next > rise * least) break;
      least = std::min(least, next);
      k += step;
    }
    return k;
  };
  const Eigen::Index first = end(-1), last = end(1);
  Bell bell{Vec(last - first + 1), first, peak};
  for (Eigen::Index k = first; k <= last; ++k) bell.values(k - first) = along(k);
  return bell;
}

/// Eigenvalue of the oscillator that has a bell; nothing known: NaN.
Complex eigenvalue_of(const Bell& bell, double bin) {
  constexpr Eigen::Index few = 5;
  constexpr double from = 0.9, to = 0.3;  // of the start
  constexpr int least = 6;                // points of a straight line
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (bell.values.size() < few) return {nan, nan};
  const double window = turn / bin;  // its length
  const double step = window / (4.0 * static_cast<double>(bell.values.size()));
  Slope size, angle;
  double before = 0.0, turned = 0.0;
  for (double t = step; t < 0.5 * window; t += step) {
    Complex r = 0.0;
    for (Eigen::Index k = 0; k < bell.values.size(); ++k) {
      r += std::polar(bell.values(k), static_cast<double>(bell.first + k - bell.peak) * bin * t);
    }
    r /= bell.values.sum() * hann_correlation(t / window);
    turned += std::remainder(std::arg(r) - before, turn);
    before = std::arg(r);
    if (std::abs(r) < to) break;
    if (std::abs(r) > from) continue;
    size.add(t, std::log(std::abs(r)));
    angle.add(t, turned);
  }
  if (size.n < least) return {nan, nan};
  return {size.value(), static_cast<double>(bell.peak) * bin + angle.value()};
}

}  // namespace

Decomposition decomposed(const CrossSpectra& spectra) {
  const auto channels = spectra.matrix.front().rows();
  Decomposition d;
  d.bin = spectra.bin;
  d.values.resize(channels, spectra.size());
  d.first.resize(channels, spectra.size());
  for (Eigen::Index k = 0; k < spectra.size(); ++k) {
    const auto modes = hermitian_modes(spectra.matrix[static_cast<std::size_t>(k)]);
    d.values.col(k) = modes.values.reverse().cwiseMax(0.0);
    d.first.col(k) = modes.vectors.col(channels - 1);
  }
  return d;
}

std::vector<DecomposedMode> decomposed_modes(const CrossSpectra& spectra, const Decomposition& d) {
  constexpr Eigen::Index apart = 3;
  const double prominence = 3.0 * std::exp(4.0 / std::sqrt(spectra.segments));
  const Vec values = d.values.row(0);
  const auto lines = values.size();
  std::vector<DecomposedMode> modes;
  for (Eigen::Index k = apart; k + apart < lines; ++k) {
    if (values.segment(k - apart, 2 * apart + 1).maxCoeff() > values(k)) continue;
    const double foot = std::max(lowest_towards(values, k, -1), lowest_towards(values, k, 1));
    if (values(k) < prominence * foot) continue;
    DecomposedMode mode;
    mode.shape = d.first.col(k);
    mode.line = static_cast<double>(k) * d.bin;
    mode.height = values(k);
    mode.lambda = eigenvalue_of(bell_around(spectra, mode.shape, k), d.bin);
    modes.push_back(std::move(mode));
  }
  return modes;
}

}  // namespace whirl::inline data
