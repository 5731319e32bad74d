#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libio/figures/result_of.hpp"
#include "libio/figures/sweep_view.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

constexpr double near_zero = 0.5;  ///< [1/revolution], of the panel that tells kinds apart

/// All exponents of one way of a sweep, the largest first.
Figure exponents_of_way(const SweepView& v, std::size_t way) {
  const std::string name = way_style(v.ways[way]).name;
  Figure f{.variant = v.ways.size() > 1 ? name : "", .height = 620.0};
  f.subtitle = fmt::format("Lyapunov exponents along {}, {}", v.axis.path, name);
  const std::size_t values = v.axis.values.size();
  std::size_t most = 0;
  for (std::size_t i = 0; i < values; ++i) {
    const SweepPoint* point = v.point(way * values + i);
    if (point) most = std::max(most, point->motion.exponents.size());
  }
  std::vector<Curve> curves(most);
  for (std::size_t k = 0; k < most; ++k) {
    Curve& c = curves[k];
    c.name = fmt::format("{}", k + 1);
    c.paint = series_paint(k);
    c.x = v.axis.values;
    c.width = k == 0 ? 1.8 : 1.1;
    if (k % 2 == 1) c.dash = Dash::dashed;
    for (std::size_t i = 0; i < values; ++i) {
      const SweepPoint* point = v.point(way * values + i);
      const bool is_known = point && k < point->motion.exponents.size();
      c.y.push_back(is_known ? point->motion.exponents[k] : std::nan(""));
    }
  }
  double low = 0.0, high = 0.0;
  for (const Curve& c : curves) {
    for (const double y : c.y) {
      if (std::isfinite(y)) low = std::min(low, y), high = std::max(high, y);
    }
  }
  const auto add = [&](const std::string& title) -> Panel& {
    Panel p;
    p.title = title;
    p.x = {.title = v.axis.title, .first = v.axis.values.front(), .last = v.axis.values.back()};
    if (!(p.x.first < p.x.last)) p.x.first = p.x.last = not_set;
    p.y.title = "exponent [1/rev]";
    p.cursor = "parameter";
    p.rules.push_back({Rule::Kind::horizontal, 0.0, "", Paint::ink, Dash::solid});
    p.curves = curves;
    f.panels.push_back(std::move(p));
    return f.panels.back();
  };
  if (low < -2.0 * near_zero) {
    Panel& near = add("near zero");
    near.y.first = -near_zero;
    near.y.last = std::max(near_zero, 1.1 * high);
  }
  add(f.panels.empty() ? "" : "all");
  return f;
}

std::vector<Figure> exponents_over_figures(const ResultView& result) {
  const SweepView v(result);
  std::vector<Figure> figures;
  for (std::size_t way = 0; way < v.ways.size(); ++way) figures.push_back(exponents_of_way(v, way));
  return figures;
}

}  // namespace

FigureKind exponents_over_kind() {
  return {
      .name = "exponents_over",
      .title = "Exponents over a value",
      .summary = "all Lyapunov exponents along the parameter of a sweep",
      .needs = {point_dataset<SweepResult>("exponent")},
      .make = exponents_over_figures,
  };
}

}  // namespace whirl::inline io
