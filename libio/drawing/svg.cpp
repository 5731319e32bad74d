#include "libio/drawing/svg.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <unordered_set>

#include "libio/results/own_file.hpp"
#include "libio/text/xml.hpp"

namespace whirl::inline io {

namespace {

constexpr double exponent_size = 0.7, exponent_rise = 0.45;  ///< of the letters
constexpr double letter_width = 0.6;  ///< mean one of a sans-serif font, of its size

std::string number(double value) {
  return coordinate(value);
}

std::string stroke_attributes(const Stroke& s) {
  std::string text = fmt::format(" stroke=\"{}\" stroke-width=\"{}\"", s.color, number(s.width));
  if (!s.dashes.empty()) text += fmt::format(" stroke-dasharray=\"{}\"", s.dashes);
  return text;
}

/// Parts of a text outside and inside of ^{...}, in turn.
std::vector<std::string_view> exponents_apart(std::string_view text) {
  std::vector<std::string_view> parts;
  while (true) {
    const auto from = text.find("^{");
    const auto to = from == std::string_view::npos ? from : text.find('}', from);
    if (to == std::string_view::npos) break;
    parts.push_back(text.substr(0, from));
    parts.push_back(text.substr(from + 2, to - from - 2));
    text.remove_prefix(to + 1);
  }
  parts.push_back(text);
  return parts;
}

}  // namespace

std::string coordinate(double value) {
  std::string text = fmt::format("{:.2f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

Svg::Svg(double width, double height, std::string_view title)
    : width_(number(width)),
      height_(number(height)),
      head_(fmt::format(
          "viewBox=\"0 0 {} {}\" font-family=\"Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', "
          "sans-serif\">\n<title>{}</title>\n",
          width_, height_, xml_text(title))) {}

void Svg::set_size(std::string width, std::string height) {
  width_ = std::move(width);
  height_ = std::move(height);
}

void Svg::rectangle(Pixel corner, double width, double height, std::string_view fill) {
  body_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n",
                       number(corner.x), number(corner.y), number(width), number(height), fill);
}

void Svg::line(Pixel from, Pixel to, const Stroke& stroke) {
  body_ += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"{}/>\n", number(from.x),
                       number(from.y), number(to.x), number(to.y), stroke_attributes(stroke));
}

void Svg::polyline(const std::vector<Pixel>& points, const Stroke& stroke) {
  std::string list;
  for (const Pixel& p : points) {
    list += fmt::format("{}{},{}", list.empty() ? "" : " ", number(p.x), number(p.y));
  }
  body_ += fmt::format(
      "<polyline points=\"{}\" fill=\"none\" stroke-linejoin=\"round\" "
      "stroke-linecap=\"round\"{}/>\n",
      list, stroke_attributes(stroke));
}

void Svg::area(std::string_view outline, std::string_view fill, double opacity, bool is_crisp) {
  body_ += fmt::format("<path d=\"{}\" fill=\"{}\"", outline, fill);
  if (opacity < 1.0) body_ += fmt::format(" fill-opacity=\"{}\"", number(opacity));
  if (is_crisp) body_ += " shape-rendering=\"crispEdges\"";
  body_ += "/>\n";
}

void Svg::dots(const std::vector<Pixel>& centers, double size, std::string_view color) {
  constexpr double grid = 0.2;  // places nearer than this look the same [pixels]
  std::unordered_set<std::int64_t> seen;
  std::string list;
  for (const Pixel& p : centers) {
    const auto i = std::llround(p.x / grid), j = std::llround(p.y / grid);
    if (!seen.insert(i * 1'000'003 + j).second) continue;
    list += fmt::format("M{} {}h0", number(grid * static_cast<double>(i)),
                        number(grid * static_cast<double>(j)));
  }
  if (list.empty()) return;
  body_ += fmt::format(
      "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" "
      "stroke-linecap=\"round\"/>\n",
      list, color, number(size));
}

void Svg::marker(Marker shape, Pixel c, double size, std::string_view color) {
  const double r = 0.5 * size;
  if (shape == Marker::circle) {
    body_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"/>\n", number(c.x),
                         number(c.y), number(r), color);
    return;
  }
  std::vector<Pixel> corners;  // of equal area with the circle, about
  const double a = 0.88 * r, t = 1.25 * r;
  switch (shape) {
    case Marker::square:
      corners = {{-a, -a}, {a, -a}, {a, a}, {-a, a}};
      break;
    case Marker::diamond:
      corners = {{0.0, -t}, {t, 0.0}, {0.0, t}, {-t, 0.0}};
      break;
    case Marker::triangle:
      corners = {{0.0, -t}, {1.1 * r, 0.75 * r}, {-1.1 * r, 0.75 * r}};
      break;
    case Marker::triangle_down:
      corners = {{0.0, t}, {1.1 * r, -0.75 * r}, {-1.1 * r, -0.75 * r}};
      break;
    default: {
      const double o = 1.1 * r, w = 0.4 * r;  // arms of a standing cross
      corners = {{-w, -o}, {w, -o}, {w, -w}, {o, -w}, {o, w},   {w, w},
                 {w, o},   {-w, o}, {-w, w}, {-o, w}, {-o, -w}, {-w, -w}};
    }
  }
  std::string list;
  for (const Pixel& p : corners) {
    list += fmt::format("{}{},{}", list.empty() ? "" : " ", number(c.x + p.x), number(c.y + p.y));
  }
  body_ += fmt::format("<polygon points=\"{}\" fill=\"{}\"/>\n", list, color);
}

void Svg::text(Pixel place, std::string_view text, const TextStyle& style) {
  constexpr const char* anchors[] = {"start", "middle", "end"};
  body_ += fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\" fill=\"{}\" text-anchor=\"{}\"",
                       number(place.x), number(place.y), number(style.size), style.color,
                       anchors[static_cast<int>(style.anchor)]);
  if (style.rotation != 0.0) {
    body_ += fmt::format(" transform=\"rotate({} {} {})\"", number(style.rotation), number(place.x),
                         number(place.y));
  }
  if (style.is_bold) body_ += " font-weight=\"bold\"";
  if (style.has_halo) {
    body_ +=
        " stroke=\"#ffffff\" stroke-width=\"3\" stroke-linejoin=\"round\" "
        "paint-order=\"stroke\"";
  }
  body_ += ">";
  const auto parts = exponents_apart(text);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i % 2 == 0) {
      // back on the base line after an exponent
      const std::string down =
          i == 0 ? "" : fmt::format(" dy=\"{}\"", number(exponent_rise * style.size));
      if (parts[i].empty()) continue;
      body_ += i == 0 ? xml_text(parts[i])
                      : fmt::format("<tspan{}>{}</tspan>", down, xml_text(parts[i]));
    } else {
      body_ += fmt::format("<tspan dy=\"{}\" font-size=\"{}\">{}</tspan>",
                           number(-exponent_rise * style.size), number(exponent_size * style.size),
                           xml_text(parts[i]));
    }
  }
  body_ += "</text>\n";
}

void Svg::begin_group(std::string_view name) {
  body_ += fmt::format("<g data-name=\"{}\">\n", xml_text(name));
}

void Svg::end_group() {
  body_ += "</g>\n";
}

void Svg::begin_clip(Pixel corner, double width, double height) {
  ++clips_;
  body_ += fmt::format(
      "<clipPath id=\"clip{0}\"><rect x=\"{1}\" y=\"{2}\" width=\"{3}\" "
      "height=\"{4}\"/></clipPath>\n"
      "<g clip-path=\"url(#clip{0})\">\n",
      clips_, number(corner.x), number(corner.y), number(width), number(height));
}

std::string Svg::document() const {
  return fmt::format(
             "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{}\n<svg "
             "xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" ",
             xml_mark, width_, height_) +
         head_ + body_ + "</svg>\n";
}

double text_width(std::string_view text, double size) {
  double width = 0.0;
  const auto parts = exponents_apart(text);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    double letters = 0.0;
    for (const char c : parts[i]) {
      letters += (static_cast<unsigned char>(c) & 0xC0u) != 0x80u ? 1.0 : 0.0;  // UTF-8
    }
    width += letters * letter_width * size * (i % 2 == 0 ? 1.0 : exponent_size);
  }
  return width;
}

}  // namespace whirl::inline io
