#include "libio/figures/short_spectra.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/spectrum.hpp"

namespace whirl::inline io::figures {

namespace {

constexpr std::size_t most_hovers = 20000;  ///< points with a text each, for the size of pages
constexpr double powers = 3.0;              ///< of ten that a height shows: 1X would hide all else
constexpr double over_noise = 3.0;          ///< of its median: the largest of 40 spectra is less

}  // namespace

Eigen::Index even_smooth_length(Eigen::Index most) {
  auto count = static_cast<Eigen::Index>(smooth_length(static_cast<long>(most)) / 2 * 2);
  while (count > 2 && smooth_length(static_cast<long>(count)) != count) count -= 2;
  return count;
}

void add_spectrum(const Vec& x, const Vec& y, Eigen::Index from, double spacing, Eigen::Index row,
                  ShortSpectra& to) {
  CVec z(to.count);
  z.real() = x.segment(from, to.count);
  z.imag() = y.segment(from, to.count);
  z.array() -= z.mean();
  const Spectrum spectrum = hann_spectrum(z, spacing);
  to.bin = spectrum.bin;
  to.amplitude.row(row) = spectrum.ascending().cwiseAbs().transpose();
}

double reach_of(const ShortSpectra& s) {
  const Vec most = s.amplitude.colwise().maxCoeff().transpose();
  std::vector<double> upper;
  for (Eigen::Index k = 0; k < s.count; ++k) {
    if (std::abs(k - s.count / 2) > s.count / 4) upper.push_back(most(k));
  }
  double noise = 0.0;
  if (!upper.empty()) {
    const auto middle = upper.begin() + std::ssize(upper) / 2;
    std::nth_element(upper.begin(), middle, upper.end());
    noise = *middle;
  }
  const double least = std::max(1e-3 * most.maxCoeff(), over_noise * noise);
  double reach = 0.0;
  for (Eigen::Index k = 0; k < s.count; ++k) {
    if (most(k) > least) reach = std::max(reach, std::abs(s.frequency(k)));
  }
  return reach;
}

void add_curves(const ShortSpectra& s, const DisplayUnit& in, const DisplayUnit& unit,
                const SpectraPlace& place, double reach, double place_factor, Panel& p) {
  const double largest = s.amplitude.maxCoeff();
  const double range = s.place.back() - s.place.front();
  const double height = (range > 0.0 ? range : 1.0) * 0.09;
  for (std::size_t i = 0; i < s.place.size(); ++i) {
    Curve c{.paint = Paint::forward};
    c.width = 0.9;
    for (Eigen::Index k = place.is_probe() ? s.count / 2 : 0; k < s.count; ++k) {
      if (std::abs(s.frequency(k)) > 1.02 * reach) continue;
      const double a = s.amplitude(static_cast<Eigen::Index>(i), k);
      const double rise = a > 0.0 ? std::max(0.0, 1.0 + std::log10(a / largest) / powers) : 0.0;
      c.x.push_back(in.factor * s.frequency(k));
      c.y.push_back(place_factor * (s.place[i] + height * rise));
      c.hover.push_back(fmt::format("{:.3g} {}", place.factor * unit.factor * a, unit.name));
    }
    if (s.place.size() * c.x.size() > most_hovers) c.hover.clear();
    p.curves.push_back(std::move(c));
  }
}

std::string heights_text(const SpectraPlace& place, const DisplayUnit& unit, double largest) {
  return fmt::format(
      "Heights are logarithmic: from {} {}, the largest {}, down to a thousandth of it.",
      plain_number(place.factor * unit.factor * largest), unit.name,
      place.is_probe() ? "reading, peak to peak" : "radius");
}

}  // namespace whirl::inline io::figures
