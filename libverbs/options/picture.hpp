#pragma once
/// The picture of a figure: its file and size, and what a person wants otherwise in it.

#include <string>

#include "libio/drawing/figure.hpp"
#include "libio/drawing/picture_file.hpp"
#include "libverbs/command/invocation.hpp"
#include "libverbs/command/verb.hpp"

namespace whirl::inline cli {

/// Ranges, scales, names, panels and markers, as FigureView has them.
struct FigureViewOptions {
  Option<std::string> xlim{
      "xlim", "A:B",
      "range of x, such as 0:9000rpm, or 100: with one end; several panels: with commas"};
  Option<std::string> ylim{"ylim", "A:B", "range of y, likewise"};
  Option<std::string> log{"log", "AXES", "logarithmic axes: x, y or xy; none: linear ones"};
  Option<std::string> panels{"panels", "LIST",
                             "panels of the figure that are drawn, such as 1,3 or phase"};
  Option<std::string> title{"title", "TEXT", "instead of the title of the model"};
  Option<std::string> xlabel{"xlabel", "TEXT", "instead of the name of x; several panels: with ;"};
  Option<std::string> ylabel{"ylabel", "TEXT", "instead of the name of y, likewise"};
  Option<std::string> labels{"labels", "TEXT;TEXT",
                             "names in the legend, in its order, or OLD=NEW for any name"};
  Option<std::string> marker{"marker", "M",
                             "of points: circle, square, diamond, triangle, triangle_down, cross"};
  Option<double> marker_size{"marker-size", "PT", "of points, in points", parse_marker_size};
  auto fields() {
    return std::tie(xlim, ylim, log, panels, title, xlabel, ylabel, labels, marker, marker_size);
  }
};

struct PictureVerbOptions {
  Option<std::string> out =
      output_option("out", "FILE", "picture, .svg, .png or .pdf; left out: .svg beside the result");
  Option<PrintedSides> size{
      "size", "WxHmm", "of the printed picture, such as 85x60mm; cm, in and pt too", parse_sides};
  Option<double> font{
      "font", "PT", "letters of axes and legend in points; left out: 9, with --size 8", parse_font};
  Flag no_title{"no-title", "without title and subtitle, for a caption below"};
  Option<PictureFormat> format{"format", "F",
                               "svg, png or pdf, where --out does not end in one of them"};
  FigureViewOptions view{};
  auto fields() { return std::tie(out, size, font, no_title, format, view); }
};

/// Writes the picture of a figure, and tells it.
/// @throws ModelError  for options that mean nothing, or nothing in this figure
Report write_figure(const Invocation& call, Figure figure, const PictureVerbOptions& options);

}  // namespace whirl::inline cli
