#include "libio/figure_svg.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "libio/panel_svg.hpp"

namespace whirl {

using namespace figure_style;

namespace {

/// What stands in the legend below the panels: each name once.
struct Entry {
  const Curve* curve = nullptr;
  const Category* category = nullptr;
  const std::string& name() const { return curve ? curve->name : category->name; }
};

std::vector<Entry> legend_of(const Figure& figure) {
  std::vector<Entry> entries;
  const auto add = [&](const Entry& entry) {
    const bool is_known = std::any_of(entries.begin(), entries.end(),
                                      [&](const Entry& e) { return e.name() == entry.name(); });
    if (!entry.name().empty() && !is_known) entries.push_back(entry);
  };
  for (const Panel& p : figure.panels) {
    for (const Category& c : p.cells.categories) add({nullptr, &c});
    for (const Curve& c : p.curves) add({&c, nullptr});
  }
  return entries;
}

/// Draws the legend from a height on; the height below it.
double draw_legend(Svg& svg, const Figure& figure, double y) {
  const auto entries = legend_of(figure);
  if (entries.empty()) return y;
  svg.begin_group("legend");
  double x = left;
  y += row;
  for (const Entry& e : entries) {
    const double width = 38.0 + 0.88 * text_width(e.name(), small_letters) + 18.0;
    if (x > left && x + width > figure.width - 8.0) x = left, y += row;
    const double middle = y - 4.0;
    if (e.category) {
      const std::string box =
          fmt::format("M{} {}h20v11h-20z", coordinate(x + 8.0), coordinate(y - 10.0));
      svg.area(box, color_of(e.category->paint), 1.0);
    } else {
      const Curve& c = *e.curve;
      if (c.has_line && c.fill == 0.0) {
        svg.line({x, middle}, {x + 30.0, middle},
                 {color_of(c.paint), std::max(1.2, c.width), dashes_of(c.dash)});
      } else if (c.fill > 0.0) {
        svg.area(fmt::format("M{} {}h20v11h-20z", coordinate(x + 8.0), coordinate(y - 10.0)),
                 color_of(c.paint), c.fill);
      }
      if (c.has_marker)
        svg.marker(c.marker, {x + 15.0, middle}, std::clamp(c.size, 4.0, 9.0), color_of(c.paint));
    }
    svg.text({x + 36.0, y}, e.name(), {small_letters, color_of(Paint::ink)});
    x += width;
  }
  svg.end_group();
  return y + 6.0;
}

double draw_table(Svg& svg, const Figure& figure, double y) {
  const FigureTable& t = figure.table;
  if (t.rows.empty()) return y;
  std::vector<double> widths(t.header.size());
  for (std::size_t c = 0; c < widths.size(); ++c) {
    widths[c] = text_width(t.header[c], small_letters) + 16.0;
    for (const auto& r : t.rows)
      widths[c] = std::max(widths[c], text_width(r[c], small_letters) + 16.0);
  }
  const auto line = [&](const std::vector<std::string>& cells, bool is_bold) {
    double x = left;
    y += row;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      svg.text({x, y}, cells[c],
               {.size = small_letters, .color = color_of(Paint::ink), .is_bold = is_bold});
      x += widths[c];
    }
  };
  svg.begin_group("table");
  y += 4.0;
  line(t.header, true);
  svg.line({left, y + 5.0}, {figure.width - 16.0, y + 5.0}, {color_of(Paint::gray), 0.8, ""});
  y += 3.0;
  for (const auto& r : t.rows) line(r, false);
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

}  // namespace

std::string svg_of(const Figure& figure) {
  // what is below the panels decides about the height: it is written twice
  double height = figure.height;
  for (int pass = 0;; ++pass) {
    Svg svg(figure.width, height, figure.title);
    svg.rectangle({0.0, 0.0}, figure.width, height, "#ffffff");
    double y = 8.0;
    const auto title = figure.title.empty() ? std::vector<std::string>{}
                                            : wrapped(figure.title, 0.75 * (figure.width - 90.0));
    for (const std::string& line : title) {
      svg.text({left, y += 20.0}, line,
               {.size = title_letters, .color = color_of(Paint::ink), .is_bold = true});
    }
    if (!figure.subtitle.empty()) {
      for (const std::string& line : wrapped(figure.subtitle, figure.width - left - 10.0)) {
        svg.text({left, y += 18.0}, line,
                 {.size = small_letters, .color = text_color_of(Paint::gray)});
      }
    }
    for (const PanelFrame& f : frames_of(figure, y + 6.0)) draw_panel(svg, f);
    y = draw_legend(svg, figure, figure.height - 6.0);
    y = draw_table(svg, figure, y);
    for (const std::string& note : figure.notes) {
      for (const std::string& line : wrapped(note, figure.width - left - 10.0)) {
        svg.text({left, y += row}, line,
                 {.size = small_letters, .color = text_color_of(Paint::gray)});
      }
    }
    const double needed = std::max(figure.height, y + 12.0);
    if (pass > 0 || needed == height) return svg.document();
    height = needed;
  }
}

}  // namespace whirl
