// Plots: ticks and ranges of axes, labels kept apart, and pictures that hold what they are given.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "libio/drawing/figure_json.hpp"
#include "libio/drawing/figure_svg.hpp"
#include "libio/drawing/svg.hpp"
#include "libio/figures/common.hpp"
#include "libio/text/xml.hpp"

namespace whirl::plot_test {

std::vector<std::string> labels(const Axis& axis, int most) {
  std::vector<std::string> all;
  for (const Tick& t : axis.ticks(most)) {
    if (!t.label.empty()) all.push_back(t.label);
  }
  return all;
}

using Labels = std::vector<std::string>;

TEST(Axis, PlacesNumbers) {
  const Axis linear{Scale::linear, -1.0, 3.0};
  EXPECT_EQ(linear.place(-1.0), 0.0);
  EXPECT_EQ(linear.place(0.0), 0.25);
  EXPECT_EQ(linear.place(3.0), 1.0);
  const Axis log{Scale::logarithmic, 1e-8, 1e-4};
  EXPECT_NEAR(log.place(1e-7), 0.25, 1e-15);
  EXPECT_EQ(log.place(1e-4), 1.0);
}

TEST(Axis, HasTicksAtRoundNumbers) {
  EXPECT_EQ(labels({Scale::linear, 0.0, 1.0}, 5), (Labels{"0", "0.2", "0.4", "0.6", "0.8", "1"}));
  EXPECT_EQ(labels({Scale::linear, -25.0, 60.0}, 5), (Labels{"−20", "0", "20", "40", "60"}));
  EXPECT_EQ(labels({Scale::linear, 0.0, 8000.0}, 4), (Labels{"0", "2000", "4000", "6000", "8000"}));
}

TEST(Axis, HasLogarithmicTicksAtPowersOfTen) {
  const Axis axis{Scale::logarithmic, 5e-4, 2e1};
  EXPECT_EQ(labels(axis, 8), (Labels{"10^{−3}", "10^{−2}", "10^{−1}", "10^{0}", "10^{1}"}));
  EXPECT_EQ(axis.ticks(8).size(), 5u + 5u + 4u * 8u + 1u);  // 5e-4 to 9e-4, ..., 2e1
  // where there is no room, only every second or third power is labelled, and nothing in between
  EXPECT_EQ(labels({Scale::logarithmic, 1e-12, 1e0}, 5),
            (Labels{"10^{−12}", "10^{−9}", "10^{−6}", "10^{−3}", "10^{0}"}));
  // a range that rounding cannot tell from a point ends, and has none
  for (const double width : {0.0, 1e-14, 1e-300}) {
    EXPECT_TRUE((Axis{Scale::linear, 300.0, 300.0 + width}.ticks(5).empty())) << width;
  }
  EXPECT_EQ((Axis{Scale::logarithmic, 1e-12, 1e0}.ticks(5).size()), 13u);
  // in a tiny picture there are two powers, as far as it reaches
  EXPECT_EQ(labels({Scale::logarithmic, 2e-12, 1.0}, 2), (Labels{"10^{−11}", "10^{−5}"}));
  // within one power round numbers take their place, but for 0, which has none
  EXPECT_EQ(labels({Scale::logarithmic, 2e-1, 2.0}, 2), (Labels{"1", "2"}));
}

TEST(Axis, GoesAroundItsNumbers) {
  const auto range = [](const std::vector<double>& values, Scale scale) {
    const Axis a = axis_around(values, scale);
    return std::pair(a.first, a.last);
  };
  EXPECT_EQ(range({0.3, 7.7, NAN}, Scale::linear), std::pair(0.0, 8.0));
  EXPECT_EQ(range({-0.1, 0.1}, Scale::linear), std::pair(-0.1, 0.1));
  EXPECT_EQ(range({4.0}, Scale::linear), std::pair(2.0, 6.0));
  EXPECT_EQ(range({}, Scale::linear), std::pair(0.0, 1.0));
  const auto log = range({3e-9, 0.0, -1.0, 4e-2}, Scale::logarithmic);
  EXPECT_NEAR(log.first, 2e-9, 1e-20);
  EXPECT_NEAR(log.second, 5e-2, 1e-12);
  // two powers of ten at least
  const auto narrow = range({3e3, 4e3}, Scale::logarithmic);
  EXPECT_NEAR(narrow.first, 1e3, 1e-9);
  EXPECT_NEAR(narrow.second, 1e4, 1e-9);
  EXPECT_EQ(range({NAN}, Scale::logarithmic), std::pair(1.0, 10.0));
}

// Least squares by hand: 1 and 2 at a distance of 3 go to 0 and 3; a third one at 4 pushes the
// group: starts s, s + 3, s + 6 with s = (1 + 2 + 4 - 9) / 3.
// XML 1.0 has no way to write U+FFFE, U+FFFF, controls, surrogates and bytes that are no UTF-8
// [2.2]: a viewer refuses the whole picture.
TEST(Svg, TextsHoldOnlyWhatXmlCanHold) {
  EXPECT_EQ(xml_text("a\xef\xbf\xbe"
                     "b\xef\xbf\xbf"
                     "c\x01"
                     "d"),
            "abcd");
  EXPECT_EQ(xml_text("\xff\xc3(\xed\xa0\x80\xc0\xafz\xc3"), "(z");
  EXPECT_EQ(xml_text("Läufer · µ 𝛺 <&>\""), "Läufer · µ 𝛺 &lt;&amp;&gt;&quot;");
}

// Ticks of numbers that differ by rounding only, or by more than there are numbers, never end or
// overflow.
TEST(Axis, OfExtremeNumbersEnds) {
  for (const std::vector<double>& values :
       std::vector<std::vector<double>>{{1e15, 1e15 + 0.125},
                                        {-1e308, 1e308},
                                        {1e-320, 1e-310},
                                        {1.0, std::nextafter(1.0, 2.0)}}) {
    for (const Scale scale : {Scale::linear, Scale::logarithmic}) {
      const Axis axis = axis_around(values, scale);
      EXPECT_TRUE(can_be_drawn(axis));
      EXPECT_LT(axis.ticks(8).size(), 2000u);
    }
  }
}

TEST(Spread, KeepsPlacesApart) {
  using Places = std::vector<double>;
  EXPECT_EQ(spread({1.0, 9.0}, 3.0, 0.0, 20.0), (Places{1.0, 9.0}));
  EXPECT_EQ(spread({1.0, 2.0}, 3.0, -10.0, 20.0), (Places{0.0, 3.0}));
  const Places three = spread({1.0, 2.0, 4.0}, 3.0, -10.0, 20.0);
  EXPECT_NEAR(three[0], -2.0 / 3.0, 1e-15);
  EXPECT_NEAR(three[2], 16.0 / 3.0, 1e-15);
  EXPECT_EQ(spread({1.0, 2.0}, 3.0, 1.0, 20.0), (Places{1.0, 4.0}));
  EXPECT_EQ(spread({18.0, 19.0}, 3.0, 1.0, 20.0), (Places{17.0, 20.0}));
  EXPECT_EQ(spread({19.0, 19.5}, 3.0, 1.0, 20.0), (Places{17.0, 20.0}));  // pushed from the top
  EXPECT_EQ(spread({}, 3.0, 0.0, 1.0), Places{});
}

TEST(Svg, EscapesTextAndRaisesExponents) {
  Svg svg(100.0, 50.0, "a < b & \"c\"");
  svg.text({10.0, 20.0}, "10^{−6} m", {.size = 10.0});
  const std::string text = svg.document();
  EXPECT_NE(text.find("<title>a &lt; b &amp; &quot;c&quot;</title>"), std::string::npos);
  EXPECT_NE(text.find(">10<tspan dy=\"-4.5\" font-size=\"7\">−6</tspan><tspan dy=\"4.5\"> m</tspan>"
                      "</text>"),
            std::string::npos)
      << text;
}

TEST(Svg, WritesShortNumbers) {
  Svg svg(100.0, 50.0, "");
  svg.line({1.0 / 3.0, -0.001}, {100.0, 2.5}, {"#123456", 2.0, "4 3"});
  EXPECT_NE(
      svg.document().find("<line x1=\"0.33\" y1=\"0\" x2=\"100\" y2=\"2.5\" stroke=\"#123456\" "
                          "stroke-width=\"2\" stroke-dasharray=\"4 3\"/>"),
      std::string::npos)
      << svg.document();
}

/// Count of a pattern in a text.
long count(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  return std::distance(std::sregex_iterator(text.begin(), text.end(), expression), {});
}

/// A panel with two lines, on logarithmic axes.
Panel two_lines() {
  Panel p;
  p.x = {.title = "error", .scale = Scale::logarithmic};
  p.y = {.title = "time [ns]", .scale = Scale::logarithmic};
  Curve first{.end_name = "first", .paint = Paint::series};
  first.has_marker = true;
  first.x = {1e-3, 1e-6, 0.0, NAN};
  first.y = {10.0, 100.0, 1000.0, 5.0};
  Curve second{.end_name = "second", .paint = series_paint(1)};
  second.has_marker = true;
  second.marker = Marker::square;
  second.x = {1e-3, 1e-5};
  second.y = {11.0, 200.0};
  Curve nowhere{.end_name = "nowhere"};
  nowhere.x = {NAN};
  nowhere.y = {1.0};
  p.curves = {first, second, nowhere};
  p.rules = {{Rule::Kind::vertical, 1e-8, "limit"}};
  return p;
}

void expect_texts_inside(const std::string& svg, const Figure& figure) {
  const std::regex place("<text x=\"([-0-9.]+)\" y=\"([-0-9.]+)\"");
  for (std::sregex_iterator it(svg.begin(), svg.end(), place), end; it != end; ++it) {
    EXPECT_GT(std::stod((*it)[1]), 0.0);
    EXPECT_LT(std::stod((*it)[1]), figure.width);
    EXPECT_GT(std::stod((*it)[2]), 0.0);
  }
}

// Every line has its name, its own marker at each point that has a place, and lies in the picture.
TEST(FigureSvg, DrawsEveryCurveWithItsName) {
  const Figure figure{.title = "A & B", .panels = {two_lines()}};
  const std::string svg = svg_of(figure);
  for (const char* text : {"A &amp; B", "error", "time [ns]", "first", "second", "limit"}) {
    EXPECT_NE(svg.find(">" + std::string(text) + "</text>"), std::string::npos) << text;
  }
  EXPECT_EQ(svg.find(">nowhere<"), std::string::npos);
  EXPECT_EQ(count(svg, "<circle "), 2);
  EXPECT_EQ(count(svg, "<polygon "), 2);
  EXPECT_EQ(count(svg, "<g "), count(svg, "</g>"));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  expect_texts_inside(svg, figure);
}

// A horizontal rule that ends where a line does has its name a line's height from that of the line.
TEST(FigureSvg, KeepsNamesOfRulesFromThoseOfLines) {
  Panel p;
  p.x = {.title = "x", .first = 0.0, .last = 1.0};
  p.y = {.title = "y", .first = 0.0, .last = 1.0};
  Curve line{.end_name = "1F"};
  line.x = {0.0, 1.0};
  line.y = {0.5, 0.5};
  p.curves = {line};
  p.rules = {{Rule::Kind::horizontal, 0.505, "operating"}};
  const Figure figure{.panels = {p}};
  const std::string svg = svg_of(figure);
  const auto height_of = [&](const std::string& name) {
    std::smatch found;
    const std::regex text("<text x=\"[-0-9.]+\" y=\"([-0-9.]+)\"[^>]*>" + name + "</text>");
    return std::regex_search(svg, found, text) ? std::stod(found[1]) : NAN;
  };
  EXPECT_GE(std::abs(height_of("1F") - height_of("operating")), 13.0) << svg;
  expect_texts_inside(svg, figure);
}

TEST(FigureSvg, OfNothingIsAnEmptyFrame) {
  const std::string svg = svg_of({.title = "empty", .panels = {Panel{}}});
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

// A circle of radius 1 is as wide as high on the paper, whatever the shape of the panel.
TEST(FigureSvg, EqualScalesKeepCirclesRound) {
  Curve c{.name = "circle"};
  for (int i = 0; i <= 64; ++i) {
    c.x.push_back(std::cos(i * 0.0981747704246810387));
    c.y.push_back(std::sin(i * 0.0981747704246810387));
  }
  Panel p;
  p.has_equal_scales = true;
  p.curves = {c};
  const std::string svg = svg_of({.panels = {p}, .width = 900.0, .height = 300.0});
  const auto from = svg.find("<polyline points=\"") + 18;
  std::istringstream list(svg.substr(from, svg.find('"', from) - from));
  double low_x = 1e9, high_x = -1e9, low_y = 1e9, high_y = -1e9, x = 0.0, y = 0.0;
  for (char comma = 0; list >> x >> comma >> y;) {
    low_x = std::min(low_x, x), high_x = std::max(high_x, x);
    low_y = std::min(low_y, y), high_y = std::max(high_y, y);
  }
  EXPECT_GT(high_x - low_x, 100.0);
  EXPECT_NEAR(high_x - low_x, high_y - low_y, 0.05);  // places are written to 0.01 pixels
}

// Panels below each other with the same x axis show its numbers once.
TEST(FigureSvg, StackedPanelsShareTheirAxis) {
  const Figure one{.panels = {two_lines()}}, two{.panels = {two_lines(), two_lines()}};
  EXPECT_EQ(count(svg_of(one), ">error</text>"), 1);
  EXPECT_EQ(count(svg_of(two), ">error</text>"), 1);
  EXPECT_EQ(count(svg_of(two), ">time \\[ns\\]</text>"), 2);
}

// Neighbors of one color are one shape, so that a large map is a small file; NaN is left open.
TEST(FigureSvg, JoinsCellsOfOneColor) {
  Panel p;
  p.cells.x = {1.0, 2.0, 3.0, 4.0};
  p.cells.y = {1.0, 2.0};
  p.cells.values = {0.0, 0.0, 1.0, 1.0, 0.0, NAN, 0.0, 0.0};
  p.cells.categories = {{"calm", Paint::rest}, {"wild", Paint::chaotic}};
  const std::string svg = svg_of({.panels = {p}});
  EXPECT_EQ(count(svg, "shape-rendering"), 2);  // one path a color
  const auto from = svg.find("<path d=\"", svg.find("clip-path")) + 9;
  const std::string paths = svg.substr(from, svg.find("</g>", from) - from);
  EXPECT_EQ(count(paths, "M[0-9]"), 2 + 1 + 1);  // calm, wild | calm, (open), calm
  EXPECT_NE(svg.find(">calm</text>"), std::string::npos);
  EXPECT_NE(svg.find(">wild</text>"), std::string::npos);
}

// Cells fill their panel to the outer edges; rules across it do not widen or hide it.
TEST(FigureAxes, GoAroundCells) {
  Panel p;
  p.cells.x = {1.0, 2.0, 3.0};
  p.cells.y = {10.0, 30.0};
  p.cells.values.assign(6, 0.5);
  p.rules = {{Rule::Kind::vertical, 7.0, ""}};
  const PanelAxes axes = axes_of(p);
  EXPECT_EQ(std::pair(axes.x.first, axes.x.last), std::pair(0.5, 3.5));
  EXPECT_EQ(std::pair(axes.y.first, axes.y.last), std::pair(0.0, 40.0));
}

// Cells whose middles all lie in one place have no edges to go to: ticks of an axis of no width
// never end.
TEST(FigureAxes, OfCellsInOnePlaceCanBeDrawn) {
  Panel p;
  p.cells.x = {-0.05, -0.05, -0.05};
  p.cells.y = {3.0, 2.0};
  p.cells.values.assign(6, 0.5);
  const PanelAxes axes = axes_of(p);
  EXPECT_TRUE(can_be_drawn(axes.x));
  EXPECT_TRUE(can_be_drawn(axes.y));
}

TEST(FigureSvg, WritesDotsThatHideEachOtherOnce) {
  Curve c{.has_line = false};
  c.has_marker = true;
  c.size = 1.5;
  for (int i = 0; i < 20000; ++i) {
    c.x.push_back(i % 100);
    c.y.push_back(0.25 * (i % 100));
  }
  Panel p;
  p.curves = {c};
  EXPECT_EQ(count(svg_of({.panels = {p}}), "h0"), 100);
}

TEST(Units, OfFiguresHavePrefixesThatFit) {
  const auto name = [](double v, const char* unit) { return unit_for(v, unit).name; };
  EXPECT_EQ(name(0.003, "m"), "mm");
  EXPECT_EQ(name(3e-6, "m"), "µm");
  EXPECT_EQ(name(2.0, "m"), "m");
  EXPECT_EQ(name(2e6, "N/m"), "MN/m");
  EXPECT_EQ(name(0.0, "N"), "N");
  EXPECT_EQ(name(400.0, "rad/s"), "rpm");
  EXPECT_NEAR(unit_for(1.0, "rad/s").factor, 9.549296585513721, 1e-12);
  EXPECT_EQ(unit_for(0.003, "m").factor, 1e3);
  EXPECT_EQ(name(0.5, ""), "");
}

// What the page reads back is what the figure holds; equal arrays are stored once.
TEST(FigureJson, HoldsNumbersOfTheFigure) {
  ArrayStore arrays;
  Figure figure{.kind = "test", .title = "t", .panels = {two_lines(), two_lines()}};
  const auto json = nlohmann::json::parse(record_of(figure, arrays).json());
  const auto stored = nlohmann::json::parse(arrays.record().json());
  EXPECT_EQ(json["kind"], "test");
  ASSERT_EQ(json["panels"].size(), 2u);
  const auto& curve = json["panels"][0]["curves"][1];
  EXPECT_EQ(curve["marker"], "square");
  EXPECT_EQ(curve["paint"], "series_2");
  EXPECT_EQ(curve["x"], json["panels"][1]["curves"][1]["x"]);
  EXPECT_EQ(stored.size(), 6u);
  const double numbers[] = {1e-3, 1e-5};
  EXPECT_EQ(stored[curve["x"].get<std::size_t>()], "f64:" + base64(numbers, sizeof numbers));
  EXPECT_TRUE(json["panels"][0]["x"]["log"]);
}

// RFC 4648, section 10.
TEST(FigureJson, WritesBase64) {
  EXPECT_EQ(base64("", 0), "");
  EXPECT_EQ(base64("f", 1), "Zg==");
  EXPECT_EQ(base64("fo", 2), "Zm8=");
  EXPECT_EQ(base64("foo", 3), "Zm9v");
  EXPECT_EQ(base64("foobar", 6), "Zm9vYmFy");
}

// Colors can be told apart, on both backgrounds, and have names of their own.
TEST(Paints, AreNamedOnce) {
  std::vector<std::string> names;
  for (int i = 0; i < paint_count(); ++i) {
    const PaintColors& p = paint_colors(static_cast<Paint>(i));
    for (const char* color : {p.light, p.light_text, p.dark}) {
      EXPECT_TRUE(std::regex_match(color, std::regex("#[0-9a-f]{6}"))) << p.name;
    }
    EXPECT_EQ(std::count(names.begin(), names.end(), p.name), 0) << p.name;
    names.emplace_back(p.name);
  }
  EXPECT_EQ(std::string(paint_colors(series_paint(0)).name), "series_1");
  EXPECT_EQ(std::string(paint_colors(series_paint(9)).name), names.back());
}

// A path with a minus has the negative of the value, whatever its sign.
TEST(SetCommand, NegatesValues) {
  using figures::set_command;
  EXPECT_EQ(set_command("a.xy,-a.yx", "2", "N"), " --set a.xy=2N --set a.yx=-2N");
  EXPECT_EQ(set_command("a.xy,-a.yx", "-2", "N"), " --set a.xy=-2N --set a.yx=2N");
  EXPECT_EQ(set_command("-a.yx", "{x}", ""), " --set a.yx={-x}");
}

}  // namespace whirl::plot_test
