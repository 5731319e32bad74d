// Values between places: lines, and the monotone cubics that SciPy calls PchipInterpolator.

#include "libbase/numerics/interpolation.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace whirl::interpolation_test {

constexpr double rounding = 1e-14;  // of numbers of the size of one

struct Case {
  std::vector<double> x, y, at, expected;
};

// Numbers of scipy.interpolate.PchipInterpolator, SciPy 1.10.1: rows that rise, fall and stay, ends
// that are limited and that are not, two rows.
TEST(Interpolation, PchipIsThatOfScipy) {
  const Case cases[] = {
      {{0, 1, 1.5, 4, 5, 7},
       {1, 3, 3.5, -2, -2, 6},
       {0, 0.3, 1, 1.2, 2, 3.9, 4.4, 5, 5.1, 6.5},
       {1.0, 1.7429999999999999, 3.0, 3.2685714285714287, 2.928, -1.9743040000000018, -2.0, -2.0,
        -1.973666666666667, 2.875}},
      {{10, 20, 50},
       {4, 1, 2},
       {12, 19, 20.5, 49},
       {3.1973333333333334, 1.0495000000000003, 1.0000046296296297, 1.9032962962962963}},
      {{1, 3}, {4, 1}, {1.5, 2.9}, {3.25, 1.1500000000000004}},
      {{0, 1, 2}, {0, 5, 4.9}, {0.25, 0.5, 1.5}, {1.84296875, 3.44375, 4.9875}},
      {{0, 1, 1.1},
       {0, 0.1, 5},
       {0.25, 0.5, 1.05},
       {0.0027802491103202853, 0.015747330960854095, 1.8853570850857326}}};
  for (const Case& c : cases) {
    for (std::size_t i = 0; i < c.at.size(); ++i) {
      EXPECT_NEAR(interpolated(c.x, c.y, c.at[i], Interpolation::pchip), c.expected[i], rounding)
          << c.at[i];
    }
  }
}

TEST(Interpolation, BothStayBeyondTheEndsAndMeetTheirPlaces) {
  const std::vector<double> x{-1.0, 0.5, 2.0, 2.5}, y{3.0, -1.0, 4.0, 4.5};
  for (const auto how : {Interpolation::linear, Interpolation::pchip}) {
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_EQ(interpolated(x, y, x[i], how), y[i]);
    EXPECT_EQ(interpolated(x, y, -9.0, how), 3.0);
    EXPECT_EQ(interpolated(x, y, 9.0, how), 4.5);
    EXPECT_EQ(interpolated({x.data(), 1}, {y.data(), 1}, 0.0, how), 3.0);
  }
}

// f = (1 - s) y1 + s y2
TEST(Interpolation, LinearIsALine) {
  const std::vector<double> x{0.0, 2.0, 3.0}, y{1.0, 5.0, -3.0};
  EXPECT_DOUBLE_EQ(interpolated(x, y, 0.5, Interpolation::linear), 2.0);
  EXPECT_DOUBLE_EQ(interpolated(x, y, 2.75, Interpolation::linear), -1.0);
}

// What is near a place is enough: a table of millions takes no longer than one of four.
TEST(Interpolation, PchipNeedsTheNeighborsAlone) {
  const std::vector<double> x{0, 1, 3, 4, 6, 9, 10}, y{0, 2, 3, 7, 1, 0, 5};
  for (double at = 0.1; at < 10.0; at += 0.3) {
    const Neighborhood n = neighborhood(x, at, Interpolation::pchip);
    EXPECT_LE(n.count, 4u);
    const std::span near_x = std::span(x).subspan(n.first, n.count);
    const std::span near_y = std::span(y).subspan(n.first, n.count);
    EXPECT_EQ(interpolated(near_x, near_y, at, Interpolation::pchip),
              interpolated(x, y, at, Interpolation::pchip));
  }
}

}  // namespace whirl::interpolation_test
