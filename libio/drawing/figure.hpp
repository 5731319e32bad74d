#pragma once
/// What a figure shows, whatever draws it: a file for a paper (figure_svg.hpp) or the page of a
/// report (figure_json.hpp). Numbers are in the units that the axes name.

#include <limits>
#include <string>
#include <vector>

#include "libio/drawing/axis.hpp"
#include "libio/drawing/svg.hpp"

namespace whirl::inline io {

/// What a color means; paint_colors says what it looks like on white and on dark pages.
enum class Paint {
  ink,
  gray,
  faint,
  forward,
  backward,
  mixed,
  up,
  down,
  alarm,
  shaft,
  disk,
  stator,
  bearing,
  seal,
  rest,
  period_1,
  period_2,
  period_3,
  period_4,
  period_5,
  period_6,
  period_7,
  period_8,
  longer,
  quasi_periodic,
  chaotic,
  hyperchaotic,
  not_settled,
  failed,
  series  ///< the first of ten that people with color-vision deficiency tell apart
};

/// The color of the line number i.
constexpr Paint series_paint(std::size_t i) {
  return static_cast<Paint>(static_cast<int>(Paint::series) + static_cast<int>(i % 10));
}

struct PaintColors {
  const char *name, *light, *light_text, *dark;  ///< text: dark enough to be read on white
};

/// @source series: [OkabeIto2008], without the yellow, too light for lines; then wine, olive, gray
const PaintColors& paint_colors(Paint paint);
int paint_count();

/// Continuous colors of numbers.
enum class ColorMap { sequential, diverging };  ///< white to dark; white at zero
struct Rgb {
  int r = 0, g = 0, b = 0;
};
/// Colors at equal distances, to interpolate between.
const std::vector<Rgb>& color_stops(ColorMap map);
/// @param place  0 to 1
Rgb color_at(ColorMap map, double place);

enum class Dash { solid, dashed, dotted, dash_dot };

constexpr double not_set = std::numeric_limits<double>::quiet_NaN();

struct FigureAxis {
  std::string title;  ///< what and in which unit: "speed [rpm]"
  Scale scale = Scale::linear;
  double first = not_set, last = not_set;  ///< what is seen first; not_set: all
  double step = not_set;                   ///< between ticks; not_set: round numbers
  std::string also_unit{};                 ///< numbers are also told in this unit, "X" for orders
  double also_factor = 1.0;
};

/// Points, joined by a line or not; points that have no place interrupt the line.
struct Curve {
  std::string name{};      ///< in the legend; curves of one name are one entry; empty: none
  std::string end_name{};  ///< at the end of the line
  Paint paint = Paint::ink;
  std::vector<double> x{}, y{};
  bool has_line = true;
  double width = 1.6;  ///< [pixels]
  Dash dash = Dash::solid;
  bool has_marker = false;
  Marker marker = Marker::circle;
  double size = 7.0;                   ///< of markers [pixels]; below 3 they are dots
  std::size_t marker_every = 1;        ///< points
  double fill = 0.0;                   ///< opacity of the area inside, 0 to 1
  std::vector<std::string> hover{};    ///< of points, told beside their numbers
  std::vector<double> along{};         ///< a number per point, such as its time
  std::string along_title{};           ///< "time [s]"; points of one time are shown together
  bool is_key = true;                  ///< counts for the range of the axes
  std::vector<std::string> details{};  ///< of points, told after a click; lines
  std::string command{};  ///< of a point, told after a click; {n} stands for its `along`
};

struct Category {
  std::string name;
  Paint paint = Paint::gray;
};

/// Numbers over a plane, as colored cells.
struct Cells {
  std::vector<double> x{}, y{};        ///< middles of the columns and rows, ascending
  std::vector<double> values{};        ///< of the row y[j], column x[i] at j * x.size() + i
  std::vector<Category> categories{};  ///< values are their numbers; empty: a scale of colors
  ColorMap map = ColorMap::sequential;
  double first = 0.0, last = 1.0;  ///< of the scale of colors
  std::string title{};             ///< of the values: "amplitude [um]"
  bool prints_values = false;
  std::vector<std::string> x_names{}, y_names{};  ///< instead of numbers along the axes
  /// Command line of a cell. Its places {x}, {y}, or negated {-x}, {-y}, stand for numbers in SI:
  /// those along the axes times x_factor and y_factor. "{{" is a brace that is no place, also in
  /// commands of curves.
  std::string command{};
  double x_factor = 1.0, y_factor = 1.0;

  bool empty() const { return values.empty(); }
};

/// A straight line across the panel, named at its end.
struct Rule {
  enum class Kind { vertical, horizontal, slope };  ///< slope: y = at * x
  Kind kind = Kind::vertical;
  double at = 0.0;
  std::string name{};
  Paint paint = Paint::gray;
  Dash dash = Dash::dashed;
};

struct Label {
  double x = 0.0, y = 0.0;
  std::string text;
  Anchor anchor = Anchor::start;
  double dx = 6.0, dy = -6.0;  ///< off the point [pixels]
  Paint paint = Paint::ink;
};

struct Panel {
  std::string title{};
  FigureAxis x{}, y{};
  bool has_equal_scales = false;  ///< a circle looks like one
  bool has_frame = true;
  double share = 1.0;  ///< of the height, relative to other rows
  std::vector<Curve> curves{};
  Cells cells{};
  std::vector<Rule> rules{};
  std::vector<Label> labels{};
  std::string cursor{};  ///< what x is, "time" or "frequency": cursors of one kind move together
};

/// Texts in rows, beside the figure.
struct FigureTable {
  std::vector<std::string> header{};
  std::vector<std::vector<std::string>> rows{};
};

/// What the page can add to a figure.
enum class Subject {
  numbers,
  rotor,  ///< a drawing of the rotor, its motion in space beside it; x and y are not told
  orbit   ///< the path of a station, in which a line of a spectrum is a circle
};

struct Figure {
  std::string kind{};                  ///< name in figures.hpp
  std::string heading{};               ///< title of its kind
  Subject subject = Subject::numbers;  ///< of its kind
  std::string variant{};               ///< of several of one kind: the station, the mode
  std::vector<std::string> probes{};   ///< names of those whose readings it shows
  std::string title{}, subtitle{};
  std::vector<Panel> panels{};
  int columns = 1;  ///< panels beside each other; those below each other share x if it is the same
  FigureTable table{};
  std::vector<std::string> notes{};
  double width = 720.0, height = 480.0;  ///< [pixels], of the panels and titles
};

/// What stands in the legend of a figure.
struct LegendEntry {
  const Curve* curve = nullptr;
  const Category* category = nullptr;  ///< of cells, where it is no curve
  const std::string& name() const { return curve ? curve->name : category->name; }
};
/// Each name once, in their order.
std::vector<LegendEntry> legend_of(const Figure& figure);

/// A range of numbers as an axis shows them.
///
///   unit_for(0.003, "m") = {"mm", 1e3}
struct DisplayUnit {
  std::string name;
  double factor = 1.0;  ///< of a number in SI
};
/// @param largest  magnitude to be shown [si_unit]
DisplayUnit unit_for(double largest, const std::string& si_unit);

/// The largest magnitude of finite numbers, 0 without any.
double largest_of(const std::vector<double>& values);

/// A text with minus signs, which are longer than hyphens.
std::string with_minus(std::string text);

/// Numbers times a factor.
std::vector<double> scaled(std::vector<double> values, double factor);

/// Axes that show all of a panel as the panel asks for, before its scales are made equal.
struct PanelAxes {
  Axis x, y;
};
PanelAxes axes_of(const Panel& panel);

/// Whether a point has a place on the scales of a panel.
bool has_place(const Panel& panel, double x, double y);

}  // namespace whirl::inline io
