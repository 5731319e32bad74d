#pragma once
/// Places of the panels of a figure in a picture, whatever draws them: rooms around them, ranges
/// and ticks of their axes.

#include <string>
#include <vector>

#include "libio/drawing/axis.hpp"
#include "libio/drawing/figure.hpp"
#include "libio/drawing/svg.hpp"

namespace whirl::inline io {

namespace figure_style {

constexpr double letters = 13.0, small_letters = 12.0, title_letters = 15.0;
/// Distances [pixels].
struct Rooms {
  bool is_tight;                    ///< of a picture of a given size
  double left;                      ///< room for tick labels and titles of axes
  double margin;                    ///< left of titles, legend, table and notes
  double row;                       ///< of legend, notes, table
  double sample;                    ///< length of a line in the legend
  double under;                     ///< below a panel
  double tick_label, axis_title;    ///< base lines below a panel
  double above;                     ///< a panel without a title
  double between;                   ///< panels that share x
  double title;                     ///< above a panel with one
  double name, leader;              ///< from a panel to names at the ends of lines
  double bar, bar_width, bar_room;  ///< of a scale of colors
  double per_label_x, per_label_y;  ///< room for the label of a tick
};
constexpr Rooms wide{false, 82.0, 82.0, 19.0, 30.0, 54.0, 21.0, 42.0, 8.0,
                     10.0,  26.0, 30.0, 22.0, 14.0, 14.0, 84.0, 62.0, 40.0};
/// Distances in a picture of a given size, whose other room goes to the panels.
constexpr Rooms tight{true, 46.0, 8.0,  15.0, 18.0, 38.0, 16.0, 32.0, 7.0,
                      8.0,  19.0, 16.0, 12.0, 8.0,  10.0, 64.0, 50.0, 25.0};

}  // namespace figure_style

/// A panel's place and axes.
struct PanelFrame {
  const Panel* panel = nullptr;
  const figure_style::Rooms* rooms = &figure_style::wide;
  double picture_width = 0.0;  ///< texts stay within
  Axis x, y;
  Pixel corner;  ///< upper left
  double width = 0.0, height = 0.0;
  bool is_lowest = true;         ///< x has numbers below the panel
  bool has_x_title = true;       ///< x is named below its numbers
  double x_title = 0.0;          ///< middle of the name of x
  bool has_title_above = false;  ///< y is named above: the panel is lower than its name is long
  double left = 0.0;             ///< room left of the panel

  double right() const { return corner.x + width; }
  double floor() const { return corner.y + height; }
  Pixel at(double vx, double vy) const {
    return {corner.x + width * x.place(vx), floor() - height * y.place(vy)};
  }
};

/// Places of the panels below a height, down to the figure's height.
std::vector<PanelFrame> frames_of(const Figure& figure, double top,
                                  const figure_style::Rooms& rooms = figure_style::wide);

/// The parts of a title, divided by " | ", that fit a width: the last ones are left out, then
/// words.
std::string fitting_title(const std::string& title, double width);

/// Whether a panel is one of a picture of a given size, where room is scarce.
bool is_tight(const PanelFrame& frame);
/// Whether a line of a panel is named at its end; if so, horizontal rules are named there, too.
bool has_end_names(const Panel& panel);

/// Ticks of x and of y, as many as have room.
std::vector<Tick> ticks_along(const PanelFrame& frame);
std::vector<Tick> ticks_up(const PanelFrame& frame);

}  // namespace whirl::inline io
