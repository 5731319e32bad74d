// The dimension of sections, on sets whose dimension is known.

#include "libbase/numerics/fractal_dimension.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace whirl::fractal_dimension_test {

constexpr int count = 400;

// Sections of a motion with two incommensurate frequencies: a closed curve, bent through space.
TEST(SectionDimension, OfAClosedCurveIsOne) {
  Mat points(4, count);
  for (int i = 0; i < count; ++i) {
    const double a = 2.0 * std::numbers::pi * std::numbers::phi * i;
    points.col(i) << std::cos(a), std::sin(a), 0.3 * std::cos(2.0 * a), 0.2 * std::sin(3.0 * a);
  }
  EXPECT_NEAR(fractal_dimension(points), 1.0, 0.12);
}

// Three frequencies: a surface.
TEST(SectionDimension, OfASurfaceIsTwo) {
  Mat points(4, count);
  for (int i = 0; i < count; ++i) {
    const double a = 2.0 * std::numbers::pi * std::numbers::phi * i;
    const double b = 2.0 * std::numbers::pi * std::numbers::sqrt2 * i;
    points.col(i) << std::cos(a), std::sin(a), std::cos(b), std::sin(b);
  }
  EXPECT_NEAR(fractal_dimension(points), 2.0, 0.2);
}

// Arnold's cat map, a' = 2 a + b, b' = a + b (mod 1), is chaotic on all of a torus.
TEST(SectionDimension, OfChaosOnASurfaceIsTwo) {
  Mat points(4, count);
  double a = 0.1234, b = 0.4321;
  for (int i = 0; i < count; ++i) {
    const double sum = a + b;
    a = std::fmod(a + sum, 1.0);
    b = std::fmod(sum, 1.0);
    const double u = 2.0 * std::numbers::pi * a, v = 2.0 * std::numbers::pi * b;
    points.col(i) << std::cos(u), std::sin(u), std::cos(v), std::sin(v);
  }
  EXPECT_NEAR(fractal_dimension(points), 2.0, 0.2);
}

TEST(SectionDimension, OfPointsThatRepeatIsNone) {
  Mat points(2, count);
  for (int i = 0; i < count; ++i) points.col(i) << i % 4, (i % 4) * (i % 4);
  EXPECT_EQ(fractal_dimension(points), 0.0);
  EXPECT_EQ(fractal_dimension(Mat::Zero(2, count)), 0.0);
  EXPECT_TRUE(std::isnan(fractal_dimension(Mat::Random(2, 10))));
  // the 32 nearest are no neighborhood of less than three times as many
  EXPECT_TRUE(std::isnan(fractal_dimension(Mat::Random(2, 95))));
  EXPECT_FALSE(std::isnan(fractal_dimension(Mat::Random(2, 96))));
}

}  // namespace whirl::fractal_dimension_test
