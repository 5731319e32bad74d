#pragma once
/// Panels of a figure in an SVG picture.

#include <string>
#include <vector>

#include "libio/figure.hpp"
#include "libio/svg.hpp"

namespace whirl {

namespace figure_style {

constexpr double letters = 13.0, small_letters = 12.0, title_letters = 15.0;
constexpr double left = 82.0;  ///< room for tick labels and titles of axes
constexpr double row = 19.0;   ///< of legend, notes, table

/// Colors on white.
const char* color_of(Paint paint);
const char* text_color_of(Paint paint);
std::string dashes_of(Dash dash);

}  // namespace figure_style

/// A panel's place and axes.
struct PanelFrame {
  const Panel* panel = nullptr;
  Axis x, y;
  Pixel corner;  ///< upper left
  double width = 0.0, height = 0.0;
  bool is_lowest = true;  ///< x is named below

  double right() const { return corner.x + width; }
  double floor() const { return corner.y + height; }
  Pixel at(double vx, double vy) const {
    return {corner.x + width * x.place(vx), floor() - height * y.place(vy)};
  }
};

/// Places of the panels below a height.
std::vector<PanelFrame> frames_of(const Figure& figure, double top);

/// Draws a panel with its axes.
void draw_panel(Svg& svg, const PanelFrame& frame);

}  // namespace whirl
