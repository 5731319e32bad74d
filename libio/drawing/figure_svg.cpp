#include "libio/drawing/figure_svg.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "libio/drawing/panel_layout.hpp"
#include "libio/drawing/panel_svg.hpp"

namespace whirl::inline io {

using namespace figure_style;

namespace {

/// Draws the legend from a height on; the height below it.
double draw_legend(Svg& svg, const Figure& figure, double y, const Rooms& rooms) {
  const auto entries = legend_of(figure);
  if (entries.empty()) return y;
  const bool is_tight = rooms.is_tight;
  svg.begin_group("legend");
  double x = rooms.margin;
  y += rooms.row;
  for (const LegendEntry& e : entries) {
    const double sample = rooms.sample, gap = is_tight ? 4.0 : 6.0;
    const double letters_share = is_tight ? 1.0 : 0.88;  // of the estimate, which is a wide one
    const double width = sample + gap + 2.0 + letters_share * text_width(e.name(), small_letters) +
                         (is_tight ? 8.0 : 18.0);
    if (x > rooms.margin && x + width > figure.width - 8.0) x = rooms.margin, y += rooms.row;
    const double middle = y - 4.0;
    const std::string box =
        fmt::format("M{} {}h{}v11h-{}z", coordinate(x + (is_tight ? 2.0 : 8.0)),
                    coordinate(y - 10.0), is_tight ? 14 : 20, is_tight ? 14 : 20);
    if (e.category) {
      svg.area(box, color_of(e.category->paint), 1.0);
    } else {
      const Curve& c = *e.curve;
      if (c.has_line && c.fill == 0.0) {
        svg.line({x, middle}, {x + sample, middle},
                 {color_of(c.paint), std::max(1.2, c.width), dashes_of(c.dash)});
      } else if (c.fill > 0.0) {
        svg.area(box, color_of(c.paint), c.fill);
      }
      if (c.has_marker)
        svg.marker(c.marker, {x + 0.5 * sample, middle}, std::clamp(c.size, 4.0, 9.0),
                   color_of(c.paint));
    }
    svg.text({x + sample + gap, y}, e.name(), {small_letters, color_of(Paint::ink)});
    x += width;
  }
  svg.end_group();
  return y + 6.0;
}

/// Words in lines that fit a width.
std::vector<std::string> wrapped(const std::string& text, double width) {
  std::vector<std::string> lines(1);
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find(' ', from), text.size());
    const std::string word = text.substr(from, to - from);
    const std::string longer = lines.back() + (lines.back().empty() ? "" : " ") + word;
    if (lines.back().empty() || 0.88 * text_width(longer, small_letters) <= width) {
      lines.back() = longer;
    } else {
      lines.push_back(word);
    }
    from = to + 1;
  }
  return lines;
}

/// Takes from the widest columns what does not fit into a width: their cells are wrapped.
void fit(std::vector<double>& widths, double room) {
  constexpr double narrowest = 90.0;
  double all = std::accumulate(widths.begin(), widths.end(), 0.0);
  while (all > room) {
    double& widest = *std::max_element(widths.begin(), widths.end());
    if (widest <= narrowest) return;
    const double less = std::min({all - room, widest - narrowest, 20.0});
    widest -= less;
    all -= less;
  }
}

/// Widths of a table's columns.
std::vector<double> column_widths(const FigureTable& t) {
  std::vector<double> widths(t.header.size());
  for (std::size_t c = 0; c < widths.size(); ++c) {
    widths[c] = text_width(t.header[c], small_letters) + 16.0;
    for (const auto& r : t.rows) {
      if (c < r.size()) widths[c] = std::max(widths[c], text_width(r[c], small_letters) + 16.0);
    }
  }
  return widths;
}

double draw_table(Svg& svg, const Figure& figure, double y, const Rooms& rooms) {
  const FigureTable& t = figure.table;
  if (t.rows.empty()) return y;
  std::vector<double> widths = column_widths(t);
  fit(widths, figure.width - rooms.margin - 16.0);
  const auto line = [&](const std::vector<std::string>& cells, bool is_bold) {
    double x = rooms.margin;
    std::size_t lines = 1;
    for (std::size_t c = 0; c < std::min(cells.size(), widths.size()); ++c) {
      const std::vector<std::string> parts = wrapped(cells[c], widths[c] - 8.0);
      for (std::size_t i = 0; i < parts.size(); ++i) {
        svg.text({x, y + rooms.row * static_cast<double>(i + 1)}, parts[i],
                 {.size = small_letters, .color = color_of(Paint::ink), .is_bold = is_bold});
      }
      lines = std::max(lines, parts.size());
      x += widths[c];
    }
    y += rooms.row * static_cast<double>(lines);
  };
  svg.begin_group("table");
  y += 4.0;
  line(t.header, true);
  svg.line({rooms.margin, y + 5.0}, {figure.width - 16.0, y + 5.0},
           {color_of(Paint::gray), 0.8, ""});
  y += 3.0;
  for (const auto& r : t.rows) line(r, false);
  svg.end_group();
  return y + 6.0;
}

/// Draws title and subtitle; the height below them.
double draw_titles(Svg& svg, const Figure& figure, const Rooms& rooms) {
  const bool is_tight = rooms.is_tight;
  const double margin = rooms.margin;
  double y = is_tight ? 0.0 : 8.0;
  if (!figure.title.empty()) {
    const double room = is_tight ? figure.width - 2.0 * margin : 0.75 * (figure.width - 90.0);
    for (const std::string& line : wrapped(figure.title, (is_tight ? 0.7 : 1.0) * room)) {
      svg.text({margin, y += is_tight ? 17.0 : 20.0}, line,
               {.size = title_letters, .color = color_of(Paint::ink), .is_bold = true});
    }
  }
  if (!figure.subtitle.empty()) {
    for (const std::string& line : wrapped(figure.subtitle, figure.width - margin - 10.0)) {
      svg.text({margin, y += is_tight ? 14.0 : 18.0}, line,
               {.size = small_letters, .color = text_color_of(Paint::gray)});
    }
  }
  return y;
}

double draw_notes(Svg& svg, const Figure& figure, double y, const Rooms& rooms) {
  for (const std::string& note : figure.notes) {
    for (const std::string& line : wrapped(note, figure.width - rooms.margin - 10.0)) {
      svg.text({rooms.margin, y += rooms.row}, line,
               {.size = small_letters, .color = text_color_of(Paint::gray)});
    }
  }
  return y;
}

/// Pixels of a screen, of which CSS and rsvg-convert have 96 per inch.
constexpr double pixels_per_mm = 96.0 / 25.4, points_per_pixel = 0.75;
constexpr double own_font = 9.0, given_font = 8.0;  ///< letters where none are asked for [pt]

/// Height of what a drawing function draws.
template <class Draw>
double height_of(const Figure& figure, const Draw& draw) {
  Svg nothing(figure.width, figure.height, "");
  return draw(nothing, figure, 0.0, tight);
}

/// Whether all panels are large enough to be read.
bool is_readable(const std::vector<PanelFrame>& frames) {
  constexpr double narrowest = 88.0, lowest = 44.0;  // [pixels], seven and four letters high
  return std::all_of(frames.begin(), frames.end(), [](const PanelFrame& f) {
    return f.width >= narrowest && f.height >= lowest;
  });
}

std::string named(const Panel& p) {
  const std::string title = p.title.substr(0, p.title.find(" | "));
  return title.empty() ? p.y.title.substr(0, p.y.title.find(" [")) : title;
}

/// Leaves out of a figure of a given size what would keep its panels from being read.
/// @param top  height at which panels begin
/// @return     height at which they end
double fit(Figure& figure, double top, std::vector<std::string>& left_out) {
  constexpr double least = 0.55;  // of the height, for panels: below, notes and table are left out
  const double whole = figure.height;
  const auto floor = [&] {
    return whole - height_of(figure, draw_legend) - height_of(figure, draw_table) -
           height_of(figure, draw_notes) - 5.0;
  };
  if (!figure.notes.empty() && floor() - top < least * whole) {
    figure.notes.clear();
    left_out.emplace_back("the notes");
  }
  double table_width = 0.0;
  for (const double w : column_widths(figure.table)) table_width += w;
  if (!figure.table.rows.empty() && (floor() - top < least * whole || table_width > figure.width)) {
    figure.table = {};
    left_out.emplace_back("the table");
  }
  const auto can_be_read = [&] {
    figure.height = floor();
    return is_readable(frames_of(figure, top, tight));
  };
  std::vector<std::string> panels;
  while (!can_be_read()) {
    if (figure.columns > 1) {
      const auto frames = frames_of(figure, top, tight);
      const bool is_narrow = std::any_of(frames.begin(), frames.end(),
                                         [](const PanelFrame& f) { return f.width < f.height; });
      if (is_narrow) {
        --figure.columns;
        continue;
      }
    }
    if (!figure.notes.empty()) {
      figure.notes.clear();
      left_out.emplace_back("the notes");
      continue;
    }
    if (!figure.table.rows.empty()) {
      figure.table = {};
      left_out.emplace_back("the table");
      continue;
    }
    if (figure.panels.size() == 1) break;
    panels.insert(panels.begin(), named(figure.panels.back()));
    figure.panels.pop_back();
  }
  if (!panels.empty()) {
    left_out.push_back(fmt::format("{} of {} panels: {}", panels.size(),
                                   panels.size() + figure.panels.size(), fmt::join(panels, ", ")));
  }
  return figure.height;
}

/// A picture of a given size.
Picture sized(Figure figure, const PictureSize& size) {
  const double scale = size.font / (points_per_pixel * small_letters);
  const double width = size.is_given() ? size.width * pixels_per_mm : figure.width;
  const double height = size.is_given() ? size.height * pixels_per_mm : figure.height;
  figure.width = width / scale;
  figure.height = height / scale;
  const double whole = figure.height;
  Picture picture;
  Svg svg(figure.width, whole, figure.title);
  const auto length = [](double pixels) {
    return fmt::format("{}mm", coordinate(pixels / pixels_per_mm));
  };
  svg.set_size(length(width), length(height));
  svg.rectangle({0.0, 0.0}, figure.width, whole, "#ffffff");
  if (!size.has_title) figure.title.clear(), figure.subtitle.clear();
  const double top = draw_titles(svg, figure, tight) + 2.0;
  double y = fit(figure, top, picture.left_out);
  for (const PanelFrame& f : frames_of(figure, top, tight)) draw_panel(svg, f);
  y = draw_legend(svg, figure, y - 3.0, tight);
  y = draw_table(svg, figure, y, tight);
  draw_notes(svg, figure, y, tight);
  picture.svg = svg.document();
  return picture;
}

}  // namespace

double pixels_per_point(const PictureSize& size) {
  const double font = size.font > 0.0 ? size.font : size.is_given() ? given_font : own_font;
  return small_letters / font;
}

Picture picture_of(const Figure& figure, const PictureSize& size) {
  if (size.is_given() || size.font > 0.0) {
    PictureSize full = size;
    if (!(full.font > 0.0)) full.font = size.is_given() ? given_font : own_font;
    return sized(figure, full);
  }
  Figure shown = figure;
  if (!size.has_title) shown.title.clear(), shown.subtitle.clear();
  return {svg_of(shown), {}};
}

std::string svg_of(const Figure& figure) {
  // what is below the panels decides about the height: it is written twice
  double height = figure.height;
  for (int pass = 0;; ++pass) {
    Svg svg(figure.width, height, figure.title);
    svg.rectangle({0.0, 0.0}, figure.width, height, "#ffffff");
    double y = draw_titles(svg, figure, wide);
    for (const PanelFrame& f : frames_of(figure, y + 6.0)) draw_panel(svg, f);
    y = draw_legend(svg, figure, figure.height - 6.0, wide);
    y = draw_table(svg, figure, y, wide);
    y = draw_notes(svg, figure, y, wide);
    const double needed = std::max(figure.height, y + 12.0);
    if (pass > 0 || needed == height) return svg.document();
    height = needed;
  }
}

}  // namespace whirl::inline io
