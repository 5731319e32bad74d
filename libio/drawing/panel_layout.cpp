#include "libio/drawing/panel_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::inline io {

using namespace figure_style;

namespace {

constexpr double bold = 1.1;  ///< letters are wider

/// Widens a range about its middle.
void widen(Axis& axis, double factor) {
  const double middle = 0.5 * (axis.first + axis.last), half = 0.5 * (axis.last - axis.first);
  axis.first = middle - factor * half;
  axis.last = middle + factor * half;
}

/// Room right of a panel, for names at the ends of lines, or for a scale of colors.
double room_right(const Panel& p, const Rooms& rooms) {
  const bool is_tight = rooms.is_tight;
  double longest = 0.0;
  for (const Curve& c : p.curves) {
    if (c.end_name.empty()) continue;
    const double width = bold * text_width(c.end_name, letters);
    longest = std::max(longest, rooms.name + (is_tight ? 4.0 : 12.0) + width);
  }
  for (const Rule& r : p.rules) {
    if (r.kind == Rule::Kind::vertical || r.name.empty()) continue;
    if (is_tight) continue;  // named inside
    const bool is_among = r.kind == Rule::Kind::horizontal && has_end_names(p);
    const double room = is_among ? rooms.name + 12.0 : 12.0;
    const double width = text_width(r.name, is_among ? letters : small_letters);
    longest = std::max(longest, room + 0.9 * width);
  }
  if (!p.cells.empty() && p.cells.categories.empty()) longest = std::max(longest, rooms.bar_room);
  return std::max(is_tight ? 14.0 : 22.0, longest);
}

/// Rows and columns of the panels of a figure.
struct Grid {
  const Figure& figure;
  std::size_t columns, count, rows;

  explicit Grid(const Figure& f)
      : figure(f),
        columns(static_cast<std::size_t>(std::max(1, f.columns))),
        count(f.panels.size()),
        rows((count + columns - 1) / columns) {}
  /// Whether a panel shares x with the one below it: the names are equal, and neither panel has
  /// equal scales (such a panel has a range of its own).
  bool shares_axis(std::size_t i) const {
    if (i + columns >= count) return false;
    const Panel &upper = figure.panels[i], &lower = figure.panels[i + columns];
    return !upper.x.title.empty() && upper.x.title == lower.x.title && !upper.has_equal_scales &&
           !lower.has_equal_scales;
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
      if (!rooms.is_tight) continue;
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

}  // namespace

bool has_end_names(const Panel& panel) {
  return std::any_of(panel.curves.begin(), panel.curves.end(),
                     [](const Curve& c) { return !c.end_name.empty(); });
}

bool is_tight(const PanelFrame& f) {
  return f.rooms->is_tight;
}

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

std::vector<PanelFrame> frames_of(const Figure& figure, double top, const Rooms& rooms) {
  const Grid grid(figure);
  std::vector<PanelFrame> frames(grid.count);
  const RowHeights rows = row_heights(grid, figure.height - top, rooms);
  double right = 0.0, left = rooms.left;
  for (const Panel& p : figure.panels) right = std::max(right, room_right(p, rooms));
  const double pitch = figure.width / static_cast<double>(grid.columns);
  for (int pass = 0; pass < (rooms.is_tight ? 2 : 1); ++pass) {  // room left follows numbers
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
  if (rooms.is_tight && grid.columns > 1 &&
      text_width(figure.panels.back().x.title, letters) > pitch &&
      std::all_of(frames.begin(), frames.end(), is_named_alike)) {
    for (PanelFrame& f : frames) {
      f.has_x_title = &f == &frames.back();
      f.x_title = 0.5 * figure.width;
    }
  }
  return frames;
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

}  // namespace whirl::inline io
