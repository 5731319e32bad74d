// Equations of motion with contacts against hand formulas.

#include "libdyn/system/contact_system.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "libbase/error.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::contact_system_test {

using test::MassInRing;
using test::RotorStator;

constexpr double rounding = 1e-12;  // relative, of sums of terms of different size

/// Accelerations of rotor and stator by the formulas of the rotor-stator system:
///
///   F_x = q (-d_x + s mu d_y),  F_y = q (-d_y - s mu d_x),  q = N / r,  s the sign of
///   v_t = Omega R - d_x' sin a + d_y' cos a
Vec by_hand(const RotorStator& p, const Vec& y, double phase, bool in_touch, double s) {
  const Vec2 d = y.segment<2>(0) - y.segment<2>(2) - p.offset;
  const Vec2 w = y.segment<2>(4) - y.segment<2>(6);
  const double r = d.norm();
  const double N = p.kC * (r - p.gap) + p.cC * d.dot(w) / r;
  Vec2 F = Vec2::Zero();
  if (in_touch) F = N / r * Vec2(-d(0) + s * p.mu * d(1), -d(1) - s * p.mu * d(0));
  const double U = p.mr * p.e * p.Omega * p.Omega;
  const Vec2 unbalance(U * std::cos(phase + p.phase), U * std::sin(phase + p.phase));
  const Vec2 g(0.0, -p.gravity);
  Vec a(4);
  a << (unbalance + F - p.cr * y.segment<2>(4) - p.kr * y.segment<2>(0)) / p.mr + g,
      (-F - p.cs * y.segment<2>(6) - p.ks * y.segment<2>(2)) / p.ms + g;
  return a;
}

double slip_by_hand(const RotorStator& p, const Vec& y) {
  const Vec2 d = y.segment<2>(0) - y.segment<2>(2) - p.offset;
  const Vec2 w = y.segment<2>(4) - y.segment<2>(6);
  return p.Omega * p.R + (d(0) * w(1) - d(1) * w(0)) / d.norm();
}

/// Displacements around the clearance in touch, velocities that make the slip go either way.
Vec random_state(std::mt19937& random, const RotorStator& p, double reach) {
  std::uniform_real_distribution<double> angle(0.0, 2.0 * test::pi), share(-1.0, 1.0);
  const double a = angle(random), r = reach * p.gap;
  Vec y(8);
  y.segment<2>(2) << 1e-4 * share(random), 1e-4 * share(random);
  y.segment<2>(0) = y.segment<2>(2) + p.offset + r * Vec2(std::cos(a), std::sin(a));
  for (int i = 4; i < 8; ++i) y(i) = 2.0 * p.Omega * p.R * share(random);
  return y;
}

Vec acceleration(const ContactSystem& system, double phase, const Vec& y,
                 const ContactStates& states) {
  Vec a(system.coordinates());
  system.acceleration(phase, y.data(), states, a.data());
  return a;
}

void expect_close(const Vec& a, const Vec& b) {
  EXPECT_LT((a - b).norm(), rounding * b.norm()) << a.transpose() << " | " << b.transpose();
}

// ---- forces -------------------------------------------------------------------------------------

TEST(ContactSystem, HasTheForcesOfTheRotorStatorSystemOnBothBodies) {
  std::mt19937 random(1);
  for (const Vec2& offset : {Vec2(0.0, 0.0), Vec2(3e-4, -2e-4)}) {
    for (const double cC : {0.0, 100.0}) {
      const RotorStator p{.mu = 0.3, .cC = cC, .ms = 20.0, .phase = 0.4, .offset = offset};
      const Scene scene = p.scene();
      int forward = 0, backward = 0;
      for (int trial = 0; trial < 40; ++trial) {
        const Vec y = random_state(random, p, 1.03);
        const double phase = 0.37 * trial, slip = slip_by_hand(p, y), s = slip > 0.0 ? 1.0 : -1.0;
        (slip > 0.0 ? forward : backward) += 1;
        const ContactStates states = scene.contacts.classify(phase, y.data());
        ASSERT_EQ(states[0], (ContactState{Touch::sliding, s}));
        expect_close(acceleration(scene.contacts, phase, y, states), by_hand(p, y, phase, true, s));
      }
      EXPECT_GT(forward, 5);
      EXPECT_GT(backward, 5);
    }
  }
}

TEST(ContactSystem, HasNoContactForceWithinTheClearance) {
  std::mt19937 random(2);
  const RotorStator p{.offset = {3e-4, 0.0}};
  const Scene scene = p.scene();
  for (int trial = 0; trial < 20; ++trial) {
    const Vec y = random_state(random, p, 0.99);
    const ContactStates states = scene.contacts.classify(0.1, y.data());
    ASSERT_EQ(states[0].touch, Touch::apart);
    expect_close(acceleration(scene.contacts, 0.1, y, states), by_hand(p, y, 0.1, false, 0.0));
  }
}

// Friction that always opposes the spin: s = 1; smoothed: s = tanh(v_t / tolerance).
TEST(ContactSystem, TakesForwardAndSmoothedFriction) {
  std::mt19937 random(3);
  const double tolerance = 5.0;
  for (const bool is_smooth : {false, true}) {
    RotorStator p{.mu = 0.3};
    if (is_smooth) p.slip_tolerance = tolerance;
    if (!is_smooth) p.slip = Slip::forward;
    const Scene scene = p.scene();
    for (int trial = 0; trial < 20; ++trial) {
      const Vec y = random_state(random, p, 1.02);
      const double s = is_smooth ? std::tanh(slip_by_hand(p, y) / tolerance) : 1.0;
      const ContactStates states = scene.contacts.classify(0.2, y.data());
      expect_close(acceleration(scene.contacts, 0.2, y, states), by_hand(p, y, 0.2, true, s));
    }
  }
}

// forces() splits the same force: -N n - T t on the rotor, N = k depth + c rate, T = mu N s.
TEST(ContactSystem, StatesTheForcesThatItApplies) {
  std::mt19937 random(4);
  const RotorStator p{.mu = 0.3, .cC = 100.0};
  const Scene scene = p.scene();
  std::vector<ContactForces> forces;
  for (int trial = 0; trial < 20; ++trial) {
    const Vec y = random_state(random, p, 1.02);
    const ContactStates touching = scene.contacts.classify(0.2, y.data());
    scene.contacts.forces(0.2, y.data(), touching, forces);
    const ContactForces& f = forces[0];
    EXPECT_NEAR(f.depth, 0.02 * p.gap, rounding * p.gap);
    EXPECT_NEAR(f.slip, slip_by_hand(p, y), rounding * 100.0);
    EXPECT_NEAR(f.normal, p.kC * f.depth + p.cC * f.rate, rounding * f.normal);
    EXPECT_NEAR(f.friction, p.mu * f.normal * touching[0].sign, rounding * f.normal);
    EXPECT_NEAR(f.n.dot(f.t()), 0.0, rounding);
    const ContactStates apart(1);
    const Vec with = acceleration(scene.contacts, 0.2, y, touching);
    const Vec without = acceleration(scene.contacts, 0.2, y, apart);
    const Vec2 on_rotor = -f.normal * f.n - f.friction * f.t();
    EXPECT_LT((p.mr * (with - without).head(2) - on_rotor).norm(), rounding * on_rotor.norm());
    EXPECT_LT((p.ms * (with - without).tail(2) + on_rotor).norm(), rounding * on_rotor.norm());
  }
}

// A rotor and a stator that nothing holds: what the contact gives one it takes from the other, so
// that m_r v_r + m_s v_s stays, whether the friction slides (0.005) or comes to stick (0.3).
TEST(ContactSystem, ConservesTheMomentumOfFreeBodies) {
  for (const double mu : {0.005, 0.3}) {
    const RotorStator p{.mu = mu,
                        .cC = 1e3,
                        .ms = 20.0,
                        .kr = 0.0,
                        .ks = 0.0,
                        .cr = 0.0,
                        .cs = 0.0,
                        .e = 0.0,
                        .gravity = 0.0};
    const Scene scene = p.scene();
    Vec y = Vec::Zero(8);
    y.segment<2>(4) << 3.0, 0.7;  // the rotor moves to the side and hits the ring again and again
    MotionState state = test::state_of(y);
    const Vec2 before = p.mr * y.segment<2>(4) + p.ms * y.segment<2>(6);
    bool has_stuck = false;
    const Integration result = test::run(scene, state, 2, {}, [&](const Step& step) {
      has_stuck = has_stuck || step.contacts[0].touch == Touch::sticking;
      return true;
    });
    ASSERT_EQ(result.outcome, Outcome::reached_end);
    EXPECT_GE(result.cost.events, 8);
    EXPECT_EQ(has_stuck, mu == 0.3);
    const Vec2 after = p.mr * state.y.segment<2>(4) + p.ms * state.y.segment<2>(6);
    EXPECT_LT((after - before).norm(), rounding * before.norm());
    EXPECT_GT((state.y - y).tail(4).norm(), 0.1);
  }
}

// ---- states of contacts -------------------------------------------------------------------------

TEST(ContactSystem, ClassifiesAnInstantWithoutAPast) {
  const MassInRing p{.kC = 1e6, .cC = 1e3, .mu = 0.2, .R = 0.05, .clearance = 1e-3};
  const Scene scene = p.scene();
  const auto touch = [&](double x, double vx, double vy) {
    const Vec y = (Vec(4) << x, 0.0, vx, vy).finished();
    return scene.contacts.classify(0.0, y.data())[0];
  };
  EXPECT_EQ(touch(0.9e-3, 5.0, 0.0).touch, Touch::apart);
  EXPECT_EQ(touch(1e-3, 5.0, 0.0).touch, Touch::apart);
  EXPECT_EQ(touch(1.1e-3, 1.0, 0.0), (ContactState{Touch::sliding, 1.0}));
  EXPECT_EQ(touch(1.1e-3, 1.0, -6.0), (ContactState{Touch::sliding, -1.0}));
  EXPECT_EQ(touch(1.1e-3, -1.0, 0.0).touch,
            Touch::receding);  // 1e6 1e-4 - 1e3 1 < 0: it would pull
  // v_t = Omega R + v_y = 0, and little force along t: it sticks
  EXPECT_EQ(touch(1.1e-3, 0.0, -p.Omega * p.R).touch, Touch::sticking);
}

// No slip, and along t an unbalance of 1000 N against a friction of 20 N at most: it begins to
// slide the way that it is pulled.
TEST(ContactSystem, ClassifiesWhatFrictionCannotHoldAsSlidingThatWay) {
  const MassInRing p{.U = 0.1, .kC = 1e6, .mu = 0.2, .R = 0.05, .clearance = 1e-3};
  const Scene scene = p.scene();
  const Vec y = (Vec(4) << 1.1e-3, 0.0, 0.0, -p.Omega * p.R).finished();
  const double along = 0.5 * test::pi,
               against = 1.5 * test::pi;  // phases of the unbalance, t = (0, 1)
  EXPECT_EQ(scene.contacts.classify(along, y.data())[0], (ContactState{Touch::sliding, 1.0}));
  EXPECT_EQ(scene.contacts.classify(against, y.data())[0], (ContactState{Touch::sliding, -1.0}));
}

// The equations that look only at the state are those of the contacts that it is classified to:
// apart, receding with damping, sliding either way.
TEST(ContactSystem, AcceleratesWithoutAPastAsItClassifies) {
  RotorStator p;
  p.cC = 2e4;
  const Scene scene = p.scene();
  std::mt19937 random(7);
  std::set<Touch> met;
  for (const double reach : {0.9, 1.01, 1.2}) {
    for (int i = 0; i < 30; ++i) {
      const Vec y = random_state(random, p, reach);
      const double phase = 0.1 * i;
      const ContactStates states = scene.contacts.classify(phase, y.data());
      met.insert(states[0].touch);
      Vec a(4);
      scene.contacts.acceleration(phase, y.data(), a.data());
      EXPECT_EQ(a, acceleration(scene.contacts, phase, y, states));
    }
  }
  EXPECT_EQ(met, (std::set{Touch::apart, Touch::receding, Touch::sliding}));
}

// What is left of the slip is taken away by an impulse of friction: it leaves m_r v_r + m_s v_s.
TEST(ContactSystem, RemovesTheSlipOfAStickingContact) {
  const RotorStator p{.mu = 0.3, .ms = 20.0};
  const Scene scene = p.scene();
  std::mt19937 random(5);
  Vec y = random_state(random, p, 1.02);
  const Vec before = y;
  const double slip = slip_by_hand(p, y);
  const ContactStates sticking{{Touch::sticking, 1.0}}, sliding{{Touch::sliding, 1.0}};
  scene.contacts.remove_slip(y.data(), sliding);
  EXPECT_EQ(y, before);
  scene.contacts.remove_slip(y.data(), sticking);
  EXPECT_NEAR(slip_by_hand(p, y), 0.0, rounding * std::abs(slip));
  EXPECT_EQ(y.head(4), before.head(4));
  const Vec change = y - before;
  EXPECT_LT((p.mr * change.segment<2>(4) + p.ms * change.segment<2>(6)).norm(),
            rounding * p.mr * change.norm());
  const Vec2 n = (before.segment<2>(0) - before.segment<2>(2)).normalized();
  EXPECT_NEAR(n.dot(change.segment<2>(4)), 0.0, rounding * change.norm());  // along t only
}

// ---- scales -------------------------------------------------------------------------------------

TEST(ContactSystem, MeasuresDisplacementsByTheSmallestClearance) {
  RotorStator p;
  Model model = p.model();
  model.contacts.push_back(model.contacts[0]);
  model.contacts[1].clearance = 2e-3;
  const Scene scene = make_scene(model);
  EXPECT_EQ(scene.contacts.length_scale(), 2e-3);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(scene.contacts.state_scale()(i), 2e-3, rounding);
    EXPECT_NEAR(scene.contacts.state_scale()(4 + i), 2e-3 * p.Omega, rounding);
  }
}

// Without contacts: the larger of the sag m g / k and of the whirl far above resonance, m e / m.
TEST(ContactSystem, MeasuresDisplacementsByTheLoadsWithoutContacts) {
  for (const double e : {1e-5, 1e-3}) {
    RotorStator p{.e = e};
    Model model = p.model();
    model.contacts.clear();
    const double sag = p.mr * p.gravity / p.kr;
    EXPECT_NEAR(make_scene(model).contacts.length_scale(), std::max(sag, e), 1e-9 * sag);
  }
  RotorStator unloaded{.e = 0.0, .gravity = 0.0};
  Model model = unloaded.model();
  model.contacts.clear();
  EXPECT_GT(make_scene(model).contacts.length_scale(), 0.0);
}

TEST(ContactSystem, TakesOneSecondForARevolutionWithoutSpin) {
  EXPECT_EQ(MassInRing{.Omega = 0.0}.scene().contacts.period(), 1.0);
  EXPECT_NEAR(MassInRing{.Omega = 50.0}.scene().contacts.period(), test::pi / 25.0, rounding);
}

// A massless node between two shaft elements follows the disks: no contact force can move it alone.
TEST(ContactSystem, RefusesAContactAtAStationWithoutInertia) {
  Model model;
  model.structure = test::pinned(test::massless_cylinder(0.8, 0.02, 4));
  model.structure.disks.push_back({.at = test::node(3), .m = 5.0});
  model.speed = 100.0;
  model.contacts = {
      {.name = "seal", .at = test::node(2), .clearance = 1e-3, .law = Radial<>{.k = 1e6}}};
  EXPECT_THROW(make_scene(model), ModelError);
  model.contacts[0].at = test::node(3);
  EXPECT_NO_THROW(make_scene(model));
}

}  // namespace whirl::contact_system_test
