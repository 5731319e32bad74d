#include "libio/panel_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace whirl {

namespace figure_style {

const char* color_of(Paint paint) {
  return paint_colors(paint).light;
}
const char* text_color_of(Paint paint) {
  return paint_colors(paint).light_text;
}

std::string dashes_of(Dash dash) {
  switch (dash) {
    case Dash::dashed:
      return "6 4";
    case Dash::dotted:
      return "1.5 3.5";
    case Dash::dash_dot:
      return "8 3 2 3";
    default:
      return "";
  }
}

}  // namespace figure_style

using namespace figure_style;

namespace {

constexpr double under = 54.0;  ///< room for tick labels and titles of axes
constexpr double label_gap = 30.0, label_distance = 17.0, leader = 22.0;
constexpr double bar_width = 14.0, bar_room = 84.0;  ///< of a scale of colors
constexpr double bold = 1.1;                         ///< letters are wider

/// Widens a range about its middle.
void widen(Axis& axis, double factor) {
  const double middle = 0.5 * (axis.first + axis.last), half = 0.5 * (axis.last - axis.first);
  axis.first = middle - factor * half;
  axis.last = middle + factor * half;
}

/// Room right of a panel, for names at the ends of lines, or for a scale of colors.
double room_right(const Panel& p) {
  double longest = 0.0;
  for (const Curve& c : p.curves) {
    if (c.end_name.empty()) continue;
    longest = std::max(longest, label_gap + 12.0 + bold * text_width(c.end_name, letters));
  }
  for (const Rule& r : p.rules) {
    if (r.kind == Rule::Kind::vertical || r.name.empty()) continue;
    longest = std::max(longest, 12.0 + 0.9 * text_width(r.name, small_letters));
  }
  if (!p.cells.empty() && p.cells.categories.empty()) longest = std::max(longest, bar_room);
  return std::max(22.0, longest);
}

}  // namespace

std::vector<PanelFrame> frames_of(const Figure& figure, double top) {
  const auto columns = static_cast<std::size_t>(std::max(1, figure.columns));
  const std::size_t count = figure.panels.size(), rows = (count + columns - 1) / columns;
  std::vector<PanelFrame> frames(count);
  double shares = 0.0;
  for (std::size_t r = 0; r < rows; ++r) shares += figure.panels[r * columns].share;
  const auto shares_axis = [&](std::size_t i) {  // with the panel below
    return i + columns < count && !figure.panels[i].x.title.empty() &&
           figure.panels[i].x.title == figure.panels[i + columns].x.title;
  };
  double rooms = 0.0;  // between the rows
  for (std::size_t r = 0; r < rows; ++r) {
    rooms += (figure.panels[r * columns].title.empty() ? 8.0 : 26.0) +
             (shares_axis(r * columns) ? 10.0 : under);
  }
  double right = 0.0;
  for (const Panel& p : figure.panels) right = std::max(right, room_right(p));
  const double width = figure.width / static_cast<double>(columns) - left - right;
  double y = top;
  for (std::size_t r = 0; r < rows; ++r) {
    const Panel& first = figure.panels[r * columns];
    const double height = (figure.height - top - rooms) * first.share / shares;
    y += first.title.empty() ? 8.0 : 26.0;
    for (std::size_t c = 0; c < columns && r * columns + c < count; ++c) {
      PanelFrame& f = frames[r * columns + c];
      f.panel = &figure.panels[r * columns + c];
      const PanelAxes axes = axes_of(*f.panel);
      f.x = axes.x;
      f.y = axes.y;
      f.corner = {figure.width * static_cast<double>(c) / static_cast<double>(columns) + left, y};
      f.width = width;
      f.height = height;
      f.is_lowest = !shares_axis(r * columns + c);
      if (!f.panel->has_equal_scales) continue;
      const double ratio = (f.x.last - f.x.first) / width / ((f.y.last - f.y.first) / height);
      if (ratio < 1.0) widen(f.x, 1.0 / ratio);
      if (ratio > 1.0) widen(f.y, ratio);
    }
    y += height + (shares_axis(r * columns) ? 10.0 : under);
  }
  return frames;
}

namespace {

/// Ticks at the middles of named columns, rows; as many as have room.
std::vector<Tick> named_ticks(const std::vector<double>& places,
                              const std::vector<std::string>& names, double length, double room) {
  std::vector<Tick> ticks;
  const double pitch = length / static_cast<double>(std::max<std::size_t>(1, names.size()));
  const auto every = static_cast<std::size_t>(std::ceil(room / pitch));
  for (std::size_t i = 0; i < names.size(); i += every) ticks.push_back({places[i], names[i]});
  return ticks;
}

std::vector<Tick> ticks_every(const Axis& axis, double step) {
  std::vector<Tick> ticks;
  while ((axis.last - axis.first) / step > 8.0) step *= 2.0;
  for (double i = std::ceil(axis.first / step); i * step <= axis.last; ++i) {
    ticks.push_back({i * step, fmt::format("{}{:g}", i < 0.0 ? "−" : "", std::abs(i * step))});
  }
  return ticks;
}

void draw_axes(Svg& svg, const PanelFrame& f) {
  constexpr double room_x = 62.0, room_y = 40.0;  // of a tick label
  const Panel& p = *f.panel;
  const char *ink = color_of(Paint::ink), *faint = color_of(Paint::faint);
  svg.begin_group("axes");
  if (!p.title.empty()) {
    svg.text({f.corner.x + 0.5 * f.width, f.corner.y - 9.0}, p.title,
             {.size = letters, .color = ink, .anchor = Anchor::middle, .is_bold = true});
  }
  if (!p.has_frame) return svg.end_group();
  auto along = f.x.ticks(std::max(2, static_cast<int>(f.width / room_x)));
  auto up = f.y.ticks(std::max(2, static_cast<int>(f.height / room_y)));
  if (std::isfinite(p.x.step)) along = ticks_every(f.x, p.x.step);
  if (std::isfinite(p.y.step)) up = ticks_every(f.y, p.y.step);
  if (!p.cells.x_names.empty()) along = named_ticks(p.cells.x, p.cells.x_names, f.width, 66.0);
  if (!p.cells.y_names.empty()) up = named_ticks(p.cells.y, p.cells.y_names, f.height, 15.0);
  for (const Tick& t : along) {
    const double x = f.at(t.value, f.y.first).x;
    if (!t.label.empty() && p.cells.empty())
      svg.line({x, f.corner.y}, {x, f.floor()}, {faint, 1.0, ""});
  }
  for (const Tick& t : up) {
    const double y = f.at(f.x.first, t.value).y;
    if (!t.label.empty() && p.cells.empty())
      svg.line({f.corner.x, y}, {f.right(), y}, {faint, 1.0, ""});
  }
  for (const Tick& t : along) {
    const double x = f.at(t.value, f.y.first).x, length = t.label.empty() ? 3.0 : 6.0;
    svg.line({x, f.floor()}, {x, f.floor() + length}, {ink, 1.0, ""});
    if (f.is_lowest) svg.text({x, f.floor() + 21.0}, t.label, {small_letters, ink, Anchor::middle});
  }
  for (const Tick& t : up) {
    const double y = f.at(f.x.first, t.value).y, length = t.label.empty() ? 3.0 : 6.0;
    svg.line({f.corner.x - length, y}, {f.corner.x, y}, {ink, 1.0, ""});
    svg.text({f.corner.x - 10.0, y + 4.5}, t.label, {small_letters, ink, Anchor::end});
  }
  svg.line({f.corner.x, f.floor()}, {f.right(), f.floor()}, {ink, 1.0, ""});
  svg.line({f.corner.x, f.corner.y}, {f.corner.x, f.floor()}, {ink, 1.0, ""});
  if (f.is_lowest) {
    svg.text({f.corner.x + 0.5 * f.width, f.floor() + 42.0}, p.x.title,
             {letters, ink, Anchor::middle});
  }
  svg.text({f.corner.x - 63.0, f.corner.y + 0.5 * f.height}, p.y.title,
           {letters, ink, Anchor::middle, -90.0});
  svg.end_group();
}

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
  if (!cells.prints_values) return;
  for (std::size_t j = 0; j < cells.y.size(); ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      const double value = cells.values[j * columns + i];
      const bool is_dark = (value - cells.first) / (cells.last - cells.first) > 0.5;
      const Pixel p = f.at(cells.x[i], cells.y[j]);
      svg.text({p.x, p.y + 4.0}, fmt::format("{:.2f}", value),
               {11.0, is_dark ? "#ffffff" : color_of(Paint::ink), Anchor::middle});
    }
  }
}

void draw_color_bar(Svg& svg, const PanelFrame& f) {
  const Cells& cells = f.panel->cells;
  if (cells.empty() || !cells.categories.empty()) return;
  const double x = f.right() + 14.0;
  constexpr int steps = 48;
  for (int i = 0; i < steps; ++i) {
    const double low = f.floor() - f.height * i / steps,
                 high = f.floor() - f.height * (i + 1) / steps;
    svg.area(fmt::format("M{} {}h{}V{}h-{}z", coordinate(x), coordinate(low), bar_width,
                         coordinate(high), bar_width),
             hex(color_at(cells.map, (i + 0.5) / steps)), 1.0, true);
  }
  const Axis scale{Scale::linear, cells.first, cells.last};
  for (const Tick& t : scale.ticks(5)) {
    const double y = f.floor() - f.height * scale.place(t.value);
    svg.line({x + bar_width, y}, {x + bar_width + 4.0, y}, {color_of(Paint::ink), 1.0, ""});
    svg.text({x + bar_width + 7.0, y + 4.0}, t.label, {11.0, color_of(Paint::ink)});
  }
  svg.text({x + bar_room - 22.0, f.corner.y + 0.5 * f.height}, cells.title,
           {small_letters, color_of(Paint::ink), Anchor::middle, -90.0});
}

void draw_rules(Svg& svg, const PanelFrame& f) {
  for (const Rule& r : f.panel->rules) {
    const Stroke stroke{color_of(r.paint), 1.1, dashes_of(r.dash)};
    const TextStyle style{.size = small_letters, .color = text_color_of(r.paint), .has_halo = true};
    svg.begin_group(r.name);
    if (r.kind == Rule::Kind::vertical) {
      const double x = f.at(r.at, f.y.first).x;
      svg.line({x, f.corner.y}, {x, f.floor()}, stroke);
      svg.text({x + 5.0, f.floor() - 8.0}, r.name, style);
    } else if (r.kind == Rule::Kind::horizontal) {
      const double y = f.at(f.x.first, r.at).y;
      svg.line({f.corner.x, y}, {f.right(), y}, stroke);
      svg.text({f.right() + 5.0, y + 4.0}, r.name, style);
    } else {  // through the panel to its right or upper edge
      double x = f.x.last, y = r.at * f.x.last;
      if (y > f.y.last) y = f.y.last, x = y / r.at;
      if (y < f.y.first) y = f.y.first, x = y / r.at;
      const double from = std::clamp(f.x.first, f.y.first / r.at, f.y.last / r.at);
      svg.line(f.at(from, r.at * from), f.at(x, y), stroke);
      const Pixel end = f.at(x, y);
      const bool is_right = x >= f.x.last * (1.0 - 1e-9);
      svg.text({end.x + (is_right ? 5.0 : -4.0), end.y + (is_right ? 4.0 : 14.0)}, r.name,
               {small_letters, text_color_of(r.paint), is_right ? Anchor::start : Anchor::end, 0.0,
                false, true});
    }
    svg.end_group();
  }
}

/// Points of a curve that can be seen apart; a run ends where a point has no place.
std::vector<std::vector<Pixel>> runs_of(const PanelFrame& f, const Curve& c) {
  std::vector<std::vector<Pixel>> runs(1);
  constexpr double least = 0.35;  // [pixels]
  Pixel skipped;
  bool has_skipped = false;
  const auto finish = [&] {
    if (has_skipped) runs.back().push_back(skipped);
    has_skipped = false;
  };
  for (std::size_t i = 0; i < c.x.size(); ++i) {
    if (!has_place(*f.panel, c.x[i], c.y[i])) {
      finish();
      if (!runs.back().empty()) runs.emplace_back();
      continue;
    }
    const Pixel p = f.at(c.x[i], c.y[i]);
    const double far = f.width + f.height;  // points outside matter as ends of lines only
    if (p.x < f.corner.x - far || p.x > f.right() + far) {
      finish();
      if (!runs.back().empty()) runs.emplace_back();
      continue;
    }
    auto& run = runs.back();
    if (c.has_line && !run.empty() && std::hypot(p.x - run.back().x, p.y - run.back().y) < least) {
      skipped = p;
      has_skipped = true;
      continue;
    }
    has_skipped = false;
    run.push_back(p);
  }
  finish();
  return runs;
}

void draw_line(Svg& svg, const PanelFrame& f, const Curve& c) {
  if (!c.has_line && c.fill == 0.0) return;
  const char* color = color_of(c.paint);
  svg.begin_group(c.name.empty() ? c.end_name : c.name);
  for (const auto& run : runs_of(f, c)) {
    if (run.empty()) continue;
    if (c.fill > 0.0) {
      std::string outline;
      for (const Pixel& p : run) {
        outline +=
            fmt::format("{}{} {}", outline.empty() ? "M" : "L", coordinate(p.x), coordinate(p.y));
      }
      svg.area(outline + "z", color, c.fill);
    }
    if (c.has_line && run.size() > 1) svg.polyline(run, {color, c.width, dashes_of(c.dash)});
  }
  svg.end_group();
}

void draw_markers(Svg& svg, const PanelFrame& f, const Curve& c) {
  if (!c.has_marker) return;
  const char* color = color_of(c.paint);
  svg.begin_group(c.name.empty() ? c.end_name : c.name);
  std::vector<Pixel> places;
  const std::size_t every = std::max<std::size_t>(1, c.marker_every);
  for (std::size_t i = every / 2; i < c.x.size(); i += every) {
    if (!has_place(*f.panel, c.x[i], c.y[i])) continue;
    const Pixel p = f.at(c.x[i], c.y[i]);
    const bool is_seen = p.x > f.corner.x - 9.0 && p.x < f.right() + 9.0 &&
                         p.y > f.corner.y - 9.0 && p.y < f.floor() + 9.0;
    if (is_seen) places.push_back(p);
  }
  if (c.size < 3.0) {
    svg.dots(places, c.size, color);
  } else {
    for (const Pixel& p : places) svg.marker(c.marker, p, c.size, color);
  }
  svg.end_group();
}

/// Whether a line goes on beyond the panel from the last point that is seen.
bool leaves(const PanelFrame& f, const Curve& c, Pixel last) {
  for (std::size_t i = 0; i < c.x.size(); ++i) {
    if (!has_place(*f.panel, c.x[i], c.y[i])) continue;
    const Pixel p = f.at(c.x[i], c.y[i]);
    if (p.x > last.x + 1.0 && p.x <= f.right() + 1.0) return true;
  }
  return false;
}

/// Names at the ends of lines, kept apart, each with a line to its end.
void draw_end_names(Svg& svg, const PanelFrame& f) {
  struct End {
    const Curve* curve;
    Pixel place;
  };
  std::vector<End> ends;
  for (const Curve& c : f.panel->curves) {
    End end{&c, {-1.0, 0.0}};
    for (std::size_t i = 0; i < c.x.size() && !c.end_name.empty(); ++i) {
      if (!has_place(*f.panel, c.x[i], c.y[i])) continue;
      const Pixel p = f.at(c.x[i], c.y[i]);
      if (p.x > end.place.x && p.y >= f.corner.y - 1.0 && p.y <= f.floor() + 1.0) end.place = p;
    }
    if (end.place.x < 0.0) continue;
    if (c.has_line && leaves(f, c, end.place)) {  // up or down: the name is where it leaves
      const bool is_up = end.place.y < f.corner.y + 0.5 * f.height;
      svg.text({end.place.x - 7.0, end.place.y + (is_up ? 16.0 : -8.0)}, c.end_name,
               {letters, text_color_of(c.paint), Anchor::end, 0.0, true, true});
      continue;
    }
    ends.push_back(end);
  }
  std::stable_sort(ends.begin(), ends.end(),
                   [](const End& a, const End& b) { return a.place.y < b.place.y; });
  std::vector<double> wanted;
  for (const End& e : ends) wanted.push_back(e.place.y);
  const auto places = spread(wanted, label_distance, f.corner.y, f.floor());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const Curve& c = *ends[i].curve;
    const double x = f.right() + label_gap, y = places[i];
    svg.polyline({ends[i].place, {x - leader, y}, {x - 5.0, y}}, {color_of(c.paint), 0.8, "1 3"});
    svg.text({x, y + 0.35 * letters}, c.end_name,
             {.size = letters, .color = text_color_of(c.paint), .is_bold = true, .has_halo = true});
  }
}

}  // namespace

void draw_panel(Svg& svg, const PanelFrame& f) {
  const Panel& p = *f.panel;
  svg.begin_clip({f.corner.x, f.corner.y}, f.width, f.height);
  draw_cells(svg, f);
  svg.end_clip();
  draw_axes(svg, f);
  draw_color_bar(svg, f);
  draw_rules(svg, f);
  svg.begin_clip({f.corner.x - 1.0, f.corner.y - 1.0}, f.width + 2.0, f.height + 2.0);
  for (const Curve& c : p.curves) draw_line(svg, f, c);
  svg.end_clip();  // markers at the edge are whole
  svg.begin_clip({f.corner.x - 5.0, f.corner.y - 5.0}, f.width + 10.0, f.height + 10.0);
  for (const Curve& c : p.curves) draw_markers(svg, f, c);
  svg.end_clip();
  draw_end_names(svg, f);
  for (const Label& l : p.labels) {
    if (!has_place(p, l.x, l.y)) continue;
    const Pixel at = f.at(l.x, l.y);
    if (at.x < f.corner.x - 1.0 || at.x > f.right() + 1.0) continue;
    svg.text({at.x + l.dx, at.y + l.dy}, l.text,
             {11.5, text_color_of(l.paint), l.anchor, 0.0, false, true});
  }
}

}  // namespace whirl
