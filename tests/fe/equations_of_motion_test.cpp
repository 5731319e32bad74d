// Shafts that spin at speeds of their own: their parts of the equations of motion, summed.

#include "libfe/eigen/equations_of_motion.hpp"

#include <gtest/gtest.h>

#include "libfe/analyses/modes.hpp"
#include "libfe/analyses/reduce.hpp"
#include "libfe/eigen/dynamic_stiffness.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::equations_of_motion_test {

constexpr double rounding = 1e-9;  // relative; of eigenvalues

/// A rotor whose shaft damps, so that it has both matrices that go with the spin.
System rotor_that_damps(double Omega) {
  Structure rotor = test::two_disk(test::isotropic(1e6, 500.0));
  for (Segment& s : rotor.shaft) s.material.eta = 1e-4;
  return assemble(rotor, Omega);
}

void expect_same_modes(const Modes& modes, const Modes& expected) {
  ASSERT_EQ(modes.oscillatory.size(), expected.oscillatory.size());
  for (std::size_t i = 0; i < modes.oscillatory.size(); ++i) {
    const Complex lambda = expected.oscillatory[i].lambda;
    EXPECT_LE(std::abs(modes.oscillatory[i].lambda - lambda), rounding * std::abs(lambda));
  }
}

// What spins backward as fast as something equal spins forward takes its gyroscopics and its
// rotating damping away: the modes are those at rest.
TEST(EquationsOfMotion, EqualShaftsThatSpinAgainstEachOtherAreAtRest) {
  System s = rotor_that_damps(400.0);
  ASSERT_TRUE(s.circulates());
  ASSERT_EQ(s.spin_parts.size(), 1u);
  s.spin_parts.push_back(s.spin_parts[0]);
  s.spin_parts[1].ratio = -1.0;
  EXPECT_TRUE(Mat(s.G()).isZero(0.0));
  EXPECT_EQ(Mat(s.D()), Mat(s.C));
  EXPECT_EQ(Mat(s.stiffness()), Mat(s.K));
  expect_same_modes(complex_modes(s, 6), complex_modes(rotor_that_damps(0.0), 6));
}

TEST(EquationsOfMotion, AShaftAtTwiceTheSpeedIsThatAtTwiceOmega) {
  System s = rotor_that_damps(200.0);
  s.spin_parts[0].ratio = 2.0;
  const System twice = rotor_that_damps(400.0);
  expect_same_modes(complex_modes(s, 6), complex_modes(twice, 6));
  const CVec force = CVec::Ones(s.size());
  const auto q = DynamicStiffness(s).solve(300.0, 200.0, force);
  const auto expected = DynamicStiffness(twice).solve(300.0, 400.0, force);
  ASSERT_TRUE(q && expected);
  EXPECT_LE((*q - *expected).norm(), rounding * expected->norm());
}

// Every shaft is reduced by itself, so that the reduced equations hold at other ratios, too.
TEST(EquationsOfMotion, AReducedSystemKeepsItsShaftsApart) {
  System s = rotor_that_damps(400.0);
  s.spin_parts.push_back({0.5, 3.0 * s.spin_parts[0].G, 2.0 * s.spin_parts[0].H});
  const Mat Phi = Mat::Identity(s.size(), 4);
  ReducedSystem r = in_shapes(s, Phi);
  ASSERT_EQ(r.spin_parts.size(), 2u);
  EXPECT_EQ(r.spin_parts[1].ratio, 0.5);
  EXPECT_EQ(r.G(), 2.5 * Mat(s.spin_parts[0].G).topLeftCorner(4, 4));
  EXPECT_EQ(r.H(), 2.0 * Mat(s.spin_parts[0].H).topLeftCorner(4, 4));
  r.spin_parts[1].ratio = s.spin_parts[1].ratio = -0.25;
  EXPECT_EQ(r.D(), Mat(s.D()).topLeftCorner(4, 4));
  EXPECT_EQ(r.stiffness(), Mat(s.stiffness()).topLeftCorner(4, 4));
}

TEST(EquationsOfMotion, CirculateWhereSomethingThatRotatesDamps) {
  System s = rotor_that_damps(400.0);
  const Mat Phi = Mat::Identity(s.size(), 4);
  EXPECT_TRUE(in_shapes(s, Phi).circulates());
  s.spin_parts[0].H = Sparse(s.size(), s.size());
  EXPECT_FALSE(s.circulates());
  EXPECT_FALSE(in_shapes(s, Phi).circulates());
  s.spin_parts.clear();
  EXPECT_FALSE(s.circulates());
  EXPECT_EQ(s.G().nonZeros(), 0);
  EXPECT_EQ(Mat(s.D()), Mat(s.C));
}

}  // namespace whirl::equations_of_motion_test
