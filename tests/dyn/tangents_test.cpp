// Tangents: against differences of motions, known multipliers, and the divergence of the flow.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "libbase/numerics/dense.hpp"
#include "libdyn/taylor/batch.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::tangents_test {

using test::MassInRing;
using test::RotorStator;

Trajectory integrated(const ContactSystem& system, const MotionState& start, long revolutions,
                      const BatchOptions& options) {
  Trajectory t{.system = &system, .state = start, .revolutions = revolutions};
  integrate_single(t, options);
  EXPECT_EQ(t.outcome, Outcome::reached_end) << t.failure;
  return t;
}

/// Largest difference of the tangent from central differences, in scaled coordinates.
double difference(const ContactSystem& system, const MotionState& start, long revolutions) {
  constexpr double h = 1e-7;  // of a scale: 1e-14 / h of rounding, h^2 of curvature
  const Mat tangent =
      integrated(system, start, revolutions, {.tolerance = 1e-13, .tangent = true}).tangent;
  const Vec& scale = system.state_scale();
  double worst = 0.0;
  for (int i = 0; i < system.size(); ++i) {
    MotionState up = start, down = start;
    up.y(i) += h * scale(i);
    down.y(i) -= h * scale(i);
    const Vec change = integrated(system, up, revolutions, {.tolerance = 1e-14}).state.y -
                       integrated(system, down, revolutions, {.tolerance = 1e-14}).state.y;
    const Vec scaled = (change / (2.0 * h) - tangent.col(i) * scale(i)).cwiseQuotient(scale);
    worst = std::max(worst, scaled.cwiseAbs().maxCoeff());
  }
  return worst;
}

struct Case {
  const char* name;
  RotorStator rotor;
  int settle;       ///< revolutions before
  int revolutions;  ///< of the tangent
  double bound;     ///< tens of what differences allow for
};

RotorStator changed(RotorStator p, double cC, double slip_tolerance) {
  p.cC = cC;
  p.slip_tolerance = slip_tolerance;
  return p;
}

RotorStator with_hertz_contact(RotorStator p, double alpha = 0.0) {
  p.kH = 1.5e10;  // as stiff as P1 at 0.1 mm
  p.alpha = alpha;
  return p;
}

class Tangent : public ::testing::TestWithParam<Case> {};
const RotorStator rolling{.Omega = 151.8462, .kC = 3.07445e6, .mu = 0.2625};
INSTANTIATE_TEST_SUITE_P(
    Motions, Tangent,
    ::testing::Values(Case{"five_impacts", test::P1, 400, 1, 1e-6},
                      Case{"permanent_contact", test::P3, 400, 1, 1e-5},
                      Case{"damped_contact", changed(test::P1, 2e4, 0.0), 400, 1, 1e-6},
                      Case{"heavily_damped_contact", changed(test::P1, 2e5, 0.0), 400, 1, 1e-5},
                      Case{"hertz_contact", with_hertz_contact(test::P1), 400, 1, 1e-6},
                      Case{"damped_hertz_contact", with_hertz_contact(test::P1, 2.0), 400, 1, 1e-6},
                      Case{"smoothed_friction", changed(test::P1, 0.0, 1.0), 400, 1, 1e-6},
                      Case{"smoothed_rolling", changed(rolling, 0.0, 0.1), 100, 1, 1e-5},
                      Case{"smoothed_friction_damped", changed(rolling, 1e3, 0.3), 20, 2, 1e-5},
                      Case{"into_rolling", rolling, 30, 3, 1e-6},
                      Case{"damped_into_rolling", changed(rolling, 2e3, 0.0), 30, 3, 1e-5}),
    [](const auto& member) { return member.param.name; });

TEST_P(Tangent, IsTheLimitOfDifferences) {
  const Case& c = GetParam();
  const Scene scene = c.rotor.scene();
  MotionState state = test::start_of(c.rotor.model(), scene);
  test::run(scene, state, c.settle, {.tolerance = 1e-12});
  EXPECT_LT(difference(scene.contacts, state, c.revolutions), c.bound);
}

// While a contact rolls, friction is whatever keeps it rolling, in deviations too: those with slip
// are not motions near by, so differences are taken along the others only.
TEST(RollingTangent, IsTheLimitOfDifferencesAlongRollingMotions) {
  const Scene scene = rolling.scene();
  const ContactSystem& system = scene.contacts;
  MotionState state = test::start_of(rolling.model(), scene);
  test::run(scene, state, 100, {.tolerance = 1e-12});
  ASSERT_EQ(state.contacts[0].touch, Touch::sticking);
  const Mat tangent = integrated(system, state, 1, {.tolerance = 1e-13, .tangent = true}).tangent;
  const Vec& scale = system.state_scale();
  constexpr double h = 1e-6;
  for (int i = 0; i < 8; ++i) {
    MotionState up = state, down = state;
    up.y(i) += h * scale(i);
    down.y(i) -= h * scale(i);
    system.remove_slip(up.y.data(), up.contacts);
    system.remove_slip(down.y.data(), down.contacts);
    const Vec direction = (up.y - down.y) / (2.0 * h);
    const Vec change = integrated(system, up, 1, {.tolerance = 1e-14}).state.y -
                       integrated(system, down, 1, {.tolerance = 1e-14}).state.y;
    const Vec scaled = (change / (2.0 * h) - tangent * direction).cwiseQuotient(scale);
    EXPECT_LT(scaled.cwiseAbs().maxCoeff(), 1e-6) << i;
  }
}

/// From the tangent in scaled coordinates: in raw ones, solvers without balancing lose six digits.
Vec floquet_exponents(const ContactSystem& system, const Mat& tangent) {
  const auto scale = system.state_scale().asDiagonal();
  const Mat scaled = scale.inverse() * tangent * scale;
  Vec rates = eigenvalues(scaled).cwiseAbs().array().log() / system.period();
  std::sort(rates.begin(), rates.end(), std::greater<>());
  return rates;
}

// Pairs of the reference point P1, known to seven digits from another code.
TEST(Floquet, ExponentsOfFiveImpactsAreTheKnownOnes) {
  const Scene scene = test::P1.scene();
  MotionState state = test::start_of(test::P1.model(), scene);
  test::run(scene, state, 400, {.tolerance = 1e-13});  // settled to rounding
  const Trajectory t = integrated(scene.contacts, state, 1, {.tolerance = 1e-13, .tangent = true});
  const Vec exponents = floquet_exponents(scene.contacts, t.tangent);
  const double known[] = {-2.944044, -2.944044, -3.473444, -3.473444,
                          -20.979,   -20.979,   -32.203,   -32.203};
  for (int i = 0; i < 8; ++i) EXPECT_NEAR(exponents(i), known[i], i < 4 ? 1e-6 : 1e-3) << i;
  EXPECT_NEAR(exponents.sum(), t.divergence, 1e-8);
  EXPECT_NEAR(t.divergence, -2.0 * 280.0 / 50.0 - 2.0 * 2700.0 / 50.0, 1e-10);
}

// Without the jump of the tangent at every touch, the sum of the exponents is the same and the
// exponents are wrong: a mass that bounces on a damped stop, one revolution of its unbalance.
TEST(Floquet, MultipliersOfADampedContactNeedSaltation) {
  RotorStator p = test::P1;
  p.cC = 2e4;
  const Scene scene = p.scene();
  MotionState state = test::start_of(p.model(), scene);
  test::run(scene, state, 2000);
  const Trajectory t = integrated(scene.contacts, state, 1, {.tolerance = 1e-13, .tangent = true});
  EXPECT_GT(t.cost.events, 5);
  const double log_determinant = std::log(std::abs(t.tangent.determinant()));
  EXPECT_NEAR(log_determinant, t.divergence * scene.contacts.period(), 1e-8);
  EXPECT_LT(t.divergence, -120.0);  // the damping of the contact is in it
}

// Sum of all exponents = divergence, which is -2 c_r / m_r - 2 c_s / m_s in every motion.
TEST(Lyapunov, ExponentsAddUpToTheDivergence) {
  constexpr double relative = 1e-8;
  for (const RotorStator& p : {test::P1, test::P2, test::P3, test::P4}) {
    const Scene scene = p.scene();
    MotionState state = test::start_of(p.model(), scene);
    test::run(scene, state, 50);
    const Trajectory t = integrated(scene.contacts, state, 100, {.exponents = true});
    EXPECT_NEAR(t.divergence, -119.2, 1e-9);
    EXPECT_NEAR(t.exponents.sum(), -119.2, relative * 119.2);
    EXPECT_TRUE(std::is_sorted(t.exponents.begin(), t.exponents.end(), std::greater<>()));
  }
}

// The largest exponents do not depend on whether smaller ones are computed: bit by bit, alone and
// in lanes.
TEST(Lyapunov, TheLargestExponentsNeedNoOthers) {
  constexpr long revolutions = 12;
  const Scene scene = test::P4.scene();
  MotionState state = test::start_of(test::P4.model(), scene);
  test::run(scene, state, 100);
  const auto growths = [&](int most, std::size_t together) {
    std::vector<Trajectory> all(
        together, {.system = &scene.contacts, .state = state, .revolutions = revolutions});
    const BatchOptions options{
        .threads = 1, .exponents = true, .most_exponents = most, .growths = true};
    together == 1 ? integrate_single(all[0], options) : integrate_batch(all, options);
    EXPECT_EQ(all.back().exponents.size(), most > 0 ? most : 8);
    EXPECT_NEAR(all.back().divergence, -119.2, 1e-9);
    return Mat(Eigen::Map<const Mat>(all.back().growths.data(), most > 0 ? most : 8, revolutions));
  };
  for (const std::size_t together : {1u, 5u}) {
    const Mat all = growths(0, together);
    for (const int most : {1, 2, 3}) EXPECT_EQ(growths(most, together), all.topRows(most)) << most;
  }
}

// A linear rotor: exponents are the real parts of its eigenvalues, here -delta four times, and for
// an overdamped one -delta +- sqrt(delta^2 - w^2).
TEST(Lyapunov, ExponentsOfALinearRotorAreThoseOfItsEigenvalues) {
  const MassInRing under{.Omega = 100.0, .m = 2.0, .k = 2e4, .c = 8.0, .clearance = 1.0};
  const MassInRing over{.Omega = 100.0, .m = 2.0, .k = 2e4, .c = 1000.0, .clearance = 1.0};
  for (const bool is_over : {false, true}) {
    const Scene scene = (is_over ? over : under).scene();
    const Trajectory t = integrated(scene.contacts, test::state_of(Vec2(0.1, 0.0), Vec2(0.0, 3.0)),
                                    200, {.exponents = true});
    const double delta = (is_over ? 1000.0 : 8.0) / 4.0;
    const double root = is_over ? std::sqrt(delta * delta - 1e4) : 0.0;
    for (int i = 0; i < 4; ++i) {
      const double expected = i < 2 ? -delta + root : -delta - root;
      EXPECT_NEAR(t.exponents(i), expected, is_over ? 0.1 : 0.05) << i;  // 1 / time
    }
    EXPECT_NEAR(t.exponents.sum(), -4.0 * delta, 1e-6 * delta);
  }
}

// Bouncing at 151 rad/s with much friction is weakly chaotic: an exponent just above what averaging
// over this time can tell from zero, and the same for a rough and a fine tolerance.
TEST(Lyapunov, OfAWeaklyChaoticMotionDoesNotDependOnTheTolerance) {
  const Scene scene = test::P4.scene();
  MotionState state = test::start_of(test::P4.model(), scene);
  test::run(scene, state, 500);
  const double time = 500.0 * scene.contacts.period();
  double largest[2];
  for (const int i : {0, 1}) {
    largest[i] = integrated(scene.contacts, state, 500,
                            {.tolerance = i == 0 ? 1e-8 : 1e-11, .exponents = true})
                     .exponents(0);
    EXPECT_GT(largest[i], 0.5 / time);
  }
  EXPECT_NEAR(largest[0], largest[1], 1e-2 * largest[1]);
}

}  // namespace whirl::tangents_test
