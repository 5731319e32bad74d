#include "libio/drawing/panel_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "libio/drawing/panel_svg.hpp"

namespace whirl::inline io {

using namespace figure_style;

namespace {

/// Edges between middles, and half a step beyond the outermost.
std::vector<double> edges(const std::vector<double>& middles) {
  const std::size_t n = middles.size();
  std::vector<double> all(n + 1);
  for (std::size_t i = 1; i < n; ++i) all[i] = 0.5 * (middles[i - 1] + middles[i]);
  const double first = n > 1 ? middles[1] - middles[0] : 1.0;
  const double last = n > 1 ? middles[n - 1] - middles[n - 2] : 1.0;
  all[0] = middles.front() - 0.5 * first;
  all[n] = middles.back() + 0.5 * last;
  return all;
}

std::string hex(Rgb c) {
  return fmt::format("#{:02x}{:02x}{:02x}", c.r, c.g, c.b);
}

std::string cell_color(const Cells& cells, double value) {
  if (!std::isfinite(value)) return "";
  if (!cells.categories.empty()) {
    const auto i = static_cast<std::size_t>(std::max(0.0, value));
    return i < cells.categories.size() ? color_of(cells.categories[i].paint) : "";
  }
  constexpr double shades = 96.0;
  const double place = (value - cells.first) / (cells.last - cells.first);
  return hex(color_at(cells.map, std::round(std::clamp(place, 0.0, 1.0) * shades) / shades));
}

}  // namespace

void draw_cells(Svg& svg, const PanelFrame& f) {
  const Cells& cells = f.panel->cells;
  if (cells.empty()) return;
  const auto x = edges(cells.x), y = edges(cells.y);
  std::map<std::string, std::string> areas;  // outline by color: neighbors of a row are one
  const std::size_t columns = cells.x.size();
  for (std::size_t j = 0; j < cells.y.size(); ++j) {
    for (std::size_t i = 0; i < columns;) {
      const std::string color = cell_color(cells, cells.values[j * columns + i]);
      std::size_t to = i + 1;
      while (to < columns && cell_color(cells, cells.values[j * columns + to]) == color) ++to;
      const Pixel a = f.at(x[i], y[j + 1]), b = f.at(x[to], y[j]);
      if (!color.empty()) {
        areas[color] += fmt::format("M{} {}H{}V{}H{}z", coordinate(a.x), coordinate(a.y),
                                    coordinate(b.x), coordinate(b.y), coordinate(a.x));
      }
      i = to;
    }
  }
  for (const auto& [color, outline] : areas) svg.area(outline, color, 1.0, true);
  constexpr double value_letters = 11.0;
  const double cell_width = f.width / static_cast<double>(columns),
               cell_height = f.height / static_cast<double>(cells.y.size());
  const bool has_room = !is_tight(f) || (cell_width > text_width("0.00", value_letters) &&
                                         cell_height > value_letters);
  if (!cells.prints_values || !has_room) return;
  for (std::size_t j = 0; j < cells.y.size(); ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      const double value = cells.values[j * columns + i];
      const bool is_dark = (value - cells.first) / (cells.last - cells.first) > 0.5;
      const Pixel p = f.at(cells.x[i], cells.y[j]);
      svg.text({p.x, p.y + 4.0}, fmt::format("{:.2f}", value),
               {value_letters, is_dark ? "#ffffff" : color_of(Paint::ink), Anchor::middle});
    }
  }
}

void draw_color_bar(Svg& svg, const PanelFrame& f) {
  const Cells& cells = f.panel->cells;
  if (cells.empty() || !cells.categories.empty()) return;
  const double x = f.right() + f.rooms->bar, bar_width = f.rooms->bar_width;
  constexpr int steps = 48;
  for (int i = 0; i < steps; ++i) {
    const double low = f.floor() - f.height * i / steps,
                 high = f.floor() - f.height * (i + 1) / steps;
    svg.area(fmt::format("M{} {}h{}V{}h-{}z", coordinate(x), coordinate(low), bar_width,
                         coordinate(high), bar_width),
             hex(color_at(cells.map, (i + 0.5) / steps)), 1.0, true);
  }
  const Axis scale{Scale::linear, cells.first, cells.last};
  for (const Tick& t : scale.ticks(std::clamp(static_cast<int>(f.height / 24.0), 2, 5))) {
    const double y = f.floor() - f.height * scale.place(t.value);
    svg.line({x + bar_width, y}, {x + bar_width + 4.0, y}, {color_of(Paint::ink), 1.0, ""});
    svg.text({x + bar_width + 7.0, y + 4.0}, t.label, {11.0, color_of(Paint::ink)});
  }
  svg.text({f.right() + f.rooms->bar_room - (is_tight(f) ? 4.0 : 8.0), f.corner.y + 0.5 * f.height},
           cells.title, {small_letters, color_of(Paint::ink), Anchor::middle, -90.0});
}

}  // namespace whirl::inline io
