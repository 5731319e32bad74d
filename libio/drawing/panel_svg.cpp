#include "libio/drawing/panel_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libio/drawing/panel_cells.hpp"

namespace whirl::inline io {

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

/// Texts within a panel. In a picture of a given size one that would lie on another one, or reach
/// out of the picture, is moved up or down by a line, or left out.
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

/// Whether a rule crosses what is seen of a panel.
bool is_seen(const PanelFrame& f, const Rule& r) {
  constexpr double slack = 1e-9;
  const auto is_on = [](const Axis& axis, double value) {
    const double place = axis.place(value);
    return place >= -slack && place <= 1.0 + slack;
  };
  if (r.kind == Rule::Kind::vertical) return is_on(f.x, r.at);
  if (r.kind == Rule::Kind::horizontal) return is_on(f.y, r.at);
  const auto [low, high] = std::minmax({r.at * f.x.first, r.at * f.x.last});
  return low < f.y.last && high > f.y.first;
}

/// A line through zero: from where to where it is seen, and its name there.
struct SlopeEnds {
  Pixel from, to, name;
  Anchor anchor;
};

/// Through the panel to its right or upper edge; a line that falls, where all is above zero, to the
/// left or upper one.
SlopeEnds slope_ends(const PanelFrame& f, double slope) {
  const auto at = [&](double x) { return f.at(x, slope * x); };
  if (slope < 0.0 && f.y.first >= 0.0) {
    const bool is_left = f.y.last / slope <= f.x.first;
    const Pixel to = at(is_left ? f.x.first : f.y.last / slope);
    return {at(std::min(f.x.last, f.y.first / slope)),
            to,
            {to.x + 4.0, to.y + (is_left ? -3.0 : 14.0)},
            Anchor::start};
  }
  double x = f.x.last;
  if (slope * x > f.y.last) x = f.y.last / slope;
  if (slope * x < f.y.first) x = f.y.first / slope;
  const auto [low, high] = std::minmax({f.y.first / slope, f.y.last / slope});
  const Pixel to = at(x);
  const bool is_right = x >= f.x.last * (1.0 - 1e-9);
  const bool is_outside = is_right && !is_tight(f);  // inside, names of curves are not in the way
  return {at(std::clamp(f.x.first, low, high)),
          to,
          {to.x + (is_outside ? 5.0 : -4.0), to.y + (is_outside ? 4.0
                                                     : is_right ? -3.0
                                                                : 14.0)},
          is_outside ? Anchor::start : Anchor::end};
}

void draw_rules(Svg& svg, const PanelFrame& f, PanelTexts& texts) {
  for (const Rule& r : f.panel->rules) {
    const Stroke stroke{color_of(r.paint), 1.1, dashes_of(r.dash)};
    TextStyle style{.size = small_letters, .color = text_color_of(r.paint), .has_halo = true};
    if (!is_seen(f, r)) continue;
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
      } else if (!has_end_names(*f.panel)) {
        svg.text({f.right() + 5.0, y + 4.0}, r.name, style);
      }
    } else {
      const SlopeEnds ends = slope_ends(f, r.at);
      svg.line(ends.from, ends.to, stroke);
      style.anchor = ends.anchor;
      texts.add(ends.name, r.name, style);
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
    const double far = 50.0 * (f.width + f.height);  // ends of lines that are seen, if nearer
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
    constexpr double rounding = 0.5;  // [pixels]: points on the frame are whole
    const bool is_seen = p.x > f.corner.x - rounding && p.x < f.right() + rounding &&
                         p.y > f.corner.y - rounding && p.y < f.floor() + rounding;
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

/// Names at the ends of lines, and of horizontal rules beside them, kept apart, each with a line to
/// its end.
void draw_end_names(Svg& svg, const PanelFrame& f) {
  struct End {
    std::string name;
    Paint paint;
    Pixel place;
    bool is_rule = false;
  };
  std::vector<End> ends;
  for (const Curve& c : f.panel->curves) {
    End end{c.end_name, c.paint, {-1.0, 0.0}};
    for (std::size_t i = 0; i < c.x.size() && !c.end_name.empty(); ++i) {
      if (!has_place(*f.panel, c.x[i], c.y[i])) continue;
      const Pixel p = f.at(c.x[i], c.y[i]);
      const bool is_seen = p.x >= f.corner.x - 1.0 && p.x <= f.right() + 1.0 &&
                           p.y >= f.corner.y - 1.0 && p.y <= f.floor() + 1.0;
      if (is_seen && p.x > end.place.x) end.place = p;
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
  for (const Rule& r : f.panel->rules) {
    if (r.kind != Rule::Kind::horizontal || r.name.empty()) continue;
    if (is_tight(f) || !has_end_names(*f.panel)) continue;
    const double y = f.at(f.x.first, r.at).y;
    const bool is_seen = y >= f.corner.y - 1.0 && y <= f.floor() + 1.0;
    if (is_seen) ends.push_back({r.name, r.paint, {f.right(), y}, true});
  }
  std::stable_sort(ends.begin(), ends.end(),
                   [](const End& a, const End& b) { return a.place.y < b.place.y; });
  std::vector<double> wanted;
  for (const End& e : ends) wanted.push_back(e.place.y);
  const auto places = spread(wanted, label_distance, f.corner.y, f.floor());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const End& e = ends[i];
    const double x = f.right() + f.rooms->name, y = places[i];
    svg.polyline({e.place, {x - f.rooms->leader, y}, {x - 5.0, y}},
                 {color_of(e.paint), 0.8, "1 3"});
    svg.text({x, y + 0.35 * letters}, e.name,
             {.size = letters,
              .color = text_color_of(e.paint),
              .is_bold = !e.is_rule,
              .has_halo = true});
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
    if (at.y < f.corner.y - 9.0 || at.y > f.floor() + 9.0) continue;
    texts.add({at.x + l.dx, at.y + l.dy}, l.text,
              {11.5, text_color_of(l.paint), l.anchor, 0.0, false, true});
  }
}

}  // namespace whirl::inline io
