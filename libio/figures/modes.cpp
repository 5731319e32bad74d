#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libio/figures/all.hpp"

namespace whirl {

using namespace figures;

std::vector<Figure> mode_figures(const ResultView& result) {
  const CMat shape = result.file.complex_matrix("/modes/shape");
  const Vec frequency = result.file.vector("/modes/frequency");
  const Vec decrement = result.file.vector("/modes/log_decrement");
  const auto whirl = result.file.strings("/modes/whirl");
  const auto z = numbers(result.file.vector("/points/z"));
  const auto nodes = static_cast<Eigen::Index>(z.size());
  std::vector<std::size_t> order(z.size());  // along the shaft
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return z[a] < z[b]; });
  constexpr Eigen::Index most = 6;
  const Eigen::Index count = std::min<Eigen::Index>(most, shape.cols());
  Figure f{.width = 1080.0};
  f.columns = count > 1 ? 2 : 1;
  f.height = 80.0 + 200.0 * static_cast<double>((count + 1) / 2);
  const std::string speed = speed_text(result);
  f.subtitle = "Mode shapes" + (speed.empty() ? "" : " at " + speed);
  for (Eigen::Index k = 0; k < count; ++k) {
    const std::string sense = whirl[static_cast<std::size_t>(k)];
    const WhirlStyle style = whirl_style(sense);
    Panel p;
    p.title = fmt::format("Mode {} | {:.2f} Hz ({:.0f} cpm) | {} | log dec {:.3f}", k + 1,
                          frequency(k) / hertz, frequency(k) / rpm, sense, decrement(k));
    p.x.title = "position along the shaft [mm]";
    p.y = {.title = "displacement", .first = -1.15, .last = 1.15};
    // phases at which x, y are largest: their shapes are real then, nearly
    Curve x{.name = "x at its largest", .paint = Paint::series};
    Curve y{.name = "y at its largest", .paint = series_paint(1)};
    y.dash = Dash::dashed;
    Curve outline{.name = "envelope of the orbits", .paint = style.paint, .has_line = false};
    outline.name = "envelope of the orbits: " + sense;
    outline.fill = 0.16;
    Eigen::Index at_x = 0, at_y = 0;
    double top_x = 0.0, top_y = 0.0, largest = 0.0;
    const auto full = [&](Eigen::Index node, int c) { return shape(4 * node + c, k); };
    const auto major = [&](Eigen::Index node) {  // of the ellipse of x, y
      const Complex r = full(node, 0) + Complex(0, 1) * full(node, 1);
      const Complex l = full(node, 0) - Complex(0, 1) * full(node, 1);
      return 0.5 * (std::abs(r) + std::abs(l));
    };
    for (Eigen::Index i = 0; i < nodes; ++i) {
      if (std::abs(full(i, 0)) > top_x) top_x = std::abs(full(i, 0)), at_x = i;
      if (std::abs(full(i, 1)) > top_y) top_y = std::abs(full(i, 1)), at_y = i;
      largest = std::max(largest, major(i));
    }
    if (!(largest > 0.0)) continue;
    const Complex turn_x = top_x > 0.0 ? std::conj(full(at_x, 0)) / top_x : Complex(0.0);
    const Complex turn_y = top_y > 0.0 ? std::conj(full(at_y, 1)) / top_y : Complex(0.0);
    for (const std::size_t i : order) {
      const auto node = static_cast<Eigen::Index>(i);
      for (Curve* c : {&x, &y, &outline}) c->x.push_back(1e3 * z[i]);
      x.y.push_back((turn_x * full(node, 0)).real() / largest);
      y.y.push_back((turn_y * full(node, 1)).real() / largest);
      outline.y.push_back(major(node) / largest);
      x.hover.push_back(fmt::format("node {}", i + 1));
    }
    for (std::size_t i = order.size(); i-- > 0;) {
      outline.x.push_back(1e3 * z[order[i]]);
      outline.y.push_back(-outline.y[i]);
    }
    p.curves = {outline, x, y};
    p.rules.push_back({Rule::Kind::horizontal, 0.0, "", Paint::gray, Dash::dash_dot});
    f.panels.push_back(std::move(p));
  }
  return f.panels.empty() ? std::vector<Figure>{} : std::vector<Figure>{f};
}

std::vector<Figure> mac_figures(const ResultView& result) {
  const Mat mac = result.file.matrix("/mac/mac");
  const Vec peaks = result.file.vector("/mac/frequency");
  const Vec modes = result.file.vector("/modes/frequency");
  const auto whirl = result.file.strings("/modes/whirl");
  if (mac.rows() == 0 || mac.cols() == 0) return {};
  Figure f;
  f.subtitle = "Modal assurance criterion: deflection shapes of the motion against modes" +
               (speed_text(result).empty() ? "" : " at " + speed_text(result));
  f.width = 200.0 + 80.0 * static_cast<double>(mac.cols());
  f.width = std::max(f.width, 560.0);
  f.height = 150.0 + 34.0 * static_cast<double>(mac.rows());
  f.height = std::max(f.height, 320.0);
  Panel p;
  p.x.title = with_unit("mode, its frequency", result.frequency);
  p.y.title = with_unit("peak", result.frequency);
  Cells& c = p.cells;
  c.title = "MAC";
  c.prints_values = true;
  for (Eigen::Index j = 0; j < mac.cols(); ++j) {
    c.x.push_back(static_cast<double>(j + 1));
    c.x_names.push_back(fmt::format("{}{} {:.1f}", j + 1,
                                    whirl_style(whirl[static_cast<std::size_t>(j)]).letter,
                                    modes(j) * result.frequency.factor));
  }
  for (Eigen::Index i = mac.rows(); i-- > 0;) {  // the strongest peak on top
    c.y.push_back(static_cast<double>(mac.rows() - i));
    c.y_names.push_back(with_minus(fmt::format("{:+.2f}", peaks(i) * result.frequency.factor)));
    for (Eigen::Index j = 0; j < mac.cols(); ++j) c.values.push_back(mac(i, j));
  }
  f.panels.push_back(std::move(p));
  return {f};
}

std::vector<Figure> exponent_figures(const ResultView& result) {
  const Vec exponents = result.file.vector("/classify/exponent");
  Figure f{.height = 380.0};
  f.subtitle = "Lyapunov exponents";
  if (result.file.has_attribute("/classify", "motion")) {
    f.subtitle += ": " + result.file.string_attribute("/classify", "motion") + " motion";
  }
  if (!speed_text(result).empty()) f.subtitle += " at " + speed_text(result);
  Panel p;
  p.x = {.title = "number", .first = 0.0, .last = static_cast<double>(exponents.size()) + 1.0};
  p.y.title = "exponent [1/s]";
  p.rules.push_back({Rule::Kind::horizontal, 0.0, "", Paint::ink, Dash::solid});
  Curve c{.paint = Paint::forward, .has_line = false};
  c.has_marker = true;
  c.size = 9.0;
  for (Eigen::Index i = 0; i < exponents.size(); ++i) {
    const double x = static_cast<double>(i + 1);
    Curve stem{.paint = exponents(i) > 0.0 ? Paint::alarm : Paint::forward};
    stem.x = {x, x};
    stem.y = {0.0, exponents(i)};
    p.curves.push_back(stem);
    c.x.push_back(x);
    c.y.push_back(exponents(i));
  }
  p.curves.push_back(c);
  f.panels.push_back(std::move(p));
  return {f};
}

}  // namespace whirl
