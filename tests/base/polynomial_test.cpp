// The first fall of a polynomial below zero: no root is missed, none is invented.

#include "libbase/numerics/polynomial.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <random>

namespace whirl::polynomial_test {

// A root is taken as reached at g = 1e-15: a root of multiplicity m lies within (1e-15)^(1/m) of
// it.
constexpr double at_simple_root = 1e-14;
constexpr double at_double_root = 1e-7;
constexpr double at_triple_root = 3e-5;

Polynomial polynomial(std::initializer_list<double> coefficients) {
  Polynomial g;
  for (const double c : coefficients) g.c[static_cast<std::size_t>(g.degree++)] = c;
  --g.degree;
  return g;
}

Polynomial product(const Polynomial& a, const Polynomial& b) {
  Polynomial g;
  g.degree = a.degree + b.degree;
  for (int i = 0; i <= a.degree; ++i) {
    for (int j = 0; j <= b.degree; ++j) {
      g.c[static_cast<std::size_t>(i + j)] +=
          a.c[static_cast<std::size_t>(i)] * b.c[static_cast<std::size_t>(j)];
    }
  }
  return g;
}

/// a - s, which falls through zero at a.
Polynomial falls_at(double a) {
  return polynomial({a, -1.0});
}

constexpr double places[] = {1e-6, 0.1, 1.0 / 3.0, 0.5, 0.77, 1.0 - 1e-6};

TEST(Polynomial, AndItsSlopeAreThoseOfItsCoefficients) {
  const Polynomial g = polynomial({1.0, -2.0, 0.0, 4.0});
  EXPECT_EQ(g(0.5), 1.0 - 1.0 + 0.5);
  EXPECT_EQ(g.derivative(0.5), -2.0 + 3.0);
  EXPECT_EQ(polynomial({3.0}).derivative(0.5), 0.0);
}

// ---- simple, double, triple roots ---------------------------------------------------------------

TEST(FirstFall, FindsASimpleRoot) {
  for (const double a : places) {
    const auto s = first_downward_zero(falls_at(a), false);
    ASSERT_TRUE(s) << a;
    EXPECT_NEAR(*s, a, at_simple_root);
    const auto curved =
        first_downward_zero(product(falls_at(a), polynomial({1.0, -0.3, 2.0, 0.5})), false);
    ASSERT_TRUE(curved) << a;
    EXPECT_NEAR(*curved, a, at_simple_root);
  }
}

TEST(FirstFall, FindsTheFirstOfTwoRootsHoweverNear) {
  for (const double a : {0.1, 0.5, 0.77}) {
    for (const double distance : {0.2, 1e-2, 1e-4, 1e-6}) {
      const auto s = first_downward_zero(product(falls_at(a), falls_at(a + distance)), false);
      ASSERT_TRUE(s) << a << " " << distance;
      // g = 1e-15 is reached 1e-15 / distance before the root
      EXPECT_NEAR(*s, a, 2e-15 / distance + at_simple_root);
    }
  }
}

TEST(FirstFall, DoesNotJumpOverADoubleRoot) {
  for (const double a : {0.1, 1.0 / 3.0, 0.5, 0.77}) {
    const auto s = first_downward_zero(product(falls_at(a), falls_at(a)), false);
    ASSERT_TRUE(s) << a;
    EXPECT_NEAR(*s, a, at_double_root);
  }
}

TEST(FirstFall, FindsATripleRoot) {
  for (const double a : {0.1, 1.0 / 3.0, 0.5, 0.77}) {
    const auto s =
        first_downward_zero(product(falls_at(a), product(falls_at(a), falls_at(a))), false);
    ASSERT_TRUE(s) << a;
    EXPECT_NEAR(*s, a, at_triple_root);
  }
}

TEST(FirstFall, FindsNothingWhereThereIsNoRoot) {
  EXPECT_FALSE(first_downward_zero(polynomial({1.0}), false));
  EXPECT_FALSE(first_downward_zero(polynomial({1.0, 0.0, 0.0}), false));  // a rotor at rest
  EXPECT_FALSE(first_downward_zero(polynomial({1.0, -0.999}), false));
  EXPECT_FALSE(first_downward_zero(polynomial({0.26, -1.0, 1.0}), false));  // (s - 1/2)^2 + 0.01
  EXPECT_FALSE(first_downward_zero(falls_at(1.0 + 1e-9), false));
}

// ---- grazes -------------------------------------------------------------------------------------

// g = b (s - a)^2 (1 + s^3) -+ 1e-13: the dip between the roots is a thousandth of a billionth
// deep.
TEST(FirstFall, FindsGrazesAndPassesNearMisses) {
  constexpr double depth = 1e-13;
  for (const double a : places) {
    for (const double b : {0.1, 1.0, 30.0}) {
      Polynomial g = product(product(falls_at(a), falls_at(a)), polynomial({b, 0.0, 0.0, b}));
      g.c[0] -= depth;
      if (g.c[0] > 0.0) {
        const double dip = a - std::sqrt(depth / (b * (1.0 + a * a * a)));
        const auto s = first_downward_zero(g, false);
        ASSERT_TRUE(s) << a << " " << b;
        EXPECT_NEAR(*s, dip, 0.1 * (a - dip))
            << b;  // rounding of the depth by 1e-14 moves it by 5 %
      }
      g.c[0] += 2.0 * depth;
      EXPECT_FALSE(first_downward_zero(g, false)) << a << " " << b;
    }
  }
}

// ---- starts on the surface ----------------------------------------------------------------------

TEST(FirstFall, OfARiseFromTheSurfaceIsTheNextOne) {
  for (const double noise : {0.0, 1e-15, -1e-15, 1e-12, -1e-12}) {  // c_0 is what rounding left
    EXPECT_FALSE(first_downward_zero(polynomial({noise, 1.0}), true));
    EXPECT_FALSE(first_downward_zero(polynomial({noise, 1.0, -0.999}), true));
    const auto s = first_downward_zero(polynomial({noise, 1.0, -2.0}), true);  // s (1 - 2 s)
    ASSERT_TRUE(s);
    EXPECT_NEAR(*s, 0.5, at_simple_root);
    const auto slow = first_downward_zero(polynomial({noise, 1e-7, -2e-7}), true);
    ASSERT_TRUE(slow);
    EXPECT_NEAR(*slow, 0.5, at_simple_root / 1e-7);  // 1e-15 of a smaller function
  }
}

TEST(FirstFall, OfAFallFromTheSurfaceIsAtTheStart) {
  for (const double noise : {0.0, 1e-15, -1e-15, 1e-12, -1e-12}) {
    EXPECT_EQ(first_downward_zero(polynomial({noise, -1.0, 3.0}), true), 0.0);
  }
}

// Without a slope the bend decides, as where sticking ends and the slip begins with zero rate.
TEST(FirstFall, OfAFlatStartIsDecidedByTheBend) {
  for (const double slope : {0.0, 1e-13, -1e-13}) {  // rounding of interpolated coefficients
    EXPECT_FALSE(first_downward_zero(polynomial({0.0, slope, 1.0}), true)) << slope;
    EXPECT_EQ(first_downward_zero(polynomial({0.0, slope, -1.0}), true), 0.0) << slope;
    const auto s = first_downward_zero(polynomial({0.0, slope, 1.0, -4.0}), true);  // s^2 (1 - 4 s)
    ASSERT_TRUE(s) << slope;
    EXPECT_NEAR(*s, 0.25, 1e-11);  // moved by the slope
  }
  EXPECT_FALSE(first_downward_zero(polynomial({0.0, 0.0, 0.0}), true));  // stays on the surface
}

// A start that nobody has flagged, zero up to rounding, is a start on the surface; below is an
// event.
TEST(FirstFall, OfAZeroStartNeedsNoFlag) {
  EXPECT_FALSE(first_downward_zero(polynomial({5e-16, 1.0}), false));
  EXPECT_EQ(first_downward_zero(polynomial({5e-16, -1.0}), false), 0.0);
  EXPECT_EQ(first_downward_zero(polynomial({-1e-3, 1.0}), false), 0.0);
}

// 1.1 + T_8(2 s - 1) stays above 0.1; 0.9 + T_8 first falls where cos(8 phi) = -0.9,
// s = (1 - cos phi) / 2. The coefficients are up to 10^5: the bound on g'' is far from g''.
TEST(FirstFall, OfAFunctionThatWaversIsNeitherMissedNorInvented) {
  Polynomial wavering =
      polynomial({1.0, -128.0, 2688.0, -21504.0, 84480.0, -180224.0, 212992.0, -131072.0, 32768.0});
  wavering.c[0] += 1.1;
  EXPECT_FALSE(first_downward_zero(wavering, false));
  wavering.c[0] -= 0.2;
  const auto s = first_downward_zero(wavering, false);
  ASSERT_TRUE(s);
  EXPECT_NEAR(*s, 0.5 * (1.0 - std::cos(std::acos(-0.9) / 8.0)), at_simple_root);
}

// ---- brute force --------------------------------------------------------------------------------

/// First change of sign on a fine grid; -1 if there is none, -2 if the grid cannot tell.
double brute_force(const Polynomial& g) {
  constexpr int intervals = 4000;
  constexpr double doubtful = 1e-6;  // nearly touches: a dip may hide between two points
  double before = g(0.0);
  for (int i = 1; i <= intervals; ++i) {
    const double s = static_cast<double>(i) / intervals, value = g(s);
    if (value < 0.0) {
      double low = s - 1.0 / intervals, high = s;
      for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        (g(middle) < 0.0 ? high : low) = middle;
      }
      return high;
    }
    if (std::min(before, value) < doubtful) return -2.0;
    before = value;
  }
  return -1.0;
}

TEST(FirstFall, OfRandomPolynomialsIsThatOfBruteForce) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<int> degree(1, 22);
  int with = 0, without = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    Polynomial g;
    g.degree = degree(random);
    for (int k = 1; k <= g.degree; ++k) g.c[static_cast<std::size_t>(k)] = normal(random);
    g.c[0] = std::abs(normal(random));
    const double expected = brute_force(g);
    if (expected == -2.0) continue;
    const auto s = first_downward_zero(g, false);
    if (expected < 0.0) {
      EXPECT_FALSE(s) << trial;
      ++without;
    } else {
      ASSERT_TRUE(s) << trial;
      EXPECT_NEAR(*s, expected, 1e-11) << trial;  // g = 1e-15 on a slope of 1e-3 at least
      ++with;
    }
  }
  EXPECT_GT(with, 1000);
  EXPECT_GT(without, 1000);
}

}  // namespace whirl::polynomial_test
