// Derivatives that numbers carry, against those of calculus.

#include "libbase/numerics/dual.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace whirl::dual_test {

constexpr double rounding = 1e-14;

// f = sqrt(x) y / tanh(x) - y
TEST(Dual, SlopesAreThoseOfCalculus) {
  const double x = 0.8, y = 1.7;
  const Dual<2> a = Dual<2>::variable(x, 0), b = Dual<2>::variable(y, 1);
  const Dual<2> f = sqrt(a) * b / tanh(a) - b;
  const double t = std::tanh(x), root = std::sqrt(x);
  EXPECT_NEAR(f.value, root * y / t - y, rounding);
  EXPECT_NEAR(f.slopes(0), y * (0.5 / root / t - root * (1.0 - t * t) / (t * t)), rounding);
  EXPECT_NEAR(f.slopes(1), root / t - 1.0, rounding);
}

TEST(Dual, ConstantsHaveNoSlopes) {
  const Dual<3> c = 2.0;
  EXPECT_TRUE((-c + 1.0).slopes.isZero(0.0));
  EXPECT_EQ((-c + 1.0).value, -1.0);
}

}  // namespace whirl::dual_test
