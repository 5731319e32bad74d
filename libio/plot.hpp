#pragma once
/// Plots of lines: what they show, and their layout. Shapes are written by svg.hpp.

#include <string>
#include <vector>

#include "libio/axis.hpp"

namespace whirl {

struct PlotAxis {
  std::string title;  ///< what and in which unit: "time per revolution [ns]"
  Scale scale = Scale::linear;
};

/// Points joined by a line in the order given; points that have no place are left out.
struct Series {
  std::string name;
  std::vector<double> x, y;
};

/// A vertical line at a number of the x axis.
struct PlotMark {
  double x = 0.0;
  std::string name;
};

struct LinePlot {
  std::string title, subtitle;
  PlotAxis x, y;
  std::vector<Series> series;
  std::vector<PlotMark> marks;
  double width = 720.0, height = 480.0;  ///< [pixels]
};

/// The plot as an SVG file, for light backgrounds. Each line bears its name, has its own marker,
/// and a color that people with color-vision deficiency tell apart.
///
/// @source colors: [OkabeIto2008], without the yellow, too light for lines; then wine, olive and gray
std::string svg_of(const LinePlot& plot);

}  // namespace whirl
