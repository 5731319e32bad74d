#include "libio/drawing/figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

constexpr std::array<PaintColors, 39> paints{{
    {"ink", "#222222", "#222222", "#e6e6e6"},
    {"gray", "#707070", "#606060", "#9a9a9a"},
    {"faint", "#e4e4e4", "#707070", "#33373d"},
    {"forward", "#1f77b4", "#155a8a", "#5aaee6"},
    {"backward", "#d62728", "#a81c1d", "#ff6b6b"},
    {"mixed", "#7f7f7f", "#5c5c5c", "#a8a8a8"},
    {"up", "#1f77b4", "#155a8a", "#5aaee6"},
    {"down", "#d55e00", "#a84a00", "#ff9a4d"},
    {"alarm", "#c2185b", "#9c1248", "#ff6fa5"},
    {"shaft", "#8fa3b5", "#5a6b7a", "#7f95aa"},
    {"disk", "#4f6d8a", "#3a5167", "#a3bdd6"},
    {"stator", "#b07d2b", "#805a1c", "#dcae62"},
    {"bearing", "#2e7d32", "#205a24", "#7cc47f"},
    {"seal", "#7b4fa3", "#5e3a80", "#c3a3e6"},
    {"rest", "#f2efe6", "#77746a", "#5d5b54"},
    {"period_1", "#cfe3f5", "#4a7090", "#27506f"},
    {"period_2", "#7fb8e6", "#37719e", "#3f86ba"},
    {"period_3", "#2f7fc1", "#23639a", "#68b1ee"},
    {"period_4", "#0b4f8a", "#0b4f8a", "#a9d6ff"},
    {"period_5", "#c9ecec", "#3c7c7e", "#1f5557"},
    {"period_6", "#86cfd1", "#2f7f82", "#338a8d"},
    {"period_7", "#3aa3a8", "#237b80", "#5cc3c7"},
    {"period_8", "#0f6e75", "#0f6e75", "#a5eef0"},
    {"longer", "#7b6fc4", "#5d52a3", "#a79cf0"},
    {"quasi_periodic", "#3aa76d", "#257a4d", "#4fc487"},
    {"chaotic", "#e66101", "#b04a00", "#ff8b3d"},
    {"hyperchaotic", "#8c0f1c", "#8c0f1c", "#ff4d5e"},
    {"not_settled", "#d3b0cf", "#8f5a88", "#7d5a7a"},
    {"failed", "#000000", "#000000", "#ffffff"},
    {"series_1", "#0072b2", "#00659e", "#4db4ee"},
    {"series_2", "#d55e00", "#b85100", "#ff8f3f"},
    {"series_3", "#009e73", "#007d5b", "#2fd3a5"},
    {"series_4", "#cc79a7", "#a8507f", "#f0a3cb"},
    {"series_5", "#e69f00", "#946600", "#ffc240"},
    {"series_6", "#56b4e9", "#1c7bb0", "#8fd3ff"},
    {"series_7", "#000000", "#000000", "#ffffff"},
    {"series_8", "#882255", "#882255", "#e07ab0"},
    {"series_9", "#999933", "#6b6b1f", "#cccc66"},
    {"series_10", "#888888", "#666666", "#b5b5b5"},
}};

/// 1-3 prefixes that fit lengths, forces and stiffnesses.
DisplayUnit with_prefix(double largest, const std::string& unit) {
  struct Prefix {
    const char* sign;
    double size;
  };
  constexpr std::array<Prefix, 6> prefixes{
      {{"G", 1e9}, {"M", 1e6}, {"k", 1e3}, {"", 1.0}, {"m", 1e-3}, {"µ", 1e-6}}};
  for (const Prefix& p : prefixes) {
    const bool fits = largest >= (p.size < 1.0 || p.size > 1.0 ? p.size : 0.999);
    if (fits) return {p.sign + unit, 1.0 / p.size};
  }
  return {largest > 0.0 ? "n" + unit : unit, largest > 0.0 ? 1e9 : 1.0};
}

/// Limits of what an axis shows: those wanted, else around the numbers.
Axis axis_of(const FigureAxis& wanted, const std::vector<double>& values) {
  const Axis around = axis_around(values, wanted.scale);
  Axis axis = around;
  if (std::isfinite(wanted.first)) axis.first = wanted.first;
  if (std::isfinite(wanted.last)) axis.last = wanted.last;
  if (!(axis.first < axis.last)) axis.last = axis.first + 1.0;
  return can_be_drawn(axis) ? axis : around;
}

/// Lets an axis go from edge to edge of cells, unless their middles lie in one place or run
/// backwards.
void show_edges(Axis& axis, const std::vector<double>& edges) {
  const Axis across{axis.scale, edges[0], edges[1]};
  if (can_be_drawn(across)) axis = across;
}

/// Outer edges of cells, half a step beyond the outermost middles.
void add_edges(std::vector<double>& values, const std::vector<double>& middles) {
  if (middles.empty()) return;
  const std::size_t n = middles.size();
  const double first = n > 1 ? middles[1] - middles[0] : 1.0;
  const double last = n > 1 ? middles[n - 1] - middles[n - 2] : 1.0;
  values.push_back(middles.front() - 0.5 * first);
  values.push_back(middles.back() + 0.5 * last);
}

}  // namespace

const PaintColors& paint_colors(Paint paint) {
  return paints.at(static_cast<std::size_t>(paint));
}

int paint_count() {
  return static_cast<int>(paints.size());
}

const std::vector<Rgb>& color_stops(ColorMap map) {
  static const std::vector<Rgb> sequential{{255, 255, 255}, {222, 235, 247}, {180, 211, 233},
                                           {123, 178, 219}, {66, 139, 196},  {28, 99, 165},
                                           {10, 64, 125},   {5, 28, 72}};
  static const std::vector<Rgb> diverging{{5, 48, 97},     {33, 102, 172},  {103, 169, 207},
                                          {190, 219, 236}, {255, 255, 255}, {250, 208, 181},
                                          {239, 138, 98},  {178, 24, 43},   {103, 0, 31}};
  return map == ColorMap::sequential ? sequential : diverging;
}

Rgb color_at(ColorMap map, double place) {
  const auto& stops = color_stops(map);
  const double at = std::clamp(place, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  const double share = at - static_cast<double>(i);
  const auto mix = [&](int a, int b) { return static_cast<int>(std::lround(a + share * (b - a))); };
  const Rgb &a = stops[i], &b = stops[i + 1];
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

std::vector<LegendEntry> legend_of(const Figure& figure) {
  std::vector<LegendEntry> entries;
  const auto add = [&](const LegendEntry& entry) {
    const bool is_known = std::any_of(entries.begin(), entries.end(), [&](const LegendEntry& e) {
      return e.name() == entry.name();
    });
    if (!entry.name().empty() && !is_known) entries.push_back(entry);
  };
  for (const Panel& p : figure.panels) {
    for (const Category& c : p.cells.categories) add({nullptr, &c});
    for (const Curve& c : p.curves) add({&c, nullptr});
  }
  return entries;
}

DisplayUnit unit_for(double largest, const std::string& si_unit) {
  if (const auto* choice = shown_units().choice(si_unit)) {
    const ShownUnit* unit = &choice->front();
    for (const ShownUnit& larger : *choice) {
      if (largest >= larger.least) unit = &larger;
    }
    return {unit->name, 1.0 / unit->size};
  }
  if (si_unit == "rad/s") return {"rpm", 1.0 / rpm};
  if (si_unit == "m" || si_unit == "N" || si_unit == "N/m" || si_unit == "s") {
    // metres and seconds without a prefix above one
    if ((si_unit == "m" || si_unit == "s") && largest >= 0.999) return {si_unit, 1.0};
    return with_prefix(largest, si_unit);
  }
  return {si_unit, 1.0};
}

double largest_of(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double v : values) {
    if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
  }
  return largest;
}

std::string with_minus(std::string text) {
  for (auto at = text.find('-'); at != std::string::npos; at = text.find('-', at + 3)) {
    text.replace(at, 1, "−");
  }
  return text;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& v : values) v *= factor;
  return values;
}

bool has_place(const Panel& panel, double x, double y) {
  return std::isfinite(x) && std::isfinite(y) && (panel.x.scale == Scale::linear || x > 0.0) &&
         (panel.y.scale == Scale::linear || y > 0.0);
}

PanelAxes axes_of(const Panel& panel) {
  constexpr double margin = 1.1;  // between points and the limits of logarithmic axes
  std::vector<double> x, y;
  const bool x_is_log = panel.x.scale == Scale::logarithmic;
  const bool y_is_log = panel.y.scale == Scale::logarithmic;
  for (const Curve& curve : panel.curves) {
    if (!curve.is_key) continue;
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      if (!has_place(panel, curve.x[i], curve.y[i])) continue;
      // only what is in the wanted range of x decides about y
      if (curve.x[i] < panel.x.first || curve.x[i] > panel.x.last) continue;
      for (const double side : {1.0 / margin, margin}) {
        x.push_back(x_is_log ? side * curve.x[i] : curve.x[i]);
        y.push_back(y_is_log ? side * curve.y[i] : curve.y[i]);
      }
    }
  }
  for (const Rule& rule : panel.rules) {
    if (rule.kind == Rule::Kind::vertical) x.push_back(rule.at);
    if (rule.kind == Rule::Kind::horizontal) y.push_back(rule.at);
  }
  if (panel.curves.empty() && !panel.cells.empty()) {  // cells fill it, whatever rules cross it
    x.clear();
    y.clear();
  }
  PanelAxes axes{axis_of(panel.x, x), axis_of(panel.y, y)};
  if (!panel.cells.empty() && x.empty()) {
    std::vector<double> edges, heights;
    add_edges(edges, panel.cells.x);
    add_edges(heights, panel.cells.y);
    if (!std::isfinite(panel.x.first)) show_edges(axes.x, edges);
    if (!std::isfinite(panel.y.first)) show_edges(axes.y, heights);
  }
  return axes;
}

}  // namespace whirl::inline io
