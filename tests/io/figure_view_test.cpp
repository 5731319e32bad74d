// Figures as a person wants them: ranges, scales, names, panels and markers, whatever the kind.

#include "libio/drawing/figure_view.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "libbase/error.hpp"
#include "libio/drawing/figure_svg.hpp"

namespace whirl::figure_view_test {

/// Amplitude and phase over speed, and a force.
Figure bode() {
  Figure f{.title = "rotor", .height = 600.0};
  const std::vector<double> speed{0.0, 1000.0, 2000.0, 3000.0};
  for (const char* title : {"amplitude p-p [µm]", "phase [deg]", "force [N]"}) {
    Panel p;
    p.x.title = "speed [rpm]";
    p.y.title = title;
    Curve c{.name = "3 disk", .end_name = "end", .x = speed};
    c.y = {0.0, 10.0, 40.0, 20.0};
    if (p.y.title == "phase [deg]") c.y = {0.0, -20.0, -90.0, -160.0};
    c.has_marker = true;
    p.curves = {c};
    p.curves.push_back(c);
    p.curves.back().name = "5 ring";
    p.rules.push_back({Rule::Kind::vertical, 2500.0, "operating speed"});
    f.panels.push_back(p);
  }
  f.panels.front().rules.push_back({Rule::Kind::horizontal, 0.0});
  return f;
}

Figure changed(const FigureView& view) {
  Figure f = bode();
  change_view(f, view);
  return f;
}

/// What is wrong with a view; empty: nothing.
std::string problem(const FigureView& view) {
  try {
    changed(view);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

using Range = std::pair<double, double>;
Range range(const FigureAxis& axis) {
  return {axis.first, axis.last};
}

TEST(FigureView, RangesAreOfTheAxesThatMeasureThem) {
  Figure f = changed({.x_range = "500:2500"});
  for (const Panel& p : f.panels) EXPECT_EQ(range(p.x), Range(500.0, 2500.0));
  f = changed({.x_range = "10:50Hz"});  // 60 rpm are 1 Hz
  EXPECT_NEAR(f.panels[2].x.first, 600.0, 1e-9);
  EXPECT_NEAR(f.panels[2].x.last, 3000.0, 1e-9);
  f = changed({.y_range = "0:0.03mm"});
  EXPECT_NEAR(f.panels[0].y.last, 30.0, 1e-12);
  EXPECT_TRUE(std::isnan(f.panels[1].y.last));
  f = changed({.y_range = "-180:0deg"});
  EXPECT_TRUE(std::isnan(f.panels[0].y.last));
  EXPECT_NEAR(f.panels[1].y.first, -180.0, 1e-12);
  f = changed({.y_range = "0:30,,0:25"});
  EXPECT_EQ(range(f.panels[0].y), Range(0.0, 30.0));
  EXPECT_TRUE(std::isnan(f.panels[1].y.first));
  EXPECT_EQ(range(f.panels[2].y), Range(0.0, 25.0));
  f = changed({.x_range = "1500:", .y_range = ":30"});  // open ends are where they would be
  EXPECT_EQ(range(f.panels[0].x), Range(1500.0, 3000.0));
  EXPECT_EQ(range(f.panels[0].y), Range(0.0, 30.0));
}

TEST(FigureView, WrongRangesSayWhatWouldBeRight) {
  EXPECT_EQ(problem({.x_range = "0:5mm"}), "--xlim 0:5mm: no axis is in mm; x is speed [rpm]");
  EXPECT_EQ(problem({.y_range = "1:2s"}),
            "--ylim 1:2s: no axis is in s; y is amplitude p-p [µm] | phase [deg] | force [N]");
  EXPECT_EQ(problem({.x_range = "9000:12000"}),
            "--xlim 9000:12000: there is nothing; of speed [rpm] all is 0:3000");
  EXPECT_EQ(problem({.x_range = "2000:1000"}),
            "--xlim 2000:1000: expected A below B; of speed [rpm] all is 0:3000");
  for (const char* text : {"5", ":", "1:2:3", ""}) {
    const std::string wrong = problem({.x_range = text});
    EXPECT_EQ(wrong, *text ? std::string("--xlim ") + text +
                                 ": expected a range A:B, A: or :B, such as 0:10"
                           : "");
  }
  EXPECT_NE(problem({.x_range = "a:b"}).find("expected a range A:B"), std::string::npos);
  EXPECT_NE(problem({.x_range = "1mm:2"}).find("the unit stands at the end"), std::string::npos);
  EXPECT_EQ(problem({.y_range = "0:1,0:1,0:1,0:1"}),
            "--ylim 0:1,0:1,0:1,0:1: 4 ranges for 3 panels");
}

TEST(FigureView, LogarithmicAxesHaveNoPlaceForZeroAndLess) {
  Figure f = bode();
  const std::vector<std::string> notes = change_view(f, {.log = "y"});
  EXPECT_EQ(notes, std::vector<std::string>{"2 points at 0 have no place on the logarithmic axis "
                                            "of amplitude p-p [µm]"});
  EXPECT_EQ(f.panels[0].y.scale, Scale::logarithmic);
  EXPECT_EQ(f.panels[1].y.scale, Scale::linear);
  EXPECT_EQ(f.panels[0].rules.size(), 1u);  // the rule at 0 is gone
  EXPECT_EQ(svg_of(f).find("inf"), std::string::npos);
  f = changed({.panels = "phase", .log = "x"});
  EXPECT_EQ(f.panels[0].x.scale, Scale::logarithmic);
  EXPECT_EQ(problem({.panels = "phase", .log = "y"}),
            "--log y: phase [deg] goes down to -160, and a logarithmic axis shows only what is "
            "above 0; with --ylim A:B, A above 0, it shows that part");
  EXPECT_EQ(problem({.y_range = "-5:20", .log = "y"}),
            "--ylim -5:20: amplitude p-p [µm] is logarithmic and begins above 0; all is 1:100");
  EXPECT_EQ(problem({.log = "z"}), "--log z: expected x, y or xy, or none for linear axes");
  Figure orbit = bode();
  orbit.panels.front().has_equal_scales = true;
  EXPECT_THROW(change_view(orbit, {.log = "x"}), ModelError);
  f = changed({.log = "xy"});
  change_view(f, {.log = "none"});
  EXPECT_EQ(f.panels[0].y.scale, Scale::linear);
}

// y = x on a logarithmic x is a curve; it stays a straight line where both are alike.
TEST(FigureView, LinesOfOneSlopeStayRight) {
  const Rule slope{Rule::Kind::slope, 0.01, "1X"};
  Figure f = bode();
  f.panels.resize(1);
  f.panels[0].rules = {slope};
  change_view(f, {.x_range = "10:", .log = "x"});
  EXPECT_TRUE(f.panels[0].rules.empty());
  const Curve& c = f.panels[0].curves.back();
  EXPECT_EQ(c.end_name, "1X");
  for (std::size_t i = 0; i < c.x.size(); ++i) EXPECT_DOUBLE_EQ(c.y[i], 0.01 * c.x[i]);
  f.panels[0].rules = {slope};
  change_view(f, {.y_range = "0.1:", .log = "xy"});
  EXPECT_EQ(f.panels[0].rules.size(), 1u);
}

TEST(FigureView, PanelsAreKeptByNumberAndName) {
  EXPECT_EQ(changed({.panels = "3,1"}).panels[0].y.title, "force [N]");
  Figure f = changed({.panels = "phase"});
  ASSERT_EQ(f.panels.size(), 1u);
  EXPECT_EQ(f.panels[0].y.title, "phase [deg]");
  EXPECT_LT(f.height, 400.0);
  EXPECT_EQ(problem({.panels = "4"}),
            "--panels 4: the figure has 1 amplitude p-p [µm] | 2 phase [deg] | 3 force [N]");
  EXPECT_NE(problem({.panels = "moon"}), "");
}

TEST(FigureView, NamesAreOnesOwn) {
  Figure f = changed({.x_label = "Ω [rpm]",
                      .y_label = "2|r| [µm]; ; F",
                      .labels = "drive end; end=E; free end; operating speed=n",
                      .title = "Thesis"});
  EXPECT_EQ(f.title, "Thesis");
  EXPECT_EQ(f.panels[2].x.title, "Ω [rpm]");
  EXPECT_EQ(f.panels[0].y.title, "2|r| [µm]");
  EXPECT_EQ(f.panels[1].y.title, "phase [deg]");
  EXPECT_EQ(f.panels[2].y.title, "F");
  EXPECT_EQ(f.panels[0].curves[0].name, "drive end");
  EXPECT_EQ(f.panels[0].curves[1].name, "free end");
  EXPECT_EQ(f.panels[1].curves[1].end_name, "E");
  EXPECT_EQ(f.panels[1].rules[0].name, "n");
  f = changed({.labels = "5 ring; 3 disk"});  // they change places
  EXPECT_EQ(f.panels[0].curves[0].name, "5 ring");
  EXPECT_EQ(f.panels[0].curves[1].name, "3 disk");
  EXPECT_EQ(problem({.labels = "a; b; c"}),
            "--labels a; b; c: expected names for 3 disk | 5 ring, or OLD=NEW");
}

TEST(FigureView, MarkersHaveOnesOwnShapeAndSize) {
  Figure f = changed({.marker = "s", .marker_size = 4.0});
  EXPECT_EQ(f.panels[0].curves[0].marker, Marker::square);
  EXPECT_EQ(f.panels[2].curves[1].size, 4.0);
  EXPECT_EQ(problem({.marker = "heart"}),
            "--marker heart: expected circle, square, diamond, triangle, triangle_down or cross");
}

// A rule beside the range is not drawn over what stands there.
TEST(FigureView, WhatIsBesideTheRangeIsNotDrawn) {
  const std::string all = svg_of(changed({}));
  const std::string part = svg_of(changed({.x_range = "0:2000"}));
  EXPECT_NE(all.find(">operating speed<"), std::string::npos);
  EXPECT_EQ(part.find(">operating speed<"), std::string::npos);
}

}  // namespace whirl::figure_view_test
