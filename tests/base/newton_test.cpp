// Newton's method on equations of one unknown, whose steps are known.

#include "libbase/numerics/newton.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace whirl::newton_test {

struct At {
  double x, residual;
};

/// The search for a root of r from x.
template <class Function, class Slope>
NewtonSearch search(At& at, Function&& r, Slope&& slope, const NewtonOptions& options = {}) {
  at.residual = std::abs(r(at.x));
  return newton(
      at,
      [&](const At& a) {
        return newton_step(Mat::Constant(1, 1, slope(a.x)), Vec::Constant(1, r(a.x)));
      },
      [&](const At& a, const Vec& dx) {
        const double x = a.x - dx(0);
        return At{x, std::abs(r(x))};
      },
      options);
}

// Of x^2 - 2 a residual r is followed by (x - r / 2x)^2 - 2 = r^2 / 4 x^2 = r^2 / (4 r + 8).
TEST(Newton, SquaresTheResidualOfASquareRoot) {
  At at{3.0, 0.0};
  const NewtonSearch found = search(
      at, [](double x) { return x * x - 2.0; }, [](double x) { return 2.0 * x; });
  ASSERT_TRUE(found.has_converged());
  EXPECT_NEAR(at.x, std::sqrt(2.0), at.residual);  // a residual is 2.8 of its errors
  EXPECT_EQ(found.steps(), 5);
  constexpr double rounding = 2e-15;  // of x^2 - 2
  for (std::size_t k = 0; k + 1 < found.residuals.size(); ++k) {
    const double r = found.residuals[k];
    EXPECT_NEAR(found.residuals[k + 1], r * r / (4.0 * r + 8.0), rounding);
  }
}

TEST(Newton, SaysThatThereIsNoStep) {
  At at{0.0, 0.0};
  const NewtonSearch found = search(
      at, [](double x) { return x * x + 1.0; }, [](double x) { return 2.0 * x; });
  EXPECT_EQ(found.end, NewtonEnd::singular);
  EXPECT_EQ(found.failure("no root", "it is flat there"), "no root: it is flat there");
  EXPECT_EQ(at.x, 0.0);
}

// Whole steps of the arc tangent run away from beyond 1.39.
TEST(Newton, HalvesStepsThatRunAway) {
  const auto slope = [](double x) { return 1.0 / (1.0 + x * x); };
  const auto r = [](double x) { return std::atan(x); };
  At at{3.0, 0.0};
  EXPECT_EQ(search(at, r, slope, {.largest_growth = 1.0}).end, NewtonEnd::diverged);
  EXPECT_GT(std::abs(at.x), 3.0);
  at.x = 3.0;
  const NewtonSearch found = search(at, r, slope, {.most_halvings = 6, .worse = 1.0});
  ASSERT_TRUE(found.has_converged());
  EXPECT_NEAR(at.x, 0.0, 1e-11);
  EXPECT_TRUE(std::is_sorted(found.residuals.rbegin(), found.residuals.rend()));
}

// The first whole step for log(x) from 20 leads to -40, where there is none.
TEST(Newton, EndsOrTurnsBackWhereTheEquationsAreNotDefined) {
  const auto slope = [](double x) { return 1.0 / x; };
  const auto r = [](double x) { return std::log(x); };
  At at{20.0, 0.0};
  EXPECT_EQ(search(at, r, slope).end, NewtonEnd::undefined);
  EXPECT_LT(at.x, 0.0);
  at.x = 20.0;
  ASSERT_TRUE(search(at, r, slope, {.most_halvings = 6}).has_converged());
  EXPECT_NEAR(at.x, 1.0, 1e-11);
}

TEST(Newton, MakesNoMoreStepsThanAllowed) {
  At at{3.0, 0.0};
  const NewtonSearch found = search(
      at, [](double x) { return x * x - 2.0; }, [](double x) { return 2.0 * x; },
      {.most_steps = 2});
  EXPECT_EQ(found.end, NewtonEnd::most_steps);
  EXPECT_EQ(found.failure("no root", ""),
            "no root: after 2 steps of Newton's method the residual is 1.4e-01");
}

}  // namespace whirl::newton_test
