#include "libio/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "libio/svg.hpp"

namespace whirl {

namespace {

/// Of a line, and of its name, dark enough to be read.
struct Color {
  const char *line, *text;
};
constexpr std::array<Color, 10> colors{{{"#0072b2", "#00659e"},
                                        {"#d55e00", "#b85100"},
                                        {"#009e73", "#007d5b"},
                                        {"#cc79a7", "#a8507f"},
                                        {"#e69f00", "#946600"},
                                        {"#56b4e9", "#1c7bb0"},
                                        {"#000000", "#000000"},
                                        {"#882255", "#882255"},
                                        {"#999933", "#6b6b1f"},
                                        {"#888888", "#666666"}}};
constexpr const char *ink = "#222222", *faint = "#e4e4e4", *gray = "#707070";
constexpr double letters = 13.0, small_letters = 12.0, title_letters = 15.0;
constexpr double left = 76.0, bottom = 58.0;  ///< margins, room for tick labels and axis titles
constexpr double label_gap = 30.0, label_distance = 17.0, leader = 22.0;
constexpr double bold = 1.1;    ///< letters are wider
constexpr double margin = 1.1;  ///< between points and the limits of logarithmic axes

/// The area between the axes.
struct Frame {
  Axis x, y;
  Pixel corner;  ///< upper left
  double width = 0.0, height = 0.0;

  double right() const { return corner.x + width; }
  double floor() const { return corner.y + height; }
  double at_x(double value) const { return corner.x + width * x.place(value); }
  double at_y(double value) const { return floor() - height * y.place(value); }
};

bool has_place(const LinePlot& plot, double x, double y) {
  return std::isfinite(x) && std::isfinite(y) && (plot.x.scale == Scale::linear || x > 0.0) &&
         (plot.y.scale == Scale::linear || y > 0.0);
}

Frame frame_of(const LinePlot& plot) {
  std::vector<double> x, y;
  double longest = 0.0;
  for (const Series& s : plot.series) {
    longest = std::max(longest, bold * text_width(s.name, letters));
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      if (!has_place(plot, s.x[i], s.y[i])) continue;
      for (const double side : {1.0 / margin, margin}) {
        x.push_back(plot.x.scale == Scale::logarithmic ? side * s.x[i] : s.x[i]);
        y.push_back(plot.y.scale == Scale::logarithmic ? side * s.y[i] : s.y[i]);
      }
    }
  }
  for (const PlotMark& m : plot.marks) x.push_back(m.x);
  Frame f;
  f.x = axis_around(x, plot.x.scale);
  f.y = axis_around(y, plot.y.scale);
  f.corner = {left,
              20.0 + (plot.title.empty() ? 0.0 : 24.0) + (plot.subtitle.empty() ? 0.0 : 20.0)};
  f.width = plot.width - left - label_gap - longest - 12.0;
  f.height = plot.height - f.corner.y - bottom;
  return f;
}

void draw_axes(Svg& svg, const LinePlot& plot, const Frame& f) {
  constexpr double room_x = 62.0, room_y = 40.0;  // of a tick label
  svg.begin_group("axes");
  const std::vector<Tick> along = f.x.ticks(static_cast<int>(f.width / room_x));
  const std::vector<Tick> up = f.y.ticks(static_cast<int>(f.height / room_y));
  for (const Tick& t : along) {
    const double x = f.at_x(t.value);
    if (!t.label.empty()) svg.line({x, f.corner.y}, {x, f.floor()}, {faint, 1.0, ""});
  }
  for (const Tick& t : up) {
    const double y = f.at_y(t.value);
    if (!t.label.empty()) svg.line({f.corner.x, y}, {f.right(), y}, {faint, 1.0, ""});
  }
  for (const Tick& t : along) {
    const double x = f.at_x(t.value), length = t.label.empty() ? 3.0 : 6.0;
    svg.line({x, f.floor()}, {x, f.floor() + length}, {ink, 1.0, ""});
    svg.text({x, f.floor() + 22.0}, t.label, {small_letters, ink, Anchor::middle});
  }
  for (const Tick& t : up) {
    const double y = f.at_y(t.value), length = t.label.empty() ? 3.0 : 6.0;
    svg.line({f.corner.x - length, y}, {f.corner.x, y}, {ink, 1.0, ""});
    svg.text({f.corner.x - 10.0, y + 4.5}, t.label, {small_letters, ink, Anchor::end});
  }
  svg.line({f.corner.x, f.floor()}, {f.right(), f.floor()}, {ink, 1.0, ""});
  svg.line({f.corner.x, f.corner.y}, {f.corner.x, f.floor()}, {ink, 1.0, ""});
  svg.text({f.corner.x + 0.5 * f.width, plot.height - 14.0}, plot.x.title,
           {letters, ink, Anchor::middle});
  svg.text({20.0, f.corner.y + 0.5 * f.height}, plot.y.title,
           {letters, ink, Anchor::middle, -90.0});
  svg.end_group();
}

void draw_marks(Svg& svg, const LinePlot& plot, const Frame& f) {
  for (const PlotMark& m : plot.marks) {
    if (!has_place(plot, m.x, f.y.last)) continue;
    const double x = f.at_x(m.x);
    svg.begin_group(m.name);
    svg.line({x, f.corner.y}, {x, f.floor()}, {gray, 1.0, "5 4"});
    svg.text({x + 5.0, f.floor() - 8.0}, m.name,
             {.size = small_letters, .color = gray, .has_halo = true});
    svg.end_group();
  }
}

/// A line with its markers, and where it ends: at the largest x.
struct Drawn {
  const Series* series;
  std::size_t number;
  std::vector<Pixel> points;
  Pixel end;
};

void draw_series(Svg& svg, const Drawn& d, double label_x, double label_y) {
  const auto& [color, dark] = colors[d.number % colors.size()];
  const auto shape = static_cast<Marker>(d.number % markers);
  svg.begin_group(d.series->name);
  // from the end of the line to its name
  svg.polyline({d.end, {label_x - leader, label_y}, {label_x - 5.0, label_y}}, {color, 0.8, "1 3"});
  svg.polyline(d.points, {color, 2.0, ""});
  for (const Pixel& p : d.points) svg.marker(shape, p, 8.0, color);
  svg.text({label_x, label_y + 0.35 * letters}, d.series->name,
           {.size = letters, .color = dark, .is_bold = true, .has_halo = true});
  svg.end_group();
}

}  // namespace

std::string svg_of(const LinePlot& plot) {
  const Frame f = frame_of(plot);
  Svg svg(plot.width, plot.height, plot.title);
  svg.rectangle({0.0, 0.0}, plot.width, plot.height, "#ffffff");
  double y = 0.0;
  if (!plot.title.empty()) {
    svg.text({f.corner.x, y += 28.0}, plot.title,
             {.size = title_letters, .color = ink, .is_bold = true});
  }
  if (!plot.subtitle.empty()) {
    svg.text({f.corner.x, y += 20.0}, plot.subtitle, {.size = small_letters, .color = gray});
  }
  draw_axes(svg, plot, f);
  draw_marks(svg, plot, f);

  std::vector<Drawn> lines;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& s = plot.series[i];
    Drawn d{&s, i, {}, {-1.0, 0.0}};
    for (std::size_t j = 0; j < s.x.size(); ++j) {
      if (!has_place(plot, s.x[j], s.y[j])) continue;
      d.points.push_back({f.at_x(s.x[j]), f.at_y(s.y[j])});
      if (d.points.back().x > d.end.x) d.end = d.points.back();
    }
    if (!d.points.empty()) lines.push_back(std::move(d));
  }
  std::stable_sort(lines.begin(), lines.end(),
                   [](const Drawn& a, const Drawn& b) { return a.end.y < b.end.y; });
  std::vector<double> wanted;
  for (const Drawn& d : lines) wanted.push_back(d.end.y);
  const auto places = spread(wanted, label_distance, f.corner.y, f.floor());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    draw_series(svg, lines[i], f.right() + label_gap, places[i]);
  }
  return svg.document();
}

}  // namespace whirl
