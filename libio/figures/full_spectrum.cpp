#include "libio/figures/full_spectrum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::inline io::figures {

Figure full_spectrum(const ResultView& result, const std::string& station, const Vec& frequency,
                     const Vec& amplitude, const DisplayUnit& unit) {
  const double speed = speed_of(result);
  const bool spins = std::isfinite(speed) && speed > 0.0 && !run_up_of(result);
  const double largest = amplitude.maxCoeff();
  Figure f{.variant = station, .width = 860.0, .height = 430.0};
  f.subtitle =
      fmt::format("{}: full spectrum{}, backward left, forward right", station, at_speeds(result));
  Panel p;
  p.cursor = "frequency";
  const DisplayUnit in = result.frequency;
  p.x.title = with_unit("whirl frequency", in);
  p.y = {.title = with_unit("radius", unit), .scale = Scale::logarithmic};
  p.y.first = std::pow(10.0, std::floor(std::log10(1e-4 * largest * unit.factor)));
  p.y.last = std::pow(10.0, std::ceil(std::log10(1.3 * largest * unit.factor)));
  Curve c{.paint = Paint::forward, .x = scaled(numbers(frequency), in.factor)};
  c.y = scaled(numbers(amplitude), unit.factor);
  c.width = 1.2;
  if (spins) p.x.also_unit = "X", p.x.also_factor = 1.0 / (in.factor * speed);
  // lines that are maxima, the strongest with their names
  std::vector<std::size_t> peaks;
  for (std::size_t j = 1; j + 1 < c.y.size(); ++j) {
    if (c.y[j] > c.y[j - 1] && c.y[j] >= c.y[j + 1] && c.y[j] > 1e-3 * largest * unit.factor)
      peaks.push_back(j);
  }
  std::sort(peaks.begin(), peaks.end(),
            [&](std::size_t a, std::size_t b) { return c.y[a] > c.y[b]; });
  double reach = 0.0;  // of what is worth seeing
  for (const std::size_t j : peaks) reach = std::max(reach, 1.15 * std::abs(c.x[j]));
  if (spins) reach = std::max(reach, 2.2 * speed * in.factor);
  reach = std::min(reach, c.x.empty() ? 1.0 : std::max(c.x.back(), 1e-9));
  p.x.first = -reach;
  p.x.last = reach;
  std::vector<double> named;
  for (const std::size_t j : peaks) {
    const bool is_near = std::any_of(named.begin(), named.end(), [&](double other) {
      return std::abs(other - c.x[j]) < 0.09 * reach;
    });
    if (is_near || named.size() == 7) continue;
    named.push_back(c.x[j]);
    p.labels.push_back(
        {c.x[j], c.y[j],
         with_minus(spins ? fmt::format("{:+.3g}X", frequency(static_cast<Eigen::Index>(j)) / speed)
                          : fmt::format("{:+.4g} {}", c.x[j], in.name)),
         Anchor::middle, 0.0, -7.0});
  }
  p.rules.push_back({Rule::Kind::vertical, 0.0, "", Paint::ink, Dash::solid});
  if (spins) {
    p.rules.push_back({Rule::Kind::vertical, speed * in.factor, "+1X", Paint::gray, Dash::dotted});
    p.rules.push_back({Rule::Kind::vertical, -speed * in.factor, "−1X", Paint::gray, Dash::dotted});
  }
  p.curves.push_back(std::move(c));
  f.panels.push_back(std::move(p));
  return f;
}

}  // namespace whirl::inline io::figures
