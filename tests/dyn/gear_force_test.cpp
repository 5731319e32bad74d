// Forces of the teeth of gears under unbalance.

#include <gtest/gtest.h>

#include <vector>

#include "libdyn/linear/bearing_response.hpp"
#include "libfe/analyses/unbalance.hpp"
#include "libfe/assembly/assemble.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::gear_force_test {

constexpr double m = 5.0, k = 2e6, U = 1e-4;

/// Two bodies that tilt, with helical teeth between them; the unbalance of one is U.
Structure two_wheels() {
  Structure s;
  s.rotors = {{.name = "other", .ratio = -1.0}};
  for (const char* const name : {"a", "b"}) {
    s.bodies.push_back(
        {.name = name, .m = m, .spins = true, .tilts = true, .Id = 0.02, .Ip = 0.03});
    BearingCoefficients springs = test::isotropic(k);
    springs.Kt.diagonal().setConstant(2e4);
    s.bearings.push_back(test::bearing(test::body(name), springs));
  }
  s.bodies[1].rotor = "other";
  s.gears = {{.name = "teeth",
              .driving = test::body("a"),
              .driven = test::body("b"),
              .stiffness = 3e6,
              .damping = 200.0,
              .driving_radius = 0.2,
              .driven_radius = 0.2,
              .centers = 0.4,
              .helix_angle = 0.3}};
  s.unbalances = {{.at = test::body("a"), .moment = U}};
  return s;
}

// Momentum of each wheel: its bearing and its teeth carry its unbalance and its inertia. The tilts,
// which helical teeth push against, are not among the points of the response.
TEST(GearForces, KeepTheMomentumOfBothWheels) {
  const Assembler assembler(two_wheels());
  const std::vector<double> speeds{300.0, 700.0};
  const UnbalanceResponse response = unbalance_response(
      assembler, speeds, {assembler.point(test::body("a")), assembler.point(test::body("b"))});
  const std::vector<BearingResponse> forces = bearing_responses(assembler, response);
  ASSERT_EQ(forces.size(), 3u);
  EXPECT_EQ(forces[2].kind, "gear");
  EXPECT_EQ(forces[2].name, "teeth");
  for (Eigen::Index s = 0; s < 2; ++s) {
    const double w2 = speeds[static_cast<std::size_t>(s)] * speeds[static_cast<std::size_t>(s)];
    const Complex load = U * w2;  // along x; along y a quarter of a turn later
    const double rounding = 1e-11 * U * w2;
    const Complex i(0.0, 1.0);
    EXPECT_LT(std::abs(load + (m * w2 - k) * response.x(0, s) - forces[2].x(s)), rounding);
    EXPECT_LT(std::abs(-i * load + (m * w2 - k) * response.y(0, s) - forces[2].y(s)), rounding);
    EXPECT_LT(std::abs((m * w2 - k) * response.x(1, s) + forces[2].x(s)), rounding);
    EXPECT_LT(std::abs((m * w2 - k) * response.y(1, s) + forces[2].y(s)), rounding);
    EXPECT_GT(std::abs(forces[2].x(s)), 1e-3 * U * w2);
    EXPECT_LT(std::abs(k * response.x(0, s) - forces[0].x(s)), rounding);
  }
}

}  // namespace whirl::gear_force_test
