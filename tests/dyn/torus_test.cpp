// Invariant circles: one that is known exactly, and one beside its simulation.

#include "libdyn/branches/torus.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "libbase/error.hpp"
#include "tests/support/flows.hpp"

namespace whirl::torus_test {

constexpr double turn = 2.0 * std::numbers::pi;
constexpr double angle = test::circle_angle, twist = test::circle_twist;

/// A circle of test::turn_circle, and u' = u / 2 + Re z beside it, whose exponent is log(1/2).
Flow normal_form(double a) {
  return test::map_flow(3, [a](const Vec& y, Vec& f, Mat& J) {
    test::turn_circle(a, y, f, J);
    f(2) = 0.5 * y(2) + y(0);
    J.topRightCorner(2, 1).setZero();
    J.bottomRows(1) << 1.0, 0.0, 0.5;
  });
}

/// x' = a x (1 - y), y' = x, whose fixed point is left for a circle at a = 2.
Flow delayed_logistic(double a) {
  return test::map_flow(2, [a](const Vec& y, Vec& f, Mat& J) {
    f << a * y(0) * (1.0 - y(1)), y(0);
    J << a * (1.0 - y(1)), -a * y(0), 1.0, 0.0;
  });
}

Mat sections(const Flow& flow, const Vec& start, int discard, int count) {
  Mat all(start.size(), count);
  Vec y = flow.go({&start, 1}, discard, WithTangent::no)[0].end;
  for (int i = 0; i < count; ++i) {
    all.col(i) = y;
    y = flow.go({&y, 1}, 1, WithTangent::no)[0].end;
  }
  return all;
}

TEST(InvariantCircle, IsThatOfTheNormalForm) {
  constexpr double a = 0.2, solved = 1e-10;
  const Flow flow = normal_form(a);
  const auto guess =
      guessed_circle(sections(flow, Vec{{0.3, 0.0, 0.0}}, 100, 400), flow.scale, 1, 8);
  ASSERT_TRUE(guess);
  const InvariantCircle circle = find_circle(flow, *guess, {.harmonics = 8});
  ASSERT_TRUE(circle.is_good()) << circle.failure;
  EXPECT_TRUE(circle.is_stable());
  EXPECT_LT(circle.residual, 1e-11);
  EXPECT_NEAR(circle.rotation, (angle + twist * a) / turn, solved);
  for (Eigen::Index j = 0; j < circle.points.cols(); ++j) {
    EXPECT_NEAR(circle.points.col(j).head(2).norm(), std::sqrt(a), solved);
  }
  EXPECT_NEAR(circle.exponents(0), std::log(1.0 - 2.0 * a), 1e-8);
  EXPECT_NEAR(circle.exponents(1), std::log(0.5), 1e-8);
  EXPECT_NEAR(circle.along, 0.0, 1e-8);
}

// A motion that stands still is no circle; few sections say nothing.
TEST(InvariantCircle, NeedsAMotion) {
  EXPECT_FALSE(guessed_circle(Mat::Ones(2, 400), Vec::Ones(2), 1, 8));
  EXPECT_THROW(guessed_circle(Mat::Ones(2, 100), Vec::Ones(2), 1, 8), OptionError);
}

// Harmonics of the circle fall off exponentially: the rotation at K is wrong by less and less, and
// it is that of a simulation of 20 000 iterations, averaged with smooth weights.
TEST(InvariantCircle, ConvergesToTheSimulation) {
  const Flow flow = delayed_logistic(2.1);
  const Mat many = sections(flow, Vec{{0.5, 0.6}}, 2000, 20000);
  const auto guess = guessed_circle(many, flow.scale, 1, 16);
  ASSERT_TRUE(guess);
  std::vector<double> error;
  for (const int K : {4, 8, 16, 32}) {
    const InvariantCircle circle = find_circle(flow, *guess, {.harmonics = K, .most_harmonics = K});
    ASSERT_TRUE(circle.is_good()) << circle.failure;
    error.push_back(std::abs(circle.rotation - guess->rotation));
  }
  for (std::size_t i = 1; i < 3; ++i) EXPECT_LT(error[i], 0.1 * error[i - 1]) << i;
  EXPECT_LT(error[3], 1e-9) << testing::PrintToString(error);
  const InvariantCircle circle = find_circle(flow, *guess, {});
  EXPECT_LT(circle.tail, 1e-8);
  EXPECT_GT(circle.points.cols(), 33);  // more than it began with
  EXPECT_TRUE(circle.is_stable());
}

// Along a the circle of the normal form shrinks to nothing where it was born, as sqrt(a), and turns
// by angle + twist a.
TEST(InvariantCircle, IsFollowedAlongAParameter) {
  const Flow flow = normal_form(0.2);
  const auto guess =
      guessed_circle(sections(flow, Vec{{0.3, 0.0, 0.0}}, 100, 400), flow.scale, 1, 6);
  const InvariantCircle circle = find_circle(flow, *guess, {.harmonics = 6, .most_harmonics = 6});
  Continuation walk(
      circle_equations(normal_form, flow.scale, 1, circle.coordinate),
      circle_unknowns(circle, flow.scale),
      {.low = 0.01, .high = 0.2, .first = 0.2, .direction = -1.0, .largest_step = 0.02});
  while (walk.advance()) {
  }
  EXPECT_TRUE(walk.branch().ends_as(EndKind::range)) << walk.branch().end_text();
  for (const BranchPoint& p : walk.branch().points) {
    const InvariantCircle c = circle_of(p.z.head(p.z.size() - 1), flow.scale, 1);
    EXPECT_NEAR(c.rotation, (angle + twist * p.value) / turn, 1e-9);
    EXPECT_NEAR(c.points.col(3).head(2).norm(), std::sqrt(p.value), 1e-9);
    EXPECT_NEAR(p.multipliers(0).real(), 1.0 - 2.0 * p.value, 1e-6) << p.value;
  }
}

}  // namespace whirl::torus_test
