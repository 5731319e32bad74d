#pragma once

#include <string>
#include <vector>

#include "libio/drawing/figure.hpp"

namespace whirl::inline io {

/// How large a picture is to be printed.
struct PictureSize {
  double width = 0.0, height = 0.0;  ///< [mm]; 0: as large as the figure wants to be
  double font = 0.0;  ///< letters of axes and legend [pt]; 0: 8 if width is given, else 9
  bool has_title = true;

  bool is_given() const { return width > 0.0; }
};

/// Pixels of a figure in a point of its printed picture.
double pixels_per_point(const PictureSize& size);

struct Picture {
  std::string svg;
  std::vector<std::string> left_out;  ///< what had no room, for people
};

/// A figure as an SVG file, for papers and light backgrounds.
///
/// Long lines are thinned to what can be seen, dots that hide each other are written once; the
/// largest study stays a file of a few megabytes.
///
/// In a picture of a given size letters keep their size, and panels get the room that is left.
/// Notes, the table and the last panels are left out, in this order, where panels would be too
/// small to read.
Picture picture_of(const Figure& figure, const PictureSize& size);

/// The SVG file of a figure, as large as the figure wants to be.
std::string svg_of(const Figure& figure);

}  // namespace whirl::inline io
