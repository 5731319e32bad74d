// Pairs of gears between two shafts.

#include "libfe/mesh/elements/gear.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/analyses/modes.hpp"
#include "libfe/analyses/static.hpp"
#include "libfe/assembly/assemble.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::gear_test {

using test::pi;
using Vec3 = Eigen::Vector3d;

GearPair helical() {
  return {.stiffness = 3e8,
          .damping = 2e3,
          .driving_radius = 0.25,
          .driven_radius = 0.1,
          .centers = 0.7,
          .pressure_angle = 0.35,
          .helix_angle = 0.2};
}

/// Unit normal of the teeth that touch, from the driving into the driven one, from the tangent to a
/// right-handed helix on the pitch cylinder and from the pressure angle.
Vec3 normal(const GearPair& gears, double sense) {
  const Vec3 c(std::cos(gears.centers), std::sin(gears.centers), 0.0);
  const Vec3 t = Vec3::UnitZ().cross(c);
  const Vec3 along = std::cos(gears.helix_angle) * Vec3::UnitZ() + std::sin(gears.helix_angle) * t;
  const Vec3 across = sense * along.cross(c);  // to the tooth and to the radius
  return std::cos(gears.pressure_angle) * across + std::sin(gears.pressure_angle) * c;
}

/// Two equal bodies on springs, the second of which turns against the first.
Structure two_bodies(double ratio, double driving_radius, double driven_radius) {
  Structure s;
  s.rotors = {{.name = "other", .ratio = ratio}};
  s.bodies = {{.name = "a", .m = 5.0, .spins = true},
              {.name = "b", .m = 5.0, .spins = true, .rotor = "other"}};
  for (const char* name : {"a", "b"})
    s.bearings.push_back(test::bearing(test::body(name), test::isotropic(2e6)));
  s.gears = {{.name = "teeth",
              .driving = test::body("a"),
              .driven = test::body("b"),
              .stiffness = 3e6,
              .driving_radius = driving_radius,
              .driven_radius = driven_radius,
              .centers = 0.4,
              .helix_angle = 0.0}};
  return s;
}

TEST(Gears, TeethGiveWayAlongTheirNormalAtThePitchPoint) {
  const GearPair gears = helical();
  const Vec3 c(std::cos(gears.centers), std::sin(gears.centers), 0.0);
  for (const double sense : {1.0, -1.0}) {
    const Vec3 n = normal(gears, sense);
    ASSERT_NEAR(n.norm(), 1.0, 1e-15);
    ASSERT_GT(sense * n.dot(Vec3::UnitZ().cross(c)), 0.0);  // as the driving tooth moves
    ASSERT_GT(n.dot(c), 0.0);                               // gears are pushed apart
    const auto e = matrices(gears, sense);
    for (int i = 0; i < 8; ++i) {
      Eigen::Matrix<double, 8, 1> q = Eigen::Matrix<double, 8, 1>::Zero();
      q(i) = 1.0;
      const Vec3 at_driving =
          Vec3(q(0), q(1), 0.0) + Vec3(q(2), q(3), 0.0).cross(Vec3(gears.driving_radius * c));
      const Vec3 at_driven =
          Vec3(q(4), q(5), 0.0) + Vec3(q(6), q(7), 0.0).cross(Vec3(-gears.driven_radius * c));
      const double approach = n.dot(at_driving - at_driven);
      // energy of one freedom alone, and force on the driving gear
      EXPECT_NEAR(q.dot(e.K * q), gears.stiffness * approach * approach, 1e-7);
      EXPECT_NEAR(q.dot(e.C * q), gears.damping * approach * approach, 1e-12);
      const Vec3 force = -gears.stiffness * approach * n;
      EXPECT_NEAR((-(e.K * q)).eval()(0), force.x(), 1e-7);
      EXPECT_NEAR((-(e.K * q)).eval()(1), force.y(), 1e-7);
      EXPECT_NEAR((-(e.K * q)).eval()(4), -force.x(), 1e-7);
    }
  }
}

TEST(Gears, StiffenOneDirectionOfTwoBodies) {
  const auto modes = complex_modes(assemble(two_bodies(-1.0, 0.2, 0.2), 100.0), 4);
  ASSERT_EQ(modes.oscillatory.size(), 4u);
  const double alone = std::sqrt(2e6 / 5.0), with_teeth = std::sqrt((2e6 + 2.0 * 3e6) / 5.0);
  for (const int i : {0, 1, 2}) EXPECT_NEAR(modes.oscillatory[i].frequency() / alone, 1.0, 1e-12);
  const Mode& last = modes.oscillatory[3];
  EXPECT_NEAR(last.frequency() / with_teeth, 1.0, 1e-12);
  // along the line of action, 20 degrees off the tangent
  const double angle = 0.4 + 0.5 * pi - pi / 9.0;
  const Complex x = last.shape(0), y = last.shape(1);
  EXPECT_NEAR(std::abs(x * std::sin(angle) - y * std::cos(angle)), 0.0, 1e-9 * std::abs(y));
  EXPECT_NEAR(std::abs(last.shape(2) + x), 0.0, 1e-9 * std::abs(y));
}

// Teeth of stiffness k between bodies on springs K, one of which is pushed by f along n: they give
// way by d = f / (K + 2 k) and push with k d, which its own spring misses and the other one has.
TEST(Gears, PushAlongTheirLineOfAction) {
  Structure s = two_bodies(-1.0, 0.2, 0.2);
  s.forces = {{.name = "push", .at = test::body("a"), .size = 100.0, .angle = 0.9}};
  const StaticEquilibrium found = static_equilibrium(Assembler(s), 100.0);
  const double angle = 0.4 + 0.5 * pi - pi / 9.0;
  const double size = 3e6 * 100.0 * std::cos(0.9 - angle) / (2e6 + 2.0 * 3e6);
  const Vec2 teeth = size * Vec2(std::cos(angle), std::sin(angle));
  const Vec2 load = 100.0 * Vec2(std::cos(0.9), std::sin(0.9));
  ASSERT_EQ(found.links.size(), 1u);
  EXPECT_EQ(found.links[0].name, "teeth");
  EXPECT_LT((found.links[0].force - teeth).norm(), 1e-12 * size);
  ASSERT_EQ(found.bearings.size(), 2u);
  EXPECT_LT((found.bearings[0].force - (load - teeth)).norm(), 1e-12 * size);
  EXPECT_LT((found.bearings[1].force - teeth).norm(), 1e-12 * size);
}

TEST(Gears, SpeedsAreThoseOfTheRadii) {
  EXPECT_NO_THROW(Assembler(two_bodies(-2.0, 0.2, 0.1)));
  EXPECT_NO_THROW(Assembler(two_bodies(-2.0, 0.2, 0.0995)));
  EXPECT_THROW(Assembler(two_bodies(2.0, 0.2, 0.1)), ModelError);
  EXPECT_THROW(Assembler(two_bodies(-2.0, 0.1, 0.2)), ModelError);
  Structure stands = two_bodies(-2.0, 0.2, 0.1);
  stands.bodies[0].spins = false;
  EXPECT_THROW(Assembler{stands}, ModelError);
}

TEST(Gears, AreNoLoads) {
  const Assembler made(two_bodies(-1.0, 0.2, 0.2));
  Structure softer = made.structure();
  EXPECT_TRUE(made.with_loads_of(softer).has_value());
  softer.gears[0].stiffness *= 0.5;
  EXPECT_FALSE(made.with_loads_of(softer).has_value());
}

}  // namespace whirl::gear_test
