// Area, second moment and shear coefficient of circular sections.

#include "libfe/parts/section.hpp"

#include <gtest/gtest.h>

#include "tests/support/rotors.hpp"

namespace whirl::section_test {

constexpr double rounding = 1e-14;  // relative; a few products

const Section solid{.outer = 0.05};
const Section thin{.outer = 0.05, .inner = 0.05 * (1.0 - 1e-7)};
constexpr double thinness = 1e-6;  // a wall of 1e-7 of the radius against none

// A = pi (ro^2 - ri^2),  I = pi (ro^4 - ri^4) / 4
TEST(Section, HollowHasAreaAndSecondMomentOfARing) {
  const Section ring{.outer = 0.08, .inner = 0.06};
  EXPECT_NEAR(ring.A(), test::pi * (0.04 * 0.04 - 0.03 * 0.03), rounding);
  EXPECT_NEAR(ring.I(), test::pi / 4.0 * (std::pow(0.04, 4) - std::pow(0.03, 4)), 1e-20);
}

// [Cowper1966], table 1: circle 6 (1+nu) / (7+6nu), thin round tube 2 (1+nu) / (4+3nu)
TEST(ShearCoefficient, CowperOfCircleAndThinTube) {
  const ShearCoefficient cowper{};
  for (const double nu : {0.0, 0.25, 0.3, 0.5}) {
    EXPECT_NEAR(shear_coefficient(cowper, solid, nu), 6.0 * (1 + nu) / (7 + 6 * nu), rounding);
    EXPECT_NEAR(shear_coefficient(cowper, thin, nu), 2.0 * (1 + nu) / (4 + 3 * nu), thinness);
  }
}

// [Cowper1966], numbers for nu = 0.3: 0.886 for a circle, 0.531 for a thin tube
TEST(ShearCoefficient, CowperAsPrinted) {
  constexpr double printed = 5e-4;  // three digits
  EXPECT_NEAR(shear_coefficient({}, solid, 0.3), 0.886, printed);
  EXPECT_NEAR(shear_coefficient({}, thin, 0.3), 0.531, printed);
}

// [Hutchinson2001]: circle 6 (1+nu)^2 / (7 + 12 nu + 4 nu^2), thin tube (1+nu) / (2+nu)
TEST(ShearCoefficient, HutchinsonOfCircleAndThinTube) {
  const ShearCoefficient hutchinson{.formula = ShearFormula::hutchinson};
  for (const double nu : {0.0, 0.25, 0.3, 0.5}) {
    const double circle = 6.0 * (1 + nu) * (1 + nu) / (7 + 12 * nu + 4 * nu * nu);
    EXPECT_NEAR(shear_coefficient(hutchinson, solid, nu), circle, rounding);
    EXPECT_NEAR(shear_coefficient(hutchinson, thin, nu), (1 + nu) / (2 + nu), thinness);
  }
}

// Both formulas depend on r = inner / outer only, and fall from the solid section to the tube.
TEST(ShearCoefficient, FallsWithTheBoreAndNotWithTheSize) {
  for (const auto formula : {ShearFormula::cowper, ShearFormula::hutchinson}) {
    double above = 1.0;
    for (const double r : {0.0, 0.2, 0.5, 0.8, 0.99}) {
      const double kappa = shear_coefficient({.formula = formula}, {.outer = 1.0, .inner = r}, 0.3);
      const Section larger{.outer = 3.0, .inner = 3.0 * r};
      EXPECT_NEAR(shear_coefficient({.formula = formula}, larger, 0.3), kappa, rounding);
      EXPECT_LT(kappa, above);
      above = kappa;
    }
  }
}

TEST(ShearCoefficient, GivenIsTakenAsItIs) {
  const ShearCoefficient given{.formula = ShearFormula::given, .value = 0.83};
  EXPECT_EQ(shear_coefficient(given, solid, 0.3), 0.83);
}

// Diameters vary linearly along a segment.
TEST(Segment, SectionsLieOnStraightLines) {
  Segment s = test::cone(2.0, 0.10, 0.06, 1);
  s.left.inner = 0.02;
  s.right.inner = 0.04;
  EXPECT_NEAR(s.at(0.25).outer, 0.09, rounding);
  EXPECT_NEAR(s.at(0.25).inner, 0.025, rounding);
  EXPECT_NEAR(s.at(1.0).outer, 0.06, rounding);
}

TEST(Choices, NamesAreThoseOfModelFiles) {
  EXPECT_EQ(name_of(Theory::timoshenko), "timoshenko");
  EXPECT_EQ(name_of(Theory::rayleigh), "rayleigh");
  EXPECT_EQ(name_of(Theory::euler_bernoulli), "euler-bernoulli");
  EXPECT_EQ(name_of(ShearFormula::hutchinson), "hutchinson");
}

}  // namespace whirl::section_test
