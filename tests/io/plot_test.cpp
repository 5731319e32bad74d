// Plots: ticks and ranges of axes, labels kept apart, and pictures that hold what they are given.

#include "libio/plot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "libio/svg.hpp"

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
  EXPECT_EQ((Axis{Scale::logarithmic, 1e-12, 1e0}.ticks(5).size()), 13u);
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
TEST(Spread, KeepsPlacesApart) {
  using Places = std::vector<double>;
  EXPECT_EQ(spread({1.0, 9.0}, 3.0, 0.0, 20.0), (Places{1.0, 9.0}));
  EXPECT_EQ(spread({1.0, 2.0}, 3.0, -10.0, 20.0), (Places{0.0, 3.0}));
  const Places three = spread({1.0, 2.0, 4.0}, 3.0, -10.0, 20.0);
  EXPECT_NEAR(three[0], -2.0 / 3.0, 1e-15);
  EXPECT_NEAR(three[2], 16.0 / 3.0, 1e-15);
  EXPECT_EQ(spread({1.0, 2.0}, 3.0, 1.0, 20.0), (Places{1.0, 4.0}));
  EXPECT_EQ(spread({18.0, 19.0}, 3.0, 1.0, 20.0), (Places{17.0, 20.0}));
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

// Every line has its name, its own marker at each point that has a place, and lies in the picture.
TEST(LinePlot, DrawsEverySeriesWithItsName) {
  LinePlot plot;
  plot.title = "A & B";
  plot.x = {"error", Scale::logarithmic};
  plot.y = {"time [ns]", Scale::logarithmic};
  plot.series = {{"first", {1e-3, 1e-6, 0.0, NAN}, {10.0, 100.0, 1000.0, 5.0}},
                 {"second", {1e-3, 1e-5}, {11.0, 200.0}},
                 {"nowhere", {NAN}, {1.0}}};
  plot.marks = {{1e-8, "limit"}};
  const std::string svg = svg_of(plot);
  for (const char* text : {"A &amp; B", "error", "time [ns]", "first", "second", "limit"}) {
    EXPECT_NE(svg.find(">" + std::string(text) + "</text>"), std::string::npos) << text;
  }
  EXPECT_EQ(svg.find("nowhere"), std::string::npos);
  EXPECT_EQ(count(svg, "<circle "), 2);
  EXPECT_EQ(count(svg, "<polygon "), 2);
  EXPECT_EQ(count(svg, "<g "), count(svg, "</g>"));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  const std::regex place("<text x=\"([-0-9.]+)\" y=\"([-0-9.]+)\"");
  for (std::sregex_iterator it(svg.begin(), svg.end(), place), end; it != end; ++it) {
    EXPECT_GT(std::stod((*it)[1]), 0.0);
    EXPECT_LT(std::stod((*it)[1]), plot.width);
    EXPECT_GT(std::stod((*it)[2]), 0.0);
    EXPECT_LT(std::stod((*it)[2]), plot.height);
  }
}

TEST(LinePlot, OfNothingIsAnEmptyFrame) {
  const std::string svg = svg_of({.title = "empty"});
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

}  // namespace whirl::plot_test
