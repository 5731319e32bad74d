// A clearance that is an ellipse, in every method that rings work in: a wall that is no circle.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "libdyn/orbits/contact_flow.hpp"
#include "libdyn/orbits/contact_harmonics.hpp"
#include "libdyn/system/clearance.hpp"
#include "libdyn/taylor/batch.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/tangents.hpp"

namespace whirl::ellipse_test {

using test::pi;

/// A mass on an isotropic spring in a ring that is out of round.
struct MassInEllipse {
  double Omega = 9.0;
  double m = 2.0, k = 200.0, c = 1.2, U = 3e-3;
  double kC = 3300.0, cC = 0.0, kH = 0.0, alpha = 0.0, mu = 0.0, R = 0.02;
  double clearance = 1e-3, angle = 0.4, aspect = 1.5;
  Vec2 offset{2e-4, -1e-4};
  double tolerance = 0.0;

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
                               .offset = offset}
                  .model();
    Friction& friction = s.contacts[0].friction;
    friction.slip = tolerance > 0.0 ? Slip::actual : Slip::forward;
    friction.tolerance = tolerance;
    s.contacts[0].geometry = geometry::Ellipse{.angle = angle, .aspect = aspect};
    return s;
  }
  Scene scene() const { return make_scene(model()); }
};

const MotionState start = test::state_of(Vec2(5e-4, 2e-4), Vec2(3e-3, -2e-3));

/// Every kind of law and friction that a wall may have: none, forward, creeping, damped, Hertz,
/// damped Hertz.
std::vector<MassInEllipse> cases() {
  std::vector<MassInEllipse> all(6);
  all[1].mu = 0.1;
  all[2].mu = 0.2, all[2].tolerance = 0.02;
  all[3].cC = 10.0, all[3].mu = 0.1;
  all[4].kH = 2e5, all[4].mu = 0.1;
  all[5].kH = 2e5, all[5].alpha = 10.0, all[5].mu = 0.2, all[5].tolerance = 0.05;
  return all;
}

/// Runs some revolutions.
MotionState after(const MassInEllipse& p, long revolutions, const test::RunOptions& how) {
  const Scene scene = p.scene();
  MotionState state = start;
  const Integration result = test::run(scene, state, revolutions, how);
  EXPECT_EQ(result.outcome, Outcome::reached_end) << result.failure;
  return state;
}

class EllipseInMethod : public ::testing::TestWithParam<std::string_view> {
 protected:
  AnyMethod method() const { return method_named(GetParam()); }
  bool has_events() const { return GetParam() != "rk4"; }
};
INSTANTIATE_TEST_SUITE_P(Methods, EllipseInMethod, ::testing::ValuesIn(method_names()),
                         [](const auto& member) {
                           std::string name(member.param);
                           for (char& c : name) c = std::isalnum(c) != 0 ? c : '_';
                           return name;
                         });

// A straight flight from the middle meets the wall at 1 / t^2 = (v_u / a)^2 + (v_v / b)^2.
TEST_P(EllipseInMethod, IsMetWhereAStraightFlightCrossesIt) {
  if (!has_events()) GTEST_SKIP() << "it has no events";
  for (const double angle : {0.0, 1.0, 2.0, 3.0}) {
    const MassInEllipse p{.k = 0.0, .c = 0.0, .U = 0.0, .offset = {0.0, 0.0}};
    const Scene scene = p.scene();
    const Vec2 v = 0.02 * Vec2(std::cos(angle), std::sin(angle));
    const double along = v(0) * std::cos(p.angle) + v(1) * std::sin(p.angle),
                 across = v(1) * std::cos(p.angle) - v(0) * std::sin(p.angle);
    const double expected = p.clearance / std::hypot(along / p.aspect, across);
    MotionState state = test::state_of(Vec2::Zero(), v);
    std::optional<double> met;
    test::run(scene, state, 1, {.tolerance = 1e-11, .method = method()}, [&](const Step& step) {
      if (!met && step.contacts[0].in_touch()) met = step.phase / scene.contacts.phase_rate();
      return !met;
    });
    ASSERT_TRUE(met) << angle;
    const double accuracy = GetParam().starts_with("cvode") ? 1e-7 : 1e-9;
    EXPECT_NEAR(*met, expected, accuracy * expected) << angle;
  }
}

// The orbit of the unbalance is a circle of radius r; it grazes the short axis where r is the
// clearance: r = U Omega^2 / m / |w_0^2 - Omega^2|.
TEST_P(EllipseInMethod, IsGrazedByACircleOfItsShortAxis) {
  MassInEllipse p{.k = 800.0, .c = 0.0, .offset = {0.0, 0.0}};
  const double grazing = p.clearance * (p.k - p.m * p.Omega * p.Omega) / (p.Omega * p.Omega);
  for (const double share : {1.0 - 1e-5, 1.0 + 1e-5}) {
    p.U = share * grazing;
    const Scene scene = p.scene();
    const double r = share * p.clearance;
    MotionState state = test::state_of(Vec2(r, 0.0), Vec2(0.0, r * p.Omega));
    bool touches = false;
    test::run(scene, state, 1, {.tolerance = 1e-12, .fixed_step = 1e-3, .method = method()},
              [&](const Step& step) {
                touches = touches || step.contacts[0].in_touch();
                return true;
              });
    EXPECT_EQ(touches, share > 1.0) << share;
  }
}

TEST_P(EllipseInMethod, AgreesWithDop853) {
  for (const MassInEllipse& p : cases()) {
    const MotionState expected = after(p, 3, {.tolerance = 1e-13, .method = Dop853{}});
    const test::RunOptions how = has_events()
                                     ? test::RunOptions{.tolerance = 1e-12, .method = method()}
                                     : test::RunOptions{.fixed_step = 1e-4, .method = method()};
    const Scene scene = p.scene();
    MotionState state = start;
    const Integration result = test::run(scene, state, 3, how);
    ASSERT_EQ(result.outcome, Outcome::reached_end) << result.failure;
    EXPECT_GE(result.cost.events, has_events() ? 4 : 0);
    const double accuracy = GetParam().starts_with("cvode") ? 1e-5 : has_events() ? 1e-7 : 1e-3;
    EXPECT_LT(distance(scene.contacts, state.y, expected.y), accuracy);
  }
}

TEST(Ellipse, OfEqualAxesIsARing) {
  for (MassInEllipse p : cases()) {
    p.aspect = 1.0;
    Model ring = p.model();
    ring.contacts[0].geometry = geometry::Ring{};
    const Scene round = make_scene(ring);
    MotionState expected = start;
    ASSERT_EQ(test::run(round, expected, 3, {.tolerance = 1e-12}).outcome, Outcome::reached_end);
    const MotionState found = after(p, 3, {.tolerance = 1e-12});
    EXPECT_LT(distance(round.contacts, found.y, expected.y), 1e-9);
  }
}

TEST(Ellipse, HasTheTangentsOfDifferences) {
  for (const MassInEllipse& p : cases()) {
    const Scene scene = p.scene();
    const MotionState state = after(p, 3, {});
    test::expect_tangent_of_differences(scene, state.y);
  }
}

// All lanes do what one does, to the last bit, each with a wall, a law and a friction of its own;
// those of RK4 to rounding.
TEST(Ellipse, IsTheSameInABatch) {
  std::vector<Scene> scenes;
  std::vector<Trajectory> begun;
  for (int i = 0; i < 9; ++i) {
    MassInEllipse p{.mu = 0.1};
    p.angle = 0.7 * i;
    p.aspect = 1.0 + 0.1 * i;
    p.clearance *= 1.0 + 0.1 * i;
    p.cC = i % 2 == 0 ? 10.0 : 0.0;
    p.tolerance = i % 3 == 0 ? 0.02 : 0.0;
    scenes.push_back(p.scene());
  }
  for (const Scene& scene : scenes) {
    Trajectory t{.system = &scene.contacts, .revolutions = 5};
    t.state = start;
    begun.push_back(t);
  }
  std::vector<Trajectory> together = begun, by_steps = begun;
  integrate_batch(together, {.tolerance = 1e-12});
  integrate_batch_rk4(by_steps, {.fixed_step = 1e-3});
  for (std::size_t i = 0; i < begun.size(); ++i) {
    SCOPED_TRACE(i);
    Trajectory alone = begun[i];
    integrate_single(alone, {.tolerance = 1e-12});
    EXPECT_EQ(together[i].outcome, Outcome::reached_end) << together[i].failure;
    EXPECT_GE(alone.cost.events, 4);
    EXPECT_EQ(together[i].cost.events, alone.cost.events);
    EXPECT_EQ(together[i].state.y, alone.state.y);
    MotionState state = begun[i].state;
    test::run(scenes[i], state, 5, {.fixed_step = 1e-3, .method = Rk4{}});
    EXPECT_LT(distance(scenes[i].contacts, by_steps[i].state.y, state.y), 1e-9);
    EXPECT_LT(distance(scenes[i].contacts, state.y, alone.state.y), 3e-2);  // it has no events
  }
}

TEST(Ellipse, IsTheSameByHarmonicBalance) {
  MassInEllipse p{.c = 40.0, .U = 8e-3, .kC = 50.0, .mu = 0.2, .tolerance = 0.05};
  const Scene scene = p.scene();
  const MotionState settled = after(p, 60, {});
  const PeriodicOrbit exact = find_orbit(flow_of(scene.contacts), settled.y, {.period = 1});
  ASSERT_TRUE(exact.is_good()) << exact.failure;
  const ContactOrbit found =
      find_harmonic_orbit(scene.contacts, exact.states[0], {.harmonics = 60});
  ASSERT_TRUE(found.orbit.is_good()) << found.orbit.failure;
  EXPECT_LT(distance(scene.contacts, found.orbit.state(), exact.states[0]), 1e-4);
  EXPECT_NEAR(found.contacts.at(0).duty, exact.contacts.at(0).duty, 1e-4);
}

// What is left of a clearance is told in the measure in which the wall is at the clearance.
TEST(Ellipse, TellsHowMuchOfItIsTaken) {
  const MassInEllipse p{.angle = 0.0, .offset = {0.0, 0.0}};
  const Model model = p.model();
  const Scene scene = p.scene();
  const auto taken = [&](double x, double y) {
    Vec full(2);
    full << x, y;
    return running_clearances(model, scene.assembler, full).at(0).distance;
  };
  EXPECT_NEAR(taken(1.5e-3, 0.0), p.clearance, 1e-15);
  EXPECT_NEAR(taken(0.0, 1e-3), p.clearance, 1e-15);
  EXPECT_NEAR(taken(0.0, 0.5e-3), 0.5 * p.clearance, 1e-15);
}

}  // namespace whirl::ellipse_test
