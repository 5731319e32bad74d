// Roots and maxima between bounds, against known ones.

#include "libbase/numerics/roots.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace whirl::roots_test {

constexpr double tolerance = 1e-12;

TEST(BracketedRoot, FindsKnownRootsWhateverTheOrderOfTheBounds) {
  const auto cosine = [](double x) { return std::cos(x); };
  EXPECT_NEAR(bracketed_root(cosine, 0.0, 3.0, tolerance), 0.5 * M_PI, tolerance);
  EXPECT_NEAR(bracketed_root(cosine, 3.0, 0.0, tolerance), 0.5 * M_PI, tolerance);
  // flat at its root, and steep on one side: where secants crawl
  const auto flat = [](double x) { return std::pow(x - 1.0, 9); };
  EXPECT_NEAR(bracketed_root(flat, 0.0, 5.0, tolerance), 1.0, 1e-11);
  const auto pole = [](double x) { return 1.0 / (x - 3.0) + 6.0; };
  EXPECT_NEAR(bracketed_root(pole, -1e9, 2.9, tolerance), 3.0 - 1.0 / 6.0, tolerance);
}

TEST(BracketedRoot, TakesABoundThatIsTheRootAndRefusesEqualSigns) {
  const auto line = [](double x) { return x - 2.0; };
  EXPECT_EQ(bracketed_root(line, 2.0, 5.0, tolerance), 2.0);
  EXPECT_EQ(bracketed_root(line, 0.0, 2.0, tolerance), 2.0);
  EXPECT_TRUE(std::isnan(bracketed_root(line, 3.0, 5.0, tolerance)));
}

TEST(BracketedRoot, NeedsFewEvaluationsOfASmoothFunction) {
  int calls = 0;
  const auto f = [&](double x) {
    ++calls;
    return x * x * x - 2.0 * x - 5.0;  // Wallis' cubic
  };
  EXPECT_NEAR(bracketed_root(f, 2.0, 3.0, tolerance), 2.0945514815423265, tolerance);
  EXPECT_LE(calls, 12);  // bisection takes 40
}

TEST(BracketedMaximum, FindsSharpAndFlatPeaks) {
  const auto resonance = [](double x) { return 1.0 / std::hypot(1.0 - x, 1e-4); };
  constexpr double root_of_rounding = 1e-7;
  Maximum m = bracketed_maximum(resonance, 0.9, 0.99, 1.3, tolerance);
  EXPECT_NEAR(m.at, 1.0, root_of_rounding);
  EXPECT_NEAR(m.value, 1e4, 1e4 * 1e-5);
  m = bracketed_maximum([](double x) { return -std::pow(x - 0.3, 4); }, 0.0, 0.5, 1.0, tolerance);
  EXPECT_NEAR(m.at, 0.3, 1e-3);  // to the fourth root of rounding only
}

TEST(BracketedMaximum, OfAFunctionThatRisesToABoundIsThere) {
  const Maximum m = bracketed_maximum([](double x) { return x; }, 0.0, 0.5, 1.0, 1e-9);
  EXPECT_NEAR(m.at, 1.0, 1e-6);
}

}  // namespace whirl::roots_test
