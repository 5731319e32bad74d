// Cross-coupled stiffnesses that belong to a frequency.

#include "libfe/lateral/inverse_couplings.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <numbers>
#include <random>

namespace whirl::inverse_couplings_test {

constexpr double rounding = 1e-12;  // relative, of 2 x 2 matrices

Eigen::Matrix2cd random_receptance(std::mt19937& random) {
  std::normal_distribution<double> entry;
  return Eigen::Matrix2cd::NullaryExpr([&] { return Complex(entry(random), entry(random)); });
}

// The rotor with Q has the dynamic stiffness H^-1 + [0 Q; -Q 0], which is singular.
TEST(InverseCouplings, MakeTheDynamicStiffnessSingular) {
  std::mt19937 random(1);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Matrix2cd H = random_receptance(random);
    const InverseCouplings found(H);
    EXPECT_GE(std::abs(found.p[0]), std::abs(found.p[1]));
    EXPECT_EQ(found.size(), std::abs(found.p[0]));
    for (const Complex p : found.p) {
      Eigen::Matrix2cd stiffness = H.inverse();
      const double size = stiffness.squaredNorm() + std::norm(1.0 / p);
      stiffness(0, 1) += 1.0 / p;
      stiffness(1, 0) -= 1.0 / p;
      EXPECT_LE(std::abs(stiffness.determinant()), rounding * size);
    }
  }
}

// Of a receptance that is the same along x and y: one forward, one backward, as far from zero.
TEST(InverseCouplings, OfAnIsotropicStationAreOpposite) {
  const Complex h(2.0, -0.5);
  const InverseCouplings found(h * Eigen::Matrix2cd::Identity());
  EXPECT_LE(std::abs(found.p[0] + found.p[1]), rounding);
  EXPECT_LE(std::abs(found.p[0] * found.p[0] + h * h), rounding);
}

// Both come back in the order of any pair that is near, also where the smaller one has become the
// larger one.
TEST(InverseCouplings, KeepTheOrderOfAPairThatIsNear) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> angle(-std::numbers::pi, std::numbers::pi);
  for (int i = 0; i < 200; ++i) {
    InverseCouplings found(random_receptance(random));
    const double apart = std::abs(found.p[0] - found.p[1]);
    for (const bool turns : {false, true}) {
      std::array<Complex, 2> near = found.p;
      if (turns) std::swap(near[0], near[1]);
      const std::array<Complex, 2> expected = near;
      for (Complex& p : near) p += std::polar(0.2 * apart, angle(random));
      EXPECT_EQ(found.as(near).p, expected);
      EXPECT_TRUE(found.as(near).is_like(found.as(near)));
    }
  }
}

TEST(InverseCouplings, AreAlikeWhereNeitherMovesHalfOfTheWayToTheOther) {
  InverseCouplings from(Eigen::Matrix2cd::Identity()), to = from;
  from.p = {Complex(2.0, 0.0), Complex(0.0, 0.0)};
  to.p = {Complex(2.9, 0.0), Complex(0.0, 0.0)};
  EXPECT_TRUE(to.is_like(from));
  to.p = {Complex(3.1, 0.0), Complex(0.0, 0.0)};
  EXPECT_FALSE(to.is_like(from));  // 1.1 of 2
  to.p = {Complex(2.0, 0.0), Complex(1.1, 0.0)};
  EXPECT_FALSE(to.is_like(from));  // of 0.9 to the other one, too
}

}  // namespace whirl::inverse_couplings_test
