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

constexpr double label_distance = 17.0;
constexpr double bold = 1.1;  ///< letters are wider

bool is_tight(const PanelFrame& f) {
  return f.rooms != &wide;
}

/// Widens a range about its middle.
void widen(Axis& axis, double factor) {
  const double middle = 0.5 * (axis.first + axis.last), half = 0.5 * (axis.last - axis.first);
  axis.first = middle - factor * half;
  axis.last = middle + factor * half;
}

/// Room right of a panel, for names at the ends of lines, or for a scale of colors.
double room_right(const Panel& p, const Rooms& rooms) {
  const bool is_tight = &rooms != &wide;
  double longest = 0.0;
  for (const Curve& c : p.curves) {
    if (c.end_name.empty()) continue;
    const double width = bold * text_width(c.end_name, letters);
    longest = std::max(longest, rooms.name + (is_tight ? 4.0 : 12.0) + width);
  }
  for (const Rule& r : p.rules) {
    if (r.kind == Rule::Kind::vertical || r.name.empty()) continue;
    if (is_tight) continue;  // named inside
    longest = std::max(longest, 12.0 + 0.9 * text_width(r.name, small_letters));
  }
  if (!p.cells.empty() && p.cells.categories.empty()) longest = std::max(longest, rooms.bar_room);
  return std::max(is_tight ? 14.0 : 22.0, longest);
}

}  // namespace

std::string fitting_title(const std::string& title, double width) {
  std::string text = title;
  for (auto at = text.rfind(" | "); at != std::string::npos; at = text.rfind(" | ")) {
    if (bold * text_width(text, letters) <= width) break;
    text.erase(at);
  }
  if (bold * text_width(text, letters) <= width) return text;
  for (auto at = text.rfind(' '); at != std::string::npos; at = text.rfind(' ')) {
    text.erase(at);
    if (bold * text_width(text + "…", letters) <= width) break;
  }
  return text + "…";
}

namespace {

std::vector<Tick> ticks_along(const PanelFrame& f);
std::vector<Tick> ticks_up(const PanelFrame& f);

/// Rows and columns of the panels of a figure.
struct Grid {
  const Figure& figure;
  std::size_t columns, count, rows;

  explicit Grid(const Figure& f)
      : figure(f),
        columns(static_cast<std::size_t>(std::max(1, f.columns))),
        count(f.panels.size()),
        rows((count + columns - 1) / columns) {}
  /// Whether a panel shares x with the one below it.
  bool shares_axis(std::size_t i) const {
    return i + columns < count && !figure.panels[i].x.title.empty() &&
           figure.panels[i].x.title == figure.panels[i + columns].x.title;
  }
};

/// Whether a name of y is longer than a panel is high.
bool is_longer(const std::string& y_title, double height) {
  return text_width(y_title, letters) > height + 10.0;
}

/// Room above a row of panels.
double room_above(const Grid& grid, std::size_t row, bool has_y_titles, const Rooms& rooms) {
  const bool has_title = !grid.figure.panels[row * grid.columns].title.empty();
  return (has_title ? rooms.title : rooms.above) + (has_y_titles ? small_letters + 2.0 : 0.0);
}

/// Heights of rows, and whether y is named above their panels.
struct RowHeights {
  std::vector<double> heights;
  std::vector<bool> has_title_above;
};

RowHeights row_heights(const Grid& grid, double height, const Rooms& rooms) {
  RowHeights result{std::vector<double>(grid.rows), std::vector<bool>(grid.rows, false)};
  for (int pass = 0; pass < 2; ++pass) {  // names above cost height themselves
    double shares = 0.0, used = 0.0;
    for (std::size_t r = 0; r < grid.rows; ++r) {
      shares += grid.figure.panels[r * grid.columns].share;
      used += room_above(grid, r, result.has_title_above[r], rooms) +
              (grid.shares_axis(r * grid.columns) ? rooms.between : rooms.under);
    }
    for (std::size_t r = 0; r < grid.rows; ++r) {
      const Panel& first = grid.figure.panels[r * grid.columns];
      result.heights[r] = std::max(1.0, (height - used) * first.share / shares);
      if (&rooms == &wide) continue;
      for (std::size_t c = 0; c < grid.columns && r * grid.columns + c < grid.count; ++c) {
        if (is_longer(grid.figure.panels[r * grid.columns + c].y.title, result.heights[r])) {
          result.has_title_above[r] = true;
        }
      }
    }
  }
  return result;
}

void make_scales_equal(PanelFrame& f) {
  const double ratio = (f.x.last - f.x.first) / f.width / ((f.y.last - f.y.first) / f.height);
  if (ratio < 1.0) widen(f.x, 1.0 / ratio);
  if (ratio > 1.0) widen(f.y, ratio);
}

/// Room left of a panel that its numbers and name need.
double room_left(const PanelFrame& f) {
  constexpr double gap = 9.0, title = 18.0;
  if (!f.panel->has_frame) return gap;
  double widest = 0.0;
  for (const Tick& t : ticks_up(f)) widest = std::max(widest, text_width(t.label, small_letters));
  return gap + widest + (f.has_title_above || f.panel->y.title.empty() ? 2.0 : title);
}

}  // namespace

std::vector<PanelFrame> frames_of(const Figure& figure, double top, const Rooms& rooms) {
  const Grid grid(figure);
  std::vector<PanelFrame> frames(grid.count);
  const RowHeights rows = row_heights(grid, figure.height - top, rooms);
  double right = 0.0, left = rooms.left;
  for (const Panel& p : figure.panels) right = std::max(right, room_right(p, rooms));
  const double pitch = figure.width / static_cast<double>(grid.columns);
  for (int pass = 0; pass < (&rooms == &wide ? 1 : 2); ++pass) {  // room left follows numbers
    double y = top;
    for (std::size_t r = 0; r < grid.rows; ++r) {
      y += room_above(grid, r, rows.has_title_above[r], rooms);
      for (std::size_t c = 0; c < grid.columns && r * grid.columns + c < grid.count; ++c) {
        PanelFrame& f = frames[r * grid.columns + c];
        f.panel = &figure.panels[r * grid.columns + c];
        f.rooms = &rooms;
        f.picture_width = figure.width;
        const PanelAxes axes = axes_of(*f.panel);
        f.x = axes.x;
        f.y = axes.y;
        f.corner = {pitch * static_cast<double>(c) + left, y};
        f.width = std::max(1.0, pitch - left - right);
        f.height = rows.heights[r];
        f.left = left;
        f.is_lowest = !grid.shares_axis(r * grid.columns + c);
        f.x_title = f.corner.x + 0.5 * f.width;
        f.has_title_above = rows.has_title_above[r];
        if (f.panel->has_equal_scales) make_scales_equal(f);
      }
      y += rows.heights[r] + (grid.shares_axis(r * grid.columns) ? rooms.between : rooms.under);
    }
    left = 0.0;
    for (const PanelFrame& f : frames) left = std::max(left, room_left(f));
  }
  // one name for all panels beside each other where it is too long for each
  const auto is_named_alike = [&](const PanelFrame& f) {
    return f.panel->x.title == figure.panels.back().x.title;
  };
  if (&rooms != &wide && grid.columns > 1 &&
      text_width(figure.panels.back().x.title, letters) > pitch &&
      std::all_of(frames.begin(), frames.end(), is_named_alike)) {
    for (PanelFrame& f : frames) {
      f.has_x_title = &f == &frames.back();
      f.x_title = 0.5 * figure.width;
    }
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

std::vector<Tick> ticks_every(const Axis& axis, double step, double most) {
  std::vector<Tick> ticks;
  while ((axis.last - axis.first) / step > most) step *= 2.0;
  for (double i = std::ceil(axis.first / step); i * step <= axis.last; ++i) {
    ticks.push_back({i * step, fmt::format("{}{:g}", i < 0.0 ? "−" : "", std::abs(i * step))});
  }
  return ticks;
}

std::vector<Tick> ticks_along(const PanelFrame& f) {
  const Panel& p = *f.panel;
  const double room = f.rooms->per_label_x;
  if (!p.cells.x_names.empty()) {
    return named_ticks(p.cells.x, p.cells.x_names, f.width, is_tight(f) ? room : 66.0);
  }
  const double most = is_tight(f) ? std::max(2.0, std::floor(f.width / room)) : 8.0;
  if (std::isfinite(p.x.step)) return ticks_every(f.x, p.x.step, most);
  return f.x.ticks(std::max(2, static_cast<int>(f.width / room)));
}

std::vector<Tick> ticks_up(const PanelFrame& f) {
  const Panel& p = *f.panel;
  if (!p.cells.y_names.empty()) return named_ticks(p.cells.y, p.cells.y_names, f.height, 15.0);
  const double most =
      is_tight(f) ? std::max(2.0, std::floor(f.height / f.rooms->per_label_y)) : 8.0;
  if (std::isfinite(p.y.step)) return ticks_every(f.y, p.y.step, most);
  return f.y.ticks(std::max(2, static_cast<int>(f.height / f.rooms->per_label_y)));
}

/// Names of the panel and its axes.
void draw_titles(Svg& svg, const PanelFrame& f) {
  const Panel& p = *f.panel;
  const char* ink = color_of(Paint::ink);
  const double above = f.has_title_above ? small_letters + 2.0 : 0.0;
  if (!p.title.empty()) {
    svg.text({f.corner.x + 0.5 * f.width, f.corner.y - above - (is_tight(f) ? 6.0 : 9.0)},
             is_tight(f) ? fitting_title(p.title, f.width + 16.0) : p.title,
             {.size = letters, .color = ink, .anchor = Anchor::middle, .is_bold = true});
  }
  if (!p.has_frame) return;
  if (f.is_lowest && f.has_x_title) {
    svg.text({f.x_title, f.floor() + f.rooms->axis_title}, p.x.title,
             {letters, ink, Anchor::middle});
  }
  if (f.has_title_above) {
    svg.text({f.corner.x - f.left + 4.0, f.corner.y - 6.0}, p.y.title, {small_letters, ink});
  } else {
    const double x = is_tight(f) ? f.corner.x - f.left + 14.0 : f.corner.x - 63.0;
    svg.text({x, f.corner.y + 0.5 * f.height}, p.y.title, {letters, ink, Anchor::middle, -90.0});
  }
}

void draw_axes(Svg& svg, const PanelFrame& f) {
  const Panel& p = *f.panel;
  const char *ink = color_of(Paint::ink), *faint = color_of(Paint::faint);
  svg.begin_group("axes");
  draw_titles(svg, f);
  if (!p.has_frame) return svg.end_group();
  const auto along = ticks_along(f), up = ticks_up(f);
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
  const double tick = is_tight(f) ? 4.0 : 6.0;
  for (const Tick& t : along) {
    const double x = f.at(t.value, f.y.first).x, length = t.label.empty() ? 0.5 * tick : tick;
    svg.line({x, f.floor()}, {x, f.floor() + length}, {ink, 1.0, ""});
    if (!f.is_lowest) continue;
    svg.text({x, f.floor() + f.rooms->tick_label}, t.label, {small_letters, ink, Anchor::middle});
  }
  for (const Tick& t : up) {
    const double y = f.at(f.x.first, t.value).y, length = t.label.empty() ? 0.5 * tick : tick;
    svg.line({f.corner.x - length, y}, {f.corner.x, y}, {ink, 1.0, ""});
    svg.text({f.corner.x - tick - (is_tight(f) ? 2.0 : 4.0), y + 4.5}, t.label,
             {small_letters, ink, Anchor::end});
  }
  svg.line({f.corner.x, f.floor()}, {f.right(), f.floor()}, {ink, 1.0, ""});
  svg.line({f.corner.x, f.corner.y}, {f.corner.x, f.floor()}, {ink, 1.0, ""});
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

/// Where a text is on the picture; its place is on its base line.
struct TextBox {
  double left, right, top, floor;

  TextBox(Pixel at, const std::string& text, const TextStyle& style) {
    const double width = text_width(text, style.size);
    left = at.x - (style.anchor == Anchor::start    ? 0.0
                   : style.anchor == Anchor::middle ? 0.5 * width
                                                    : width);
    right = left + width;
    top = at.y - 0.8 * style.size;
    floor = at.y + 0.25 * style.size;
  }
  bool crosses(const TextBox& b) const {
    return left < b.right && b.left < right && top < b.floor && b.top < floor;
  }
};

/// Texts within a panel. In a picture of a given size one that would lie on another one, or reach out
/// of the picture, is moved up or down by a line, or left out.
class PanelTexts {
 public:
  PanelTexts(Svg& svg, const PanelFrame& f) : svg_(svg), frame_(f) {}

  void add(Pixel at, const std::string& text, TextStyle style) {
    if (text.empty()) return;
    if (!is_tight(frame_)) return svg_.text(at, text, style);
    for (const double lines : {0.0, -1.0, 1.0, -2.0, 2.0}) {
      for (const double side : {0.0, 1.0, -1.0}) {
        const double width = text_width(text, style.size);
        const Pixel moved{at.x + 0.5 * side * width, at.y + lines * (style.size + 1.0)};
        if (!is_free(TextBox(moved, text, style))) continue;
        boxes_.emplace_back(moved, text, style);
        return svg_.text(moved, text, style);
      }
    }
  }

 private:
  bool is_free(const TextBox& box) const {
    if (box.left < 2.0 || box.right > frame_.picture_width - 2.0) return false;
    if (box.top < frame_.corner.y - 2.0 || box.floor > frame_.floor() + 2.0) return false;
    return std::none_of(boxes_.begin(), boxes_.end(),
                        [&](const TextBox& other) { return box.crosses(other); });
  }

  Svg& svg_;
  const PanelFrame& frame_;
  std::vector<TextBox> boxes_;
};

void draw_rules(Svg& svg, const PanelFrame& f, PanelTexts& texts) {
  for (const Rule& r : f.panel->rules) {
    const Stroke stroke{color_of(r.paint), 1.1, dashes_of(r.dash)};
    TextStyle style{.size = small_letters, .color = text_color_of(r.paint), .has_halo = true};
    svg.begin_group(r.name);
    if (r.kind == Rule::Kind::vertical) {
      const double x = f.at(r.at, f.y.first).x;
      svg.line({x, f.corner.y}, {x, f.floor()}, stroke);
      const bool fits = x + 5.0 + text_width(r.name, small_letters) < f.picture_width;
      if (!fits) style.anchor = Anchor::end;
      texts.add({fits ? x + 5.0 : x - 5.0, f.floor() - 8.0}, r.name, style);
    } else if (r.kind == Rule::Kind::horizontal) {
      const double y = f.at(f.x.first, r.at).y;
      svg.line({f.corner.x, y}, {f.right(), y}, stroke);
      if (is_tight(f)) {
        style.anchor = Anchor::end;
        texts.add({f.right() - 3.0, y - 4.0}, r.name, style);
      } else {
        svg.text({f.right() + 5.0, y + 4.0}, r.name, style);
      }
    } else {  // through the panel to its right or upper edge
      double x = f.x.last, y = r.at * f.x.last;
      if (y > f.y.last) y = f.y.last, x = y / r.at;
      if (y < f.y.first) y = f.y.first, x = y / r.at;
      const double from = std::clamp(f.x.first, f.y.first / r.at, f.y.last / r.at);
      svg.line(f.at(from, r.at * from), f.at(x, y), stroke);
      const Pixel end = f.at(x, y);
      const bool is_right = x >= f.x.last * (1.0 - 1e-9);
      const bool is_outside =
          is_right && !is_tight(f);  // inside, names of curves are not in the way
      style.anchor = is_outside ? Anchor::start : Anchor::end;
      texts.add({end.x + (is_outside ? 5.0 : -4.0), end.y + (is_outside ? 4.0
                                                             : is_right ? -3.0
                                                                        : 14.0)},
                r.name, style);
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
    const double x = f.right() + f.rooms->name, y = places[i];
    svg.polyline({ends[i].place, {x - f.rooms->leader, y}, {x - 5.0, y}},
                 {color_of(c.paint), 0.8, "1 3"});
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
  PanelTexts texts(svg, f);
  draw_rules(svg, f, texts);
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
    texts.add({at.x + l.dx, at.y + l.dy}, l.text,
              {11.5, text_color_of(l.paint), l.anchor, 0.0, false, true});
  }
}

}  // namespace whirl
