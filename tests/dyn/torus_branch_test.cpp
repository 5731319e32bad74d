// Circles along a parameter, both ways, stopped and gone on with.

#include "libdyn/studies/torus_branch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/flows.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::torus_branch_test {

constexpr double turn = 2.0 * std::numbers::pi;
constexpr double angle = test::circle_angle, twist = test::circle_twist;

Flow normal_form(double a) {
  return test::map_flow(2, [a](const Vec& y, Vec& f, Mat& J) { test::turn_circle(a, y, f, J); });
}

constexpr double first = 0.1;
const Vec scale = Vec::Ones(2);

TorusOptions options() {
  return {.circle = {.harmonics = 6, .most_harmonics = 6},
          .along = ParameterRange{
              .low = 0.05, .high = 0.2, .first = first, .largest_step = 0.01, .goes_both = true}};
}

/// The circle at the first value, whose points are known.
TorusBranch begun() {
  InvariantCircle circle{.points = Mat(2, 13), .rotation = (angle + twist * first) / turn};
  for (int j = 0; j < 13; ++j) {
    const double theta = turn * j / 13.0;
    circle.points.col(j) = std::sqrt(first) * Vec{{std::cos(theta), std::sin(theta)}};
  }
  return {.circle = find_circle(normal_form(first), circle, options().circle)};
}

TEST(TorusBranch, IsThatOfTheNormalFormBothWays) {
  const TorusBranch torus = follow_torus(normal_form, scale, begun(), options(), {});
  EXPECT_TRUE(torus.is_complete);
  ASSERT_EQ(torus.walks.size(), 2u);
  const std::vector<CirclePoint> points = torus.points();
  EXPECT_EQ(points.front().value, 0.05);
  EXPECT_EQ(points.back().value, 0.2);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const CirclePoint& p = points[i];
    if (i > 0) {
      EXPECT_GT(p.value, points[i - 1].value);  // the first value once
    }
    EXPECT_NEAR(p.rotation, (angle + twist * p.value) / turn, 1e-9);
    EXPECT_NEAR(p.growth, std::log(1.0 - 2.0 * p.value), 1e-6) << p.value;
  }
}

/// What a file keeps: of the points within a walk nothing but their rows.
TorusBranch as_from_a_file(TorusBranch torus) {
  for (CircleWalk& walk : torus.walks) {
    auto& points = walk.branch.points;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) points[i] = {};
  }
  return torus;
}

// Wherever it is stopped, it ends with the same numbers, bit by bit.
TEST(TorusBranch, GoesOnWhereItWasStopped) {
  const std::vector<CirclePoint> whole =
      follow_torus(normal_form, scale, begun(), options(), {}).points();
  for (const long stop : {0L, 1L, 2L, 5L, 8L, 13L}) {
    long asked = 0, saved = 0;
    const TorusBranch part = follow_torus(normal_form, scale, begun(), options(),
                                          {.is_stopped = [&] { return asked++ >= stop; },
                                           .save =
                                               [&](const TorusBranch& so_far) {
                                                 ++saved;
                                                 EXPECT_FALSE(so_far.is_complete);
                                               }});
    EXPECT_FALSE(part.is_complete);
    EXPECT_GT(saved, 0);
    const TorusBranch rest = follow_torus(normal_form, scale, as_from_a_file(part), options(), {});
    EXPECT_TRUE(rest.is_complete);
    const std::vector<CirclePoint> points = rest.points();
    ASSERT_EQ(points.size(), whole.size()) << stop;
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(points[i].value, whole[i].value) << stop;
      EXPECT_EQ(points[i].rotation, whole[i].rotation) << stop;
      EXPECT_EQ(points[i].growth, whole[i].growth) << stop;
    }
  }
}

// The motion that the circle is guessed from goes no further.
TEST(TorusBranch, HasNoCircleWhereItWasStopped) {
  const Scene scene = test::MassInRing{}.scene();
  MotionState start;
  start.y = Vec::Zero(scene.contacts.size());
  int asked = 0;
  const TorusBranch torus = find_torus(scene, start, {}, [&] { return ++asked > 2; });
  EXPECT_EQ(torus.circle.points.size(), 0);
  EXPECT_FALSE(torus.is_complete);
  EXPECT_LE(asked, 4);
}

}  // namespace whirl::torus_branch_test
