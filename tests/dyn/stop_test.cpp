// A flat stop, in every method that rings work in: the closed forms of the one-sided impact
// oscillator.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <complex>
#include <string>

#include "libbase/numerics/dense.hpp"
#include "libdyn/branches/bifurcation_curve.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libdyn/orbits/contact_harmonics.hpp"
#include "libdyn/system/contact_measures.hpp"
#include "libdyn/taylor/batch.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/tangents.hpp"

namespace whirl::stop_test {

using test::pi;

/// A mass on an isotropic spring beside a plane: along n a one-sided oscillator, across a free one.
///
///   m u'' + c u' + k u = U Omega^2 e - N n,   N = kC d + cC d',   d = n . (u - offset) - clearance
struct MassAtStop {
  double Omega = 10.0;
  double m = 2.0, k = 200.0, c = 0.0, U = 0.0;
  double kC = 5000.0, cC = 0.0, kH = 0.0, alpha = 0.0, mu = 0.0, R = 0.0;
  double clearance = 1e-3, angle = 2.2;
  Vec2 offset = Vec2::Zero();
  double gravity = 0.0;
  Slip slip = Slip::actual;
  double tolerance = 0.0;

  Vec2 n() const { return {std::cos(angle), std::sin(angle)}; }
  Vec2 t() const { return {-std::sin(angle), std::cos(angle)}; }
  double free() const { return std::sqrt(k / m); }
  double held() const { return std::sqrt((k + kC) / m); }

  Model model() const {
    Model s = test::MassInRing{.Omega = Omega,
                               .m = m,
                               .k = k,
                               .c = c,
                               .U = U,
                               .kC = kC,
                               .cC = cC,
                               .kH = kH,
                               .alpha = alpha,
                               .mu = mu,
                               .R = R,
                               .clearance = clearance,
                               .gravity = gravity,
                               .offset = offset}
                  .model();
    s.contacts[0].friction.slip = slip;
    s.contacts[0].friction.tolerance = tolerance;
    s.contacts[0].geometry = geometry::Stop{.angle = angle};
    return s;
  }
  Scene scene() const { return make_scene(model()); }
};

class StopInMethod : public ::testing::TestWithParam<std::string_view> {
 protected:
  test::RunOptions how() const { return {.tolerance = 1e-11, .method = method_named(GetParam())}; }
  /// Runge-Kutta in equal steps has no events: it is wrong by the square of a step at each.
  bool has_events() const { return GetParam() != "rk4"; }
  /// Of a few revolutions, in clearances. Multistep methods begin again after each event.
  double accuracy() const {
    return GetParam().starts_with("cvode") ? 1e-5 : has_events() ? 1e-7 : 1e-3;
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, StopInMethod, ::testing::ValuesIn(method_names()),
                         [](const auto& member) {
                           std::string name(member.param);
                           for (char& c : name) c = std::isalnum(c) != 0 ? c : '_';
                           return name;
                         });

/// Runs some revolutions; how far the motion is from a state then, in clearances and their rates.
double missed(const MassAtStop& p, const MotionState& start, const Vec& expected, long revolutions,
              const test::RunOptions& how, double impacts) {
  const Scene scene = p.scene();
  MotionState state = start;
  ContactMeter meter(scene.contacts);
  const Integration result = test::run(scene, state, revolutions, how, [&](const Step& step) {
    meter.add(step);
    return true;
  });
  EXPECT_EQ(result.outcome, Outcome::reached_end) << result.failure;
  EXPECT_EQ(meter.measures().at(0).impacts, impacts);
  return distance(scene.contacts, state.y, expected);
}

// Half a period on one spring, half a period on both:  T = pi / w_0 + pi / w_1, whatever the size.
TEST_P(StopInMethod, AtTheMassSwingsWithHalfThePeriodsOfTwoSprings) {
  MassAtStop p;
  p.offset = -p.clearance * p.n();  // the plane goes through the middle
  p.Omega = 2.0 * pi / (pi / p.free() + pi / p.held());
  for (const double size : {0.4, 3.0}) {
    const MotionState start = test::state_of(-size * p.clearance * p.n(), Vec2::Zero());
    EXPECT_LT(missed(p, start, start.y, 3, how(), 3.0), 3.0 * accuracy()) << size;
  }
}

// With a gap g, from the middle at a speed V = q w_0 g:
//   T = 2 asin(1 / q) / w_0 + 2 atan2(v_1 / w_1, g - x_e) / w_1 + pi / w_0,
//   v_1^2 = V^2 - (w_0 g)^2,   x_e = kC g / (k + kC)
TEST_P(StopInMethod, AcrossAGapTheMassFliesAndSwingsInArcs) {
  MassAtStop p;
  const double w0 = p.free(), w1 = p.held(), g = p.clearance;
  for (const double q : {1.05, 3.0}) {
    const double V = q * w0 * g, v1 = w0 * g * std::sqrt(q * q - 1.0);
    const double rest = p.kC * g / (p.k + p.kC);
    const double T =
        2.0 * std::asin(1.0 / q) / w0 + 2.0 * std::atan2(v1 / w1, g - rest) / w1 + pi / w0;
    p.Omega = 2.0 * pi / T;
    const MotionState start = test::state_of(Vec2::Zero(), V * p.n());
    EXPECT_LT(missed(p, start, start.y, 3, how(), 3.0), 10.0 * accuracy()) << q;
  }
}

// Across the direction of the plane nothing touches: the motion is the free one to the last digit.
TEST_P(StopInMethod, IsNotFeltAlongItself) {
  MassAtStop p;
  p.Omega = p.free();  // a revolution is its period
  const MotionState start = test::state_of(40.0 * p.clearance * p.t(), Vec2::Zero());
  EXPECT_LT(missed(p, start, start.y, 2, how(), 0.0), 40.0 * accuracy());
}

// A circle of radius U Omega^2 / |k - m Omega^2 + i c Omega| grazes the plane at U_g; the motion
// just below never touches, and is as far from it as its force; that just above does.
TEST_P(StopInMethod, IsGrazedAtTheForceThatALinearRotorSays) {
  if (!has_events() || GetParam().starts_with("arkode")) {
    GTEST_SKIP() << "its steps are longer than such a touch";
  }
  MassAtStop p;
  p.Omega = 7.0;
  p.c = 3.0;
  const Complex receptance =
      1.0 / Complex(p.k - p.m * p.Omega * p.Omega, p.c * p.Omega) * p.Omega * p.Omega;
  const double grazing = p.clearance / std::abs(receptance);
  const double beside = GetParam().starts_with("cvode") ? 1e-3 : 1e-8;
  for (const double share : {1.0 - beside, 1.0 + beside}) {
    p.U = share * grazing;
    const Complex z = p.U * receptance, rate = Complex(0.0, p.Omega) * z;
    const Scene scene = p.scene();
    MotionState state = test::state_of({z.real(), z.imag()}, {rate.real(), rate.imag()});
    const Vec start = state.y;
    if (share < 1.0) {
      EXPECT_NEAR(nearest_graze(scene, "ring", std::vector{start}).depth, share - 1.0, 1e-9);
    }
    const Integration result = test::run(scene, state, 2, how());
    EXPECT_EQ(result.outcome, Outcome::reached_end) << result.failure;
    EXPECT_EQ(result.cost.events > 0, share > 1.0) << result.cost.events;
  }
}

// A mass pressed by its weight on a belt: it is drawn along with mu g until it is as fast.
TEST_P(StopInMethod, DrawsAMassAlongUntilItSticks) {
  if (!has_events()) GTEST_SKIP() << "it does not stick";
  MassAtStop p{.Omega = 10.0, .k = 0.0, .mu = 0.3, .R = 0.05, .angle = -0.5 * pi, .gravity = 9.81};
  const double depth = p.m * p.gravity / p.kC;
  const MotionState start = test::state_of({0.0, -p.clearance - depth}, Vec2::Zero());
  const double a = p.mu * p.gravity, v = -p.Omega * p.R, T = 2.0 * pi / p.Omega;
  const double drawn = v * std::abs(v) / (2.0 * a) + v * (T - std::abs(v) / a);
  Vec expected(4);
  expected << drawn, -p.clearance - depth, v, 0.0;
  EXPECT_LT(missed(p, start, expected, 1, how(), 0.0), 1e2 * accuracy());
}

// ---- orbits
// --------------------------------------------------------------------------------------

/// exp(A t) of x'' + 2 d x' + w2 x = 0.
Mat2 flow(double d, double w2, double t) {
  const Complex s = std::sqrt(Complex(d * d - w2));
  Mat2 shifted;
  shifted << d, 1.0, -w2, -d;
  return std::exp(-d * t) *
         (std::cosh(s * t).real() * Mat2::Identity() + (std::sinh(s * t) / s).real() * shifted);
}

CVec sorted(CVec v) {
  std::sort(v.begin(), v.end(), [](Complex a, Complex b) {
    return std::abs(a.real() - b.real()) > 1e-6 ? a.real() > b.real() : a.imag() > b.imag();
  });
  return v;
}

/// x'' + 2 z x' + x = cos(w t) beside a stop: tests/dyn/damped_stop_test.cpp computes it by a
/// program of its own.
MassAtStop forced(double damping) {
  const double w = 1.3, z = 0.02;
  return {.Omega = w,
          .m = 1.0,
          .k = 1.0,
          .c = 2.0 * z,
          .U = 1.0 / (w * w),
          .kC = 25.0,
          .cC = damping,
          .clearance = 0.2,
          .angle = 0.0};
}

PeriodicOrbit orbit_of(const Scene& scene) {
  MotionState state = test::state_of(Vec2::Zero(), Vec2::Zero());
  EXPECT_EQ(test::run(scene, state, 600).outcome, Outcome::reached_end);
  return find_orbit(flow_of(scene.contacts), state.y, {.period = 1});
}

// Multipliers are those of the product of exponentials of both flows, with S = I + (f+ - f-) n^T /
// (n . f-) = [1 0; -c/m 1] where a damped stop is touched; across it those of the free mass.
TEST(Stop, HasOrbitsWithTheMultipliersOfItsTwoFlowsAndTheJumpBetweenThem) {
  for (const double damping : {0.0, 3.0}) {
    const MassAtStop p = forced(damping);
    const Scene scene = p.scene();
    const PeriodicOrbit orbit = orbit_of(scene);
    ASSERT_TRUE(orbit.is_good()) << orbit.failure;
    Mat2 M = Mat2::Identity();
    bool touched = false;
    int impacts = 0;
    MotionState state = test::state_of(orbit.states[0]);
    test::run(scene, state, 1, {.tolerance = 1e-13}, [&](const Step& step) {
      const bool touches = step.contacts[0].in_touch();
      if (touches && !touched && step.phase > 0.0) {
        M.row(1) -= p.cC / p.m * M.row(0);
        ++impacts;
      }
      touched = touches;
      const double stiff = touches ? p.k + p.kC : p.k, damped = touches ? p.c + p.cC : p.c;
      M = (flow(0.5 * damped / p.m, stiff / p.m, step.h) * M).eval();
      return true;
    });
    EXPECT_GE(impacts, 1);
    CVec expected(4);
    expected << eigenvalues(M), eigenvalues(flow(0.5 * p.c, p.k, 2.0 * pi / p.Omega));
    EXPECT_LT((sorted(orbit.multipliers) - sorted(expected)).cwiseAbs().maxCoeff(), 1e-8)
        << damping << "\n"
        << orbit.multipliers << "\n"
        << expected;
    if (damping > 0.0) {
      EXPECT_NEAR(std::abs(eigenvalues(M)(0)), 0.3961, 1e-4);  // as there
    }
  }
}

TEST(Stop, IsTheSameByHarmonicBalance) {
  MassAtStop p = forced(0.0);
  p.kC = 4.0;  // soft, so that its series is short
  const Scene scene = p.scene();
  const PeriodicOrbit exact = orbit_of(scene);
  ASSERT_TRUE(exact.is_good()) << exact.failure;
  const ContactOrbit found =
      find_harmonic_orbit(scene.contacts, exact.states[0], {.harmonics = 60});
  ASSERT_TRUE(found.orbit.is_good()) << found.orbit.failure;
  EXPECT_LT(distance(scene.contacts, found.orbit.state(), exact.states[0]), 1e-4);
  EXPECT_EQ(found.contacts.at(0).impacts, exact.contacts.at(0).impacts);
  EXPECT_NEAR(found.contacts.at(0).duty, exact.contacts.at(0).duty, 1e-4);
  EXPECT_NEAR(found.contacts.at(0).max_normal, exact.contacts.at(0).max_normal,
              1e-3 * exact.contacts.at(0).max_normal);
}

// Every kind of friction and law: forward, creeping, switching (reversals, sticking), damped,
// Hertz, damped Hertz.
TEST(Stop, HasTheTangentsOfDifferences) {
  const MassAtStop base{.Omega = 9.0, .c = 4.0, .U = 4e-3, .R = 0.01, .offset = {2e-4, -1e-4}};
  std::vector<MassAtStop> cases(6, base);
  cases[0].mu = 0.2, cases[0].slip = Slip::forward;
  cases[1].mu = 0.3, cases[1].tolerance = 0.02;
  cases[2].mu = 0.5, cases[2].R = 0.0;
  cases[3].cC = 30.0, cases[3].mu = 0.2;
  cases[4].kH = 2e5, cases[4].mu = 0.2;
  cases[5].kH = 2e5, cases[5].alpha = 10.0, cases[5].mu = 0.2;
  for (const MassAtStop& p : cases) {
    const Scene scene = p.scene();
    MotionState state = test::state_of(Vec2(1e-3, 2e-3), Vec2(0.03, -0.02));
    ASSERT_EQ(test::run(scene, state, 3).outcome, Outcome::reached_end);
    SCOPED_TRACE(&p - cases.data());
    test::expect_tangent_of_differences(scene, state.y);
  }
}

// All lanes do what one does, each with a plane, a law and a friction of its own; and those of RK4.
TEST(Stop, IsTheSameInABatch) {
  std::vector<Scene> scenes;
  std::vector<Trajectory> start;
  for (int i = 0; i < 9; ++i) {
    MassAtStop p{.Omega = 9.0, .c = 4.0, .U = 4e-3, .mu = 0.3, .R = 0.01};
    p.angle = 0.7 * i;
    p.clearance *= 1.0 + 0.1 * i;
    p.cC = i % 2 == 0 ? 20.0 : 0.0;
    p.tolerance = i % 3 == 0 ? 0.02 : 0.0;
    p.slip = i % 3 == 1 ? Slip::forward : Slip::actual;
    scenes.push_back(p.scene());
  }
  for (const Scene& scene : scenes) {
    Trajectory t{.system = &scene.contacts, .revolutions = 5};
    t.state = test::state_of(Vec2(1e-3, 2e-3), Vec2(0.03, -0.02));
    start.push_back(t);
  }
  std::vector<Trajectory> together = start, by_steps = start;
  integrate_batch(together, {.tolerance = 1e-12});
  integrate_batch_rk4(by_steps, {.fixed_step = 1e-3});
  for (std::size_t i = 0; i < start.size(); ++i) {
    SCOPED_TRACE(i);
    Trajectory alone = start[i];
    integrate_single(alone, {.tolerance = 1e-12});
    EXPECT_EQ(together[i].outcome, Outcome::reached_end) << together[i].failure;
    EXPECT_GE(alone.cost.events, 4);
    EXPECT_EQ(together[i].cost.events, alone.cost.events);
    EXPECT_LT(distance(scenes[i].contacts, together[i].state.y, alone.state.y), 1e-9);
    MotionState state = start[i].state;
    test::run(scenes[i], state, 5, {.fixed_step = 1e-3, .method = Rk4{}});
    EXPECT_LT(distance(scenes[i].contacts, by_steps[i].state.y, state.y), 1e-9);
    EXPECT_LT(distance(scenes[i].contacts, state.y, alone.state.y), 3e-2);  // it has no events
  }
}

}  // namespace whirl::stop_test
