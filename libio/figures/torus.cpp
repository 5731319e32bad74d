#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "libdyn/studies/torus_result.hpp"
#include "libio/figures/common.hpp"
#include "libio/figures/result_of.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

struct Ratio {
  int p = 0, q = 1;
  double value() const { return static_cast<double>(p) / q; }
};

/// The ratios of small integers within a range, those of the smallest denominators.
std::vector<Ratio> ratios_within(double low, double high) {
  constexpr int largest = 40;
  constexpr std::size_t most = 6;
  std::vector<Ratio> found;
  if (!(high - low < most && std::abs(low) < 1e6)) return found;  // no part of a walk
  for (int q = 1; q <= largest; ++q) {
    if (found.size() >= most) break;
    for (int p = static_cast<int>(std::ceil(low * q)); p <= high * q; ++p) {
      if (std::gcd(p, q) == 1) found.push_back({p, q});
    }
  }
  return found;
}

std::vector<Figure> torus_figures(const ResultView& result) {
  const ShownAxis axis = shown_axis(result, dataset_of<TorusResult>(&CirclePoint::value));
  const auto& torus = result_of<TorusResult>(result);
  std::vector<double> rotation, exponent;
  for (const CircleRow& c : torus.circles) {
    rotation.push_back(c.rotation);
    exponent.push_back(c.growth);
  }
  const auto panel = [&](const std::string& title, std::vector<double> y) {
    Panel p;
    p.x.title = axis.title;
    p.y.title = title;
    p.cursor = "parameter";
    Curve c{.paint = series_paint(0), .x = axis.values, .y = std::move(y)};
    c.has_marker = true;
    c.size = 4.0;
    for (const CircleRow& at : torus.circles) {
      c.hover.push_back(fmt::format("circle {}: rotation {:.9f}, exponent {:+.5g}, tail {:.1e}",
                                    c.hover.size() + 1, at.rotation, at.growth, at.tail));
    }
    p.curves.push_back(std::move(c));
    return p;
  };
  Figure f{.height = 620.0};
  f.subtitle = fmt::format("Quasi-periodic motion along {}", axis.path);
  Panel r = panel("rotation [turns/rev]", rotation);
  r.share = 1.8;
  const auto [low, high] = std::minmax_element(rotation.begin(), rotation.end());
  // a circle of the n-th return turns by n times as much from one to the next: it locks there
  const double room = 0.03 * (*high - *low);
  for (const Ratio& ratio :
       ratios_within((*low - room) * torus.period, (*high + room) * torus.period)) {
    const int q = ratio.q * torus.period, by = std::gcd(ratio.p, q);
    r.rules.push_back({Rule::Kind::horizontal, ratio.value() / torus.period,
                       fmt::format("{}/{}", ratio.p / by, q / by), Paint::gray, Dash::dotted});
  }
  f.panels.push_back(std::move(r));
  Panel e = panel("largest exponent [1/rev]", exponent);
  e.rules.push_back({Rule::Kind::horizontal, 0.0, "", Paint::ink, Dash::solid});
  f.panels.push_back(std::move(e));
  f.notes.push_back(
      "Below zero the circle attracts. At a ratio p/q of small integers it may lock to orbits that "
      "repeat after q revolutions.");
  return {f};
}

}  // namespace

FigureKind torus_kind() {
  return {
      .name = "torus",
      .title = "Quasi-periodic",
      .summary = "rotation and largest exponent of a quasi-periodic motion along a parameter",
      .needs = {dataset_of<TorusResult>(&CirclePoint::value)},
      .make = torus_figures,
  };
}

}  // namespace whirl::inline io
