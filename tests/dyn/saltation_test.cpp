// Events of friction, each against what defines it: the gradient of a slip velocity against
// differences, the jump against the accelerations, the limit of sticking against a weight on a
// wall.

#include "libdyn/system/saltation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/scenes.hpp"

namespace whirl::saltation_test {

using test::MassInRing;
using test::RotorStator;

/// First order in the state: f = (y', y'').
Vec rates(const ContactSystem& system, const Vec& y, double phase, const ContactStates& states) {
  const auto n = system.coordinates();
  Vec f(2 * n);
  f.head(n) = y.tail(n);
  system.acceleration(phase, y.data(), states, f.data() + n);
  return f;
}

/// Gradient of the function whose zero is the event, in m or m/s, by central differences.
Vec gradient_by_differences(const ContactSystem& system, EventKind kind, const Vec& y) {
  const auto value = [&](const Vec& z) {
    const ContactForces f = kinematics(system.contacts()[0], z.data(), system.coordinates());
    return kind == EventKind::touch ? f.depth : f.slip;
  };
  const Vec step = 1e-6 * system.state_scale();
  Vec gradient(y.size());
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    Vec up = y, down = y;
    up(i) += step(i);
    down(i) -= step(i);
    gradient(i) = (value(up) - value(down)) / (2.0 * step(i));
  }
  return gradient;
}

/// Of a gradient: the differences are good to 1e-12 / 1e-6 and 1e-12 of the terms.
constexpr double differences = 1e-8;
constexpr double rounding = 1e-12;

/// A rotor deep in a ring about another center, turning and receding: every term of the slip
/// counts.
Vec deep(const RotorStator& p) {
  Vec y(8);
  y << 4.6e-3, 4.3e-3, 1e-4, -2e-4, 7.0, -6.0, -0.3, 0.2;
  EXPECT_GT((y.head(2) - y.segment(2, 2) - p.offset).norm(), p.gap);
  return y;
}

TEST(Saltation, HasTheGradientOfTheSlipAndTurnsOneAccelerationIntoTheOther) {
  const RotorStator p{.mu = 0.3, .ms = 20.0, .offset = {2e-4, 1e-4}};
  const Scene scene = p.scene();
  const ContactSystem& system = scene.contacts;
  Vec y = deep(p);
  const ContactStates forward{{Touch::sliding, 1.0}}, back{{Touch::sliding, -1.0}},
      stick{{Touch::sticking, 1.0}};
  system.remove_slip(y.data(), stick);
  const Event event{1.0, 0, EventKind::slip_stop};
  for (const ContactStates& after : {back, stick}) {
    const auto s = saltation(system, event, 0.3, y, forward, after);
    ASSERT_TRUE(s);
    const Vec expected = gradient_by_differences(system, event.kind, y);
    const auto scale = system.state_scale().array();
    EXPECT_LT(((s->gradient - expected).array() * scale).abs().maxCoeff(),
              differences * (expected.array() * scale).abs().maxCoeff());
    // S f- = f+, what a deviation along the motion must become
    const Vec before = rates(system, y, 0.3, forward);
    const Vec turned = before + s->jump * s->gradient.dot(before);
    const Vec f = rates(system, y, 0.3, after);
    EXPECT_LT((turned - f).norm(), rounding * f.norm());
  }
}

TEST(Saltation, HasTheGradientOfTheDepthWhereADampedContactTouches) {
  RotorStator p{.mu = 0.1, .cC = 2e4, .offset = {2e-4, 1e-4}};
  const Scene scene = p.scene();
  const ContactSystem& system = scene.contacts;
  const Vec y = deep(p);
  const ContactStates apart{{}}, touching{{Touch::sliding, 1.0}};
  const Event event{1.0, 0, EventKind::touch};
  const auto s = saltation(system, event, 0.3, y, apart, touching);
  ASSERT_TRUE(s);
  EXPECT_LT((s->gradient - gradient_by_differences(system, event.kind, y)).norm(), differences);
  const Vec before = rates(system, y, 0.3, apart), f = rates(system, y, 0.3, touching);
  EXPECT_LT((before + s->jump * s->gradient.dot(before) - f).norm(), rounding * f.norm());
  // without a speed towards the wall there is no side to come from
  Vec still = y;
  still.tail(4).setZero();
  EXPECT_FALSE(saltation(system, event, 0.3, still, apart, touching));
}

// ---- the limit of sticking ----------------------------------------------------------------------

/// A mass beside the wall of its ring, at rest against the slip: friction has to carry its weight,
/// T = -m g, and can carry mu k d.
struct OnAWall {
  double share;  ///< of mu k d that the weight takes
  MassInRing p{.Omega = 50.0, .m = 2.0, .k = 0.0, .kC = 1e6, .mu = 0.2, .R = 0.01, .gravity = 9.81};

  double depth() const { return p.m * p.gravity / (share * p.mu * p.kC); }
  Vec state() const {
    return (Vec(4) << p.clearance + depth(), 0.0, 0.0, -p.Omega * p.R).finished();
  }
};

TEST(StickLimit, IsTheFrictionCoefficientTimesTheNormalForce) {
  constexpr double near = 1e-3;  // of the limit: far above rounding, far below any margin
  const ContactStates sliding{{Touch::sliding, 1.0}};
  for (const double share : {1.0 - near, 1.0 + near}) {
    const OnAWall wall{share};
    const Scene scene = wall.p.scene();
    const Vec y = wall.state();
    const Hold hold = scene.contacts.hold(0.0, y.data(), sliding, 0);
    EXPECT_NEAR(hold.force, -wall.p.m * wall.p.gravity, 1e-9 * wall.p.m * wall.p.gravity);
    EXPECT_NEAR(std::abs(hold.force) / hold.limit, share, 1e-9);

    const ContactState expected =
        share < 1.0 ? ContactState{Touch::sticking, 1.0} : ContactState{Touch::sliding, -1.0};
    EventWatcher watcher(scene.contacts);
    ContactStates states = sliding;
    watcher.apply({1.0, 0, EventKind::slip_stop}, 0.0, y.data(), states);
    EXPECT_EQ(states[0], expected) << share;
    EXPECT_EQ(scene.contacts.classify(0.0, y.data())[0], expected) << share;
    const double margin =
        watcher.value({1.0, 0, EventKind::stick_limit}, 0.0, y.data(), {{Touch::sticking, 1.0}});
    EXPECT_EQ(margin > 0.0, share < 1.0);
  }
}

// Pressed to the bottom of a ring by its weight and shaken by its unbalance, a mass sticks and
// slips in turns. Each time it slips, friction had reached mu N, and no more, in every method.
TEST(StickLimit, IsReachedWheneverStickingEnds) {
  constexpr double located = 1e-7;  // of the limit: an event's place, to the tolerance of a step
  const MassInRing p{.Omega = 60.0,
                     .m = 1.0,
                     .k = 0.0,
                     .c = 20.0,
                     .U = 1.6e-3,
                     .kC = 1e6,
                     .mu = 0.3,
                     .clearance = 5e-3,
                     .gravity = 9.81};
  const Scene scene = p.scene();
  for (const AnyMethod& method :
       {AnyMethod(Taylor{}), AnyMethod(Dop853{}), AnyMethod(Collocation{})}) {
    MotionState state = test::state_of({0.0, -p.clearance - p.m * p.gravity / p.kC}, {0.0, 0.0});
    int slips = 0;
    bool was_stuck = false;
    double share = 0.0, largest = 0.0;
    Vec y(4);
    std::vector<ContactForces> f;
    const Integration run =
        test::run(scene, state, 20, {.tolerance = 1e-12, .method = method}, [&](const Step& step) {
          const bool sticks = step.contacts[0].touch == Touch::sticking;
          if (was_stuck && !sticks) {
            ++slips;
            EXPECT_NEAR(share, 1.0, located) << name_of_method(method);
          }
          was_stuck = sticks;
          for (const double s : {0.0, 0.5, 1.0}) {
            if (!sticks) break;
            step.at(s, y.data());
            scene.contacts.forces(step.angle(s), y.data(), step.contacts, f);
            share = std::abs(f[0].friction) / (p.mu * f[0].normal);
            largest = std::max(largest, share);
          }
          return true;
        });
    ASSERT_EQ(run.outcome, Outcome::reached_end) << run.failure;
    EXPECT_GT(slips, 10) << name_of_method(method);
    EXPECT_LT(largest, 1.0 + located) << name_of_method(method);
  }
}

}  // namespace whirl::saltation_test
