// Closed motions of unknown period: van der Pol's, and a rotor that bounces seen from itself.

#include "libdyn/orbits/autonomous_orbit.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "libbase/error.hpp"
#include "libdyn/branches/branch_equations.hpp"
#include "libdyn/taylor/batch.hpp"
#include "tests/support/flows.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::autonomous_orbit_test {

constexpr double pi = std::numbers::pi;

/// x'' - m (1 - x^2) x' + x = 0
AutonomousFlow van_der_pol(double m) {
  const test::Equation equation{[m](double, const Vec& y, Vec& f, Mat& J) {
    f << y(1), m * (1.0 - y(0) * y(0)) * y(1) - y(0);
    J << 0.0, 1.0, -2.0 * m * y(0) * y(1) - 1.0, m * (1.0 - y(0) * y(0));
  }};
  return {Vec::Ones(2), 1.0,
          [=](const Vec& y, double time, WithTangent) -> AutonomousFlow::Result {
            AutonomousFlow::Result at{.end = y, .tangent = Mat::Identity(2, 2)};
            test::move_on(equation, 0.0, time, 60, at.end, at.tangent);
            return at;
          },
          [=](const Vec& y) {
            Vec f(2);
            Mat J(2, 2);
            equation.rates(0.0, y, f, J);
            return f;
          }};
}

// T = 2 pi (1 + m^2 / 16 - 5 m^4 / 3072 + O(m^6)), multiplier exp(-2 pi m + O(m^3)) by averaging:
// the orders of what is left are measured.
TEST(AutonomousOrbit, FindsThePeriodOfVanDerPolsEquation) {
  std::vector<double> number, period, multiplier;
  for (const double m : {0.8, 0.4, 0.2}) {
    const AutonomousOrbit cycle =
        find_autonomous_orbit(van_der_pol(m), (Vec(2) << 2.1, 0.1).finished(), 6.4);
    ASSERT_TRUE(cycle.is_good()) << cycle.failure;
    EXPECT_TRUE(cycle.is_stable());
    EXPECT_LT(cycle.residual, 1e-11);
    ASSERT_EQ(cycle.multipliers.size(), 1);
    number.push_back(1.0 / m);
    const double m2 = m * m;
    period.push_back(
        std::abs(cycle.period - 2.0 * pi * (1.0 + m2 / 16.0 - 5.0 * m2 * m2 / 3072.0)));
    multiplier.push_back(std::abs(std::log(cycle.multipliers(0).real()) + 2.0 * pi * m));
  }
  EXPECT_NEAR(test::order_of(number, period), 6.0, 0.3) << testing::PrintToString(period);
  EXPECT_NEAR(test::order_of(number, multiplier), 3.0, 0.3) << testing::PrintToString(multiplier);
}

TEST(AutonomousOrbit, SaysHowFarASearchHasComeThatFindsNone) {
  const AutonomousOrbit none =
      find_autonomous_orbit(van_der_pol(1.0), (Vec(2) << 2.0, 0.0).finished(), 6.6, 2);
  ASSERT_FALSE(none.is_good());
  ASSERT_EQ(none.residuals.size(), 3u);
  EXPECT_EQ(
      none.failure.text(),
      fmt::format("no periodic orbit: after 2 steps of Newton's method the residual is {:.1e}",
                  none.residuals.back()));
}

// Over three periods the same motion is found, and that it is one of a third.
TEST(AutonomousOrbit, KnowsTheShortestPeriod) {
  const AutonomousFlow flow = van_der_pol(1.0);
  const AutonomousOrbit once = find_autonomous_orbit(flow, (Vec(2) << 2.0, 0.0).finished(), 6.6);
  const AutonomousOrbit thrice = find_autonomous_orbit(flow, once.state, 3.0 * once.period + 1e-3);
  ASSERT_TRUE(thrice.is_good()) << thrice.failure;
  const AutonomousOrbit shortest = shorten(flow, thrice);
  EXPECT_NEAR(shortest.period, once.period, 1e-9);
  EXPECT_NEAR(shortest.multipliers(0).real(), once.multipliers(0).real(), 1e-10);
}

// Along m the period leaves 2 pi as m^2 / 16, and at m = 1 it is 6.6632868593231: found by itself,
// and at the end of a branch.
TEST(AutonomousOrbit, IsFollowedAlongAParameter) {
  Continuation walk = autonomous_continuation(van_der_pol, (Vec(2) << 2.0, 0.1).finished(), 6.3,
                                              {.low = 0.1, .high = 1.0, .first = 0.1});
  while (walk.advance()) {
  }
  const Branch& branch = walk.branch();
  EXPECT_TRUE(branch.ends_as(EndKind::range)) << branch.end_text();
  EXPECT_TRUE(branch.bifurcations.empty());
  constexpr double integrated = 1e-8;  // by 60 steps of order 8 in a period
  EXPECT_NEAR(branch.points.back().z(2), 6.6632868593231, integrated);
  for (const BranchPoint& p : branch.points) {
    EXPECT_TRUE(p.is_stable());
    EXPECT_LT(p.residual, 1e-11);
  }
}

// Gravity tells directions apart.
TEST(AutonomousOrbit, RefusesWhatIsNotIsotropic) {
  EXPECT_THROW(rotating_flow(std::make_shared<const Scene>(test::P1.scene())), NumericalError);
  EXPECT_THROW(rotating_flow(std::make_shared<const Scene>(test::MassInRing{.Omega = 0.0}.scene())),
               NumericalError);
}

}  // namespace whirl::autonomous_orbit_test
