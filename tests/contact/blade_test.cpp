// Blade tips: the closed form of contact and blade in series, and the blade's shortening.

#include "libcontact/blade.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "libcontact/laws.hpp"

namespace whirl::blade_test {

/// The root of z + b z^3 = d by bisection in long double, to its last digit.
long double bisected(long double d, long double b) {
  long double low = 0.0L, high = d;
  for (int i = 0; i < 200; ++i) {
    const long double middle = 0.5L * (low + high);
    (middle + b * middle * middle * middle < d ? low : high) = middle;
  }
  return low;
}

// From blades that do not bend (b = 0) to those that are all that gives.
TEST(Indentation, IsTheRootOfItsCubicOverManyDecades) {
  constexpr double accurate = 1e-14;  // relative
  for (double d = 1e-30; d < 1e6; d *= 3.7) {
    EXPECT_EQ(indentation(d, 0.0), d);
    for (double b = 1e-30; b < 1e40; b *= 8.3) {
      const auto z = static_cast<double>(bisected(d, b));
      EXPECT_NEAR(indentation(d, b), z, accurate * z) << d << ' ' << b;
    }
  }
  EXPECT_EQ(indentation(0.0, 1e9), 0.0);
  EXPECT_EQ(indentation(-1e-6, 1e9), -indentation(1e-6, 1e9));
}

// N solves d = (N / k)^(2/3) + c_b N^2.
TEST(BladeTip, BendsAsItIsPressed) {
  const double k = 4.628e10, c = 2.755e-13;
  const BladeTip<> law{.k = k, .bend = c * k * k};
  for (double d = 1e-12; d < 1e-2; d *= 2.1) {
    const double N = law.normal(d, 0.0);
    EXPECT_NEAR(std::pow(N / k, 2.0 / 3.0) + c * N * N, d, 1e-13 * d) << d;
  }
  const Hertz<> rigid{.k = k};
  EXPECT_NEAR(law.normal(1e-12, 0.0), rigid.normal(1e-12, 0.0), 1e-12 * rigid.normal(1e-12, 0.0));
}

const BladeTip<> blade{.tip_radius = 0.118,
                       .blade_length = 0.045,
                       .bending_stiffness = 21.0,
                       .line_density = 8000.0 * 64e-6};

// Without rotation mu^2 l^5 / (15 (E I)^2): the cubic of the loaded cantilever is among the modes.
TEST(Blade, IsShortenedAsACantileverIs) {
  const double exact = 0.01 * std::pow(0.045, 5) / (15.0 * 21.0 * 21.0);
  EXPECT_NEAR(blade_shortening(blade, 0.1, 0.0), exact, 1e-12 * exact);
  EXPECT_NEAR(exact, 2.79e-13, 0.005e-13);
  EXPECT_EQ(blade_shortening(blade, 0.0, 500.0), 0.0);
}

// Without rotation l^3 / (3 E I).
TEST(Blade, IsBentAsACantileverIs) {
  const double exact = std::pow(0.045, 3) / (3.0 * 21.0);
  EXPECT_NEAR(blade_deflection(blade, 0.0), exact, 1e-12 * exact);
  EXPECT_LT(blade_deflection(blade, 534.0), exact);  // the tension stiffens it
}

// The value of an independent program of ours, at 5100 rpm: tension stiffens the blade.
TEST(Blade, IsStiffenedByRotation) {
  const double at_speed = blade_shortening(blade, 0.1, 5100.0 * std::numbers::pi / 30.0);
  EXPECT_NEAR(at_speed, 2.755e-13, 0.0005e-13);
}

}  // namespace whirl::blade_test
