#pragma once
/// Writing of SVG pictures: shapes in pixels, y downward. What a picture shows is not known here.

#include <string>
#include <string_view>
#include <vector>

namespace whirl::inline io {

struct Pixel {
  double x = 0.0, y = 0.0;
};

struct Stroke {
  std::string color = "#000000";
  double width = 1.0;
  std::string dashes;  ///< lengths of dashes and gaps, "4 3"; empty: none
};

enum class Anchor { start, middle, end };

struct TextStyle {
  double size = 12.0;
  std::string color = "#000000";
  Anchor anchor = Anchor::start;
  double rotation = 0.0;  ///< around the place, clockwise [deg]
  bool is_bold = false;
  bool has_halo = false;  ///< white around the letters, to be read on lines
};

enum class Marker { circle, square, diamond, triangle, triangle_down, cross };
constexpr int markers = 6;

/// A picture that grows by shapes, each above those before.
class Svg {
 public:
  /// @param title  for screen readers and tabs of browsers
  Svg(double width, double height, std::string_view title);

  /// Prints the picture this large, such as "85mm" by "60mm", instead of with its pixels as those
  /// of a screen.
  void set_size(std::string width, std::string height);

  void rectangle(Pixel corner, double width, double height, std::string_view fill);
  void line(Pixel from, Pixel to, const Stroke& stroke);
  void polyline(const std::vector<Pixel>& points, const Stroke& stroke);
  /// An area of any outline, in the commands of SVG; crisp ones have no soft edges.
  void area(std::string_view outline, std::string_view fill, double opacity = 1.0,
            bool is_crisp = false);
  /// Round dots of one size; those that would hide each other are written once.
  void dots(const std::vector<Pixel>& centers, double size, std::string_view color);
  void marker(Marker shape, Pixel center, double size, std::string_view color);
  /// A line of text, the place on its base line; "10^{-6}" has an exponent.
  void text(Pixel place, std::string_view text, const TextStyle& style);
  /// Shapes until the end of a group belong together under a name, for editors and scripts.
  void begin_group(std::string_view name);
  void end_group();
  /// Of shapes until the end of the clip, only what is in a rectangle is seen.
  void begin_clip(Pixel corner, double width, double height);
  void end_clip() { end_group(); }

  /// The whole file.
  std::string document() const;

 private:
  std::string width_, height_, head_, body_;
  int clips_ = 0;
};

/// A coordinate to a hundredth of a pixel, without zeros that say nothing.
std::string coordinate(double value);

/// Width of a text in the usual fonts, roughly; exponents are smaller [pixels].
double text_width(std::string_view text, double size);

}  // namespace whirl::inline io
