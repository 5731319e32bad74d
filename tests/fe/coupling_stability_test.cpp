// Cross-coupled stiffness that a rotor bears.

#include "libfe/lateral/coupling_stability.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/rotors.hpp"

namespace whirl::coupling_stability_test {

using test::at;
using test::pi;

constexpr double exact = 1e-8;  // relative: roots to 1e-10, eigenvalues to 1e-11

// A mass on springs and dampers, x + i y = r e^(lambda t): m lambda^2 + c lambda + k - i Q = 0. It
// whirls by itself where lambda = i omega: m omega^2 = k and Q_0 = c omega, at any speed.
TEST(CouplingStability, OfAJeffcottRotorIsTheClosedForm) {
  const double m = 40.0, omega = 300.0, zeta = 0.04;
  const double k = m * omega * omega, c = 2.0 * zeta * m * omega;
  const Structure s{.bodies = {{.name = "rotor", .m = m, .spins = true}},
                    .bearings = {test::bearing(test::body("rotor"), test::isotropic(k, c))}};
  const double QA = 0.4 * c * omega;
  for (const double Omega : {150.0, 900.0}) {
    const CouplingStability found =
        coupling_stability(s, Omega, test::body("rotor"), {.anticipated = QA});
    ASSERT_TRUE(found.at_limit);
    EXPECT_NEAR(found.at_limit->coupling, c * omega, exact * c * omega) << Omega;
    EXPECT_NEAR(found.at_limit->frequency, omega, exact * omega) << Omega;
    ASSERT_FALSE(found.modes.empty());
    EXPECT_EQ(found.modes.front().coupling, 0.0);
    std::vector<CoupledMode> all = found.modes;
    ASSERT_TRUE(found.at_anticipated);
    all.push_back(*found.at_anticipated);
    for (const CoupledMode& mode : all) {
      const Complex lambda =
          (-c + std::sqrt(Complex(c * c - 4.0 * m * k, 4.0 * m * mode.coupling))) / (2.0 * m);
      EXPECT_NEAR(mode.log_decrement, -2.0 * pi * lambda.real() / lambda.imag(), 1e-6);
      EXPECT_NEAR(mode.frequency, lambda.imag(), exact * omega);
    }
    EXPECT_EQ(found.at_anticipated->coupling, QA);
  }
}

// Unlike springs and dampers along x and y:
//   (m s^2 + c_x s + k_x) (m s^2 + c_y s + k_y) + Q^2 = 0,
// a_4 s^4 + ... + a_0 = 0 with roots on the axis where a_0 = a_1 (a_3 a_2 - a_4 a_1) / a_3^2.
TEST(CouplingStability, OfAnAnisotropicMassIsWhereRouthSays) {
  const double m = 40.0, kx = 3e6, cx = 400.0;
  for (const double share : {1.01, 1.3, 2.0, 6.0}) {
    for (const double damping : {0.1, 1.0, 5.0}) {
      SCOPED_TRACE(::testing::Message() << share << ' ' << damping);
      const double ky = share * kx, cy = damping * cx;
      const double a4 = m * m, a3 = m * (cx + cy), a2 = m * (kx + ky) + cx * cy;
      const double a1 = cx * ky + cy * kx, a0 = a1 * (a3 * a2 - a4 * a1) / (a3 * a3);
      const double Q = std::sqrt(a0 - kx * ky);
      const Structure s{
          .bodies = {{.name = "rotor", .m = m, .spins = true}},
          .bearings = {test::bearing(test::body("rotor"), test::orthotropic(kx, ky, cx, cy))}};
      const CouplingStability found = coupling_stability(s, 300.0, test::body("rotor"), {});
      ASSERT_TRUE(found.at_limit);
      EXPECT_NEAR(found.at_limit->coupling, Q, exact * Q);
      EXPECT_NEAR(found.at_limit->frequency, std::sqrt(a1 / a3), exact * std::sqrt(a1 / a3));
    }
  }
}

// At Q_0 no mode of the rotor with it grows, and one neither grows nor decays.
TEST(CouplingStability, IsWhereTheFirstModeOfADiskedShaftLosesItsDamping) {
  const Structure s = test::two_disk(test::orthotropic(1e6, 1.6e6, 300.0, 500.0));
  const double Omega = 400.0;
  const CouplingStability found = coupling_stability(s, Omega, at(0.75), {});
  ASSERT_TRUE(found.at_limit);
  Structure coupled = s;
  BearingCoefficients Q;
  Q.K << 0.0, found.at_limit->coupling, -found.at_limit->coupling, 0.0;
  coupled.links.push_back(test::bearing(at(0.75), Q));
  double fastest = -INFINITY;
  for (const Mode& mode : complex_modes(assemble(coupled, Omega), 8).oscillatory) {
    fastest = std::max(fastest, mode.lambda.real() / std::abs(mode.lambda));
  }
  EXPECT_NEAR(fastest, 0.0, 1e-8);
}

// Of a large rotor not all modes are looked at. The limit does not depend on how many are.
TEST(CouplingStability, OfFewModesIsThatOfMany) {
  const Structure s = test::two_disk(test::orthotropic(1e6, 1.6e6, 300.0, 500.0), 4);
  ASSERT_GT(assemble(s, 400.0).size(), 80);
  const CouplingStability all = coupling_stability(s, 400.0, at(0.75), {.count = 16});
  ASSERT_TRUE(all.at_limit);
  for (const int count : {1, 2, 4}) {
    const CouplingStability found = coupling_stability(s, 400.0, at(0.75), {.count = count});
    ASSERT_TRUE(found.at_limit) << count;
    EXPECT_NEAR(found.at_limit->coupling, all.at_limit->coupling, 1e-6 * all.at_limit->coupling)
        << count;
  }
}

/// Where Q acts, a small body that hardly damps, faster than the modes that are looked at; beside
/// it one of unlike stiffness, and others, so that the rotor counts as large.
Structure with_a_fast_body() {
  Structure s;
  s.bodies = {{.name = "fast", .m = 0.25, .spins = true}, {.name = "slow", .m = 1.0}};
  s.bearings = {test::bearing(test::body("fast"), test::isotropic(4.0, 2e-3)),
                test::bearing(test::body("slow"), test::orthotropic(0.5, 0.51, 0.1, 0.1))};
  s.links = {test::connect(test::body("fast"), test::body("slow"), test::isotropic(0.5))};
  for (int i = 0; i < 40; ++i) {
    s.bodies.push_back({.name = "other " + std::to_string(i), .m = 1.0});
    s.bearings.push_back(
        test::bearing(test::body(s.bodies.back().name), test::isotropic(1e3 + i, 1.0)));
  }
  return s;
}

// A mode beyond those that are looked at, whose border lies between two steps along the axis, comes
// to light on the curve of decrements, where Q takes a slower mode below the speed. The limit is
// then that of all modes.
TEST(CouplingStability, AFastModeThatLacksDampingIsNotLost) {
  const Structure s = with_a_fast_body();
  const double slow = complex_modes(assemble(s, 1.0), 2).oscillatory[1].frequency();
  const double Omega = slow * (1.0 - 1e-5);
  const CouplingStability all = coupling_stability(s, Omega, test::body("fast"), {.count = 1000});
  ASSERT_TRUE(all.at_limit);
  ASSERT_GT(all.at_limit->frequency, 3.0 * slow);
  const CouplingStability found = coupling_stability(s, Omega, test::body("fast"), {.count = 2});
  ASSERT_TRUE(found.at_limit);
  EXPECT_NEAR(found.at_limit->coupling, all.at_limit->coupling, exact * all.at_limit->coupling);
}

// Without damping any cross-coupled stiffness is too much: nothing is borne, nothing is lost on the
// way.
TEST(CouplingStability, OfAnUndampedRotorIsNone) {
  const Structure s = test::two_disk(test::isotropic(1e6));
  const CouplingStability found = coupling_stability(s, 400.0, at(0.75), {.anticipated = 1e4});
  ASSERT_TRUE(found.at_anticipated);
  EXPECT_LT(found.at_anticipated->log_decrement, 0.0);
}

}  // namespace whirl::coupling_stability_test
