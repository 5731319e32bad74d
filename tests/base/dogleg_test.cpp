// Least squares whose solutions are known.

#include "libbase/numerics/dogleg.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace whirl::dogleg_test {

/// Equations of some unknowns and their derivatives, dense.
LeastSquares problem(std::function<Vec(const Vec&)> r, std::function<Mat(const Vec&)> J) {
  return {.evaluate = [=](const Vec& x, Vec& residuals, Sparse* slopes) {
    residuals = r(x);
    if (slopes) *slopes = J(x).sparseView();
    return residuals.allFinite();
  }};
}

/// Rosenbrock's valley, 10 (x2 - x1^2) and 1 - x1: zero at (1, 1).
LeastSquares valley() {
  return problem(
      [](const Vec& x) {
        return Vec{{10.0 * (x(1) - x(0) * x(0)), 1.0 - x(0)}};
      },
      [](const Vec& x) {
        return Mat{{-20.0 * x(0), 10.0}, {-1.0, 0.0}};
      });
}

TEST(Dogleg, FindsTheEndOfABentValley) {
  const auto found = dogleg(valley(), Vec{{-1.2, 1.0}}, {.cost_tolerance = 1e-14});
  EXPECT_EQ(found.end, DoglegEnd::converged);
  EXPECT_NEAR(found.x(0), 1.0, 1e-9);
  EXPECT_NEAR(found.x(1), 1.0, 1e-9);
  EXPECT_LT(found.cost, 1e-18);
}

// Within x1 <= 1/2 the least is on that bound, where x2 = x1^2: (1/2, 1/4), half the square of 1/2
// left.
TEST(Dogleg, EndsOnABoundThatTheLeastIsBeyond) {
  LeastSquares bounded = valley();
  bounded.lower = Vec{{-2.0, -HUGE_VAL}};
  bounded.upper = Vec{{0.5, HUGE_VAL}};
  const auto found = dogleg(bounded, Vec{{-1.2, 1.0}}, {.cost_tolerance = 1e-14});
  EXPECT_EQ(found.end, DoglegEnd::converged);
  EXPECT_EQ(found.x(0), 0.5);
  EXPECT_NEAR(found.x(1), 0.25, 1e-9);
  EXPECT_NEAR(found.cost, 0.125, 1e-12);
}

// A bound at which the search begins, and away from which the cost falls, holds nothing.
TEST(Dogleg, LeavesABoundThatItBeginsAt) {
  LeastSquares bounded = valley();
  bounded.lower = Vec{{-1.2, -HUGE_VAL}};
  bounded.upper = Vec{{HUGE_VAL, 1.0}};
  const auto found = dogleg(bounded, Vec{{-1.2, 1.0}}, {.cost_tolerance = 1e-14});
  EXPECT_NEAR(found.x(0), 1.0, 1e-7);
}

// A straight line through points: one Gauss-Newton step, the normal equations' solution. The third
// unknown is in no equation and stays.
TEST(Dogleg, SolvesLinearEquationsInAStep) {
  const Mat A{{1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {1.0, 2.0, 0.0}};
  const Vec b{{1.0, 2.0, 4.0}};
  const auto found =
      dogleg(problem([=](const Vec& x) { return Vec(A * x - b); }, [=](const Vec&) { return A; }),
             Vec{{0.0, 0.0, 7.0}});
  EXPECT_EQ(found.end, DoglegEnd::converged);
  EXPECT_LE(found.iterations, 3);
  EXPECT_NEAR(found.x(0), 5.0 / 6.0, 1e-7);
  EXPECT_NEAR(found.x(1), 1.5, 1e-7);
  EXPECT_EQ(found.x(2), 7.0);
}

// log x - 1 is not defined below zero, where the first steps lead: 10 - 10 (ln 10 - 1) = -3.
TEST(Dogleg, ShortensStepsThatLeadOutOfWhereEquationsAreDefined) {
  const LeastSquares logarithm = problem([](const Vec& x) { return Vec{{std::log(x(0)) - 1.0}}; },
                                         [](const Vec& x) { return Mat{{1.0 / x(0)}}; });
  const auto found = dogleg(logarithm, Vec{{10.0}}, {.cost_tolerance = 1e-14});
  EXPECT_EQ(found.end, DoglegEnd::converged);
  EXPECT_NEAR(found.x(0), std::exp(1.0), 1e-8);
}

TEST(Dogleg, SaysWhyItEnds) {
  const auto nowhere = problem([](const Vec&) { return Vec{{std::nan("")}}; },
                               [](const Vec&) { return Mat{{1.0}}; });
  EXPECT_EQ(dogleg(nowhere, Vec{{1.0}}).end, DoglegEnd::undefined);
  EXPECT_EQ(dogleg(valley(), Vec{{-1.2, 1.0}}, {.most_iterations = 3}).end,
            DoglegEnd::most_iterations);
  EXPECT_EQ(dogleg(valley(), Vec{{-1.2, 1.0}}, {.is_stopped = [] { return true; }}).end,
            DoglegEnd::stopped);
}

}  // namespace whirl::dogleg_test
