// Cases on which integrators of contact fail: every method must get through each of them
// that it claims to handle.

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <limits>
#include <string>

#include "libdyn/motions/simulate.hpp"
#include "libfe/analyses/modes.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::hard_cases_test {

using test::MassInRing;
using test::pi;
using test::TwoDiskRub;

class HardCase : public ::testing::TestWithParam<std::string_view> {
 protected:
  AnyMethod method() const { return method_named(GetParam()); }
  test::RunOptions how(double tolerance = 1e-10) const {
    return {.tolerance = tolerance, .method = method()};
  }
  /// Allowed error of a motion of a few revolutions and dozens of events at the default tolerance,
  /// in length scales. Multistep methods begin again at order one after every event.
  double accuracy() const { return GetParam().starts_with("cvode") ? 1e-5 : 1e-7; }
};
INSTANTIATE_TEST_SUITE_P(Methods, HardCase, ::testing::ValuesIn(method_names()),
                         [](const auto& member) {
                           std::string name(member.param);
                           for (char& c : name) c = std::isalnum(c) != 0 ? c : '_';
                           return name;
                         });

/// Largest normal force of a stretch [N] and what its contact did.
ContactMeasure measure(const Scene& scene, MotionState& state, long revolutions,
                       const test::RunOptions& how) {
  ContactMeter meter(scene.contacts);
  const Integration result = test::run(scene, state, revolutions, how, [&](const Step& step) {
    meter.add(step);
    return true;
  });
  EXPECT_EQ(result.outcome, Outcome::reached_end) << result.failure;
  return meter.measures().at(0);
}

// ---- grazes -------------------------------------------------------------------------------------

// A mass on a spring, x = A cos(w t), y = 0, that reaches beyond the clearance by as little as
// 1e-11 m, and one that stays within it by as much. Where the turning point lies within a step is
// varied. SUNDIALS looks at the ends of its steps only and misses what is shorter (cvode-adams at
// 1e-7 m in 2 of 24 motions): CVODE is asked for 1e-6 m; ARKODE, whose steps are longer, and RK4,
// which has no events, are not asked.
TEST_P(HardCase, GrazesAreNeitherMissedNorInvented) {
  constexpr double gap = 1e-3, w = 100.0;
  const bool sees_ends_only = GetParam().starts_with("cvode");
  if (GetParam().starts_with("arkode") || GetParam() == "rk4") {
    GTEST_SKIP() << "its steps are longer than such a touch";
  }
  const MassInRing p{.Omega = 40.0, .k = w * w, .kC = 1e6, .clearance = gap};
  const Scene scene = p.scene();
  for (const double beyond : {1e-6, 1e-8, 1e-10, 1e-11}) {
    if (sees_ends_only && beyond < 1e-6) continue;
    for (int turn = 0; turn < 24; ++turn) {
      const double angle = 0.1 + 2.0 * pi * turn / 24.0;
      const auto events = [&](double A) {
        MotionState state =
            test::state_of({A * std::cos(angle), 0.0}, {-A * w * std::sin(angle), 0.0});
        const Integration result = test::run(scene, state, 1, how(sees_ends_only ? 1e-11 : 1e-14));
        EXPECT_EQ(result.outcome, Outcome::reached_end);
        return result.cost.events;
      };
      EXPECT_EQ(events(gap - beyond), 0) << beyond << " " << turn;
      // five half turns in a revolution, each touching and parting; contact delays the last
      EXPECT_GE(events(gap + beyond), 8) << beyond << " " << turn;
    }
  }
}

// ---- chatter ------------------------------------------------------------------------------------

// A mass falls onto a stiff, damped ring and bounces less and less until it rests on it, at the
// depth m g / k; the pull of the damper is cut off at every bounce.
TEST_P(HardCase, ChatterComesToRest) {
  const MassInRing p{
      .Omega = 100.0, .k = 0.0, .kC = 1e8, .cC = 1e3, .clearance = 1e-3, .gravity = 9.81};
  const Scene scene = p.scene();
  MotionState state = test::state_of({0.0, 0.0}, {0.0, 0.0});
  const ContactMeasure falling = measure(scene, state, 1, how());
  EXPECT_GT(falling.impacts, 1.0);
  const ContactMeasure settling = measure(scene, state, 6, how());
  EXPECT_GT(settling.impacts, 5.0);
  const ContactMeasure resting = measure(scene, state, 1, how());
  EXPECT_EQ(resting.regime(), Regime::permanent);
  EXPECT_EQ(resting.impacts, 0.0);
  EXPECT_NEAR(resting.max_normal, p.m * p.gravity, 1e-3 * p.m * p.gravity);
  EXPECT_NEAR(state.y(1), -(p.clearance + p.m * p.gravity / p.kC), 1e-4 * p.clearance);
}

// ---- stiffness ----------------------------------------------------------------------------------

// A free mass crosses the ring along a diameter, v0 everywhere within: each contact is half a
// period of the mass on the contact's spring, pi / w, and each crossing takes 2 gap / v0. With v0
// such that both last t / n together, it passes the center after n contacts with v0 again, however
// stiff the ring. The largest force is v0 w m.
TEST_P(HardCase, StiffContactsKeepTheClosedFormOfABounce) {
  constexpr int contacts = 12;
  if (GetParam() == "rk4") GTEST_SKIP() << "its steps are longer than these contacts";
  for (const double kC : {1e5, 1e7, 1e9, 1e11}) {
    const MassInRing p{.Omega = 100.0, .k = 0.0, .kC = kC};
    const Scene scene = p.scene();
    const double w = std::sqrt(kC / p.m), t = 3.0 * scene.contacts.period();
    const double v0 = 2.0 * p.clearance / (t / contacts - pi / w);
    MotionState state = test::state_of({0.0, 0.0}, {v0, 0.0});
    const ContactMeasure ring = measure(scene, state, 3, how());
    EXPECT_EQ(ring.impacts, static_cast<double>(contacts)) << kC;
    EXPECT_NEAR(state.y(0), 0.0, accuracy() * p.clearance) << kC;
    EXPECT_NEAR(state.y(2), v0, accuracy() * v0) << kC;
    EXPECT_NEAR(ring.max_normal, v0 * w * p.m, 1e-3 * v0 * w * p.m) << kC;  // at nine places a step
  }
}

// ---- sticking -----------------------------------------------------------------------------------

// Backward whirl that rolls in the ring, as at 7250 rpm: friction keeps the slip velocity zero for
// whole revolutions, and all methods make the same motion.
TEST_P(HardCase, RollingStaysLocked) {
  if (GetParam() == "rk4") GTEST_SKIP() << "it has no sticking";
  static const TwoDiskRub rotor{.speed = 7250.0 * test::rpm,
                                .start = {{.mode = 1, .amplitude = 5e-3}, {2, 5e-3, 0.0}}};
  static const Scene scene = rotor.scene();
  static const MotionState rolling = [] {
    MotionState state = test::start_of(rotor.model(), scene);
    test::run(scene, state, 100);
    return state;
  }();
  ASSERT_EQ(rolling.contacts.at(0).touch, Touch::sticking);
  MotionState state = rolling, reference = rolling;
  state.contacts.clear();  // found again from the state alone
  double slip = 0.0;
  const Integration result = test::run(scene, state, 5, how(), [&](const Step& step) {
    EXPECT_EQ(step.contacts[0].touch, Touch::sticking);
    Vec y(scene.contacts.size());
    step.at(1.0, y.data());
    slip = std::max(
        slip,
        std::abs(
            kinematics(scene.contacts.contacts()[0], y.data(), scene.contacts.coordinates()).slip));
    return true;
  });
  EXPECT_EQ(result.outcome, Outcome::reached_end);
  EXPECT_EQ(result.cost.events, 0);
  EXPECT_LT(slip, accuracy() * rotor.speed * 0.01);
  test::run(scene, reference, 5, {.tolerance = 1e-13});
  EXPECT_LT(distance(scene.contacts, state.y, reference.y), 10.0 * accuracy());
}

// ---- starts -------------------------------------------------------------------------------------

// Exactly on the surface, outward the contact begins at once, inward after a crossing, and at rest
// without load never. Each contact lasts pi / w, each crossing 2 gap / v.
TEST_P(HardCase, AStartOnTheSurfaceIsDecidedByTheVelocity) {
  const MassInRing p{.Omega = 100.0, .k = 0.0, .kC = 1e6, .clearance = 1e-3};
  const Scene scene = p.scene();
  const double period = scene.contacts.period(), contact = pi / std::sqrt(p.kC / p.m), v = 0.1;
  const double cycle = contact + 2.0 * p.clearance / v;

  MotionState outward = test::state_of({1e-3, 0.0}, {v, 0.0});
  const double more = std::floor((period - contact) / cycle);
  EXPECT_NEAR(measure(scene, outward, 1, how()).duty, (1.0 + more) * contact / period, accuracy());

  MotionState inward = test::state_of({1e-3, 0.0}, {-v, 0.0});
  const double contacts = std::floor(period / cycle);
  EXPECT_NEAR(measure(scene, inward, 1, how()).duty, contacts * contact / period, accuracy());

  MotionState resting = test::state_of({1e-3, 0.0}, {0.0, 0.0});
  EXPECT_EQ(measure(scene, resting, 1, how()).duty, 0.0);
  EXPECT_EQ(resting.y(0), 1e-3);
}

// At rest on the surface under gravity: it sinks in at once and oscillates about the depth m g / k,
// within twice that, never parting but at the top of a swing.
TEST_P(HardCase, AStartAtRestOnTheSurfaceSinksIn) {
  const MassInRing p{.Omega = 100.0, .k = 0.0, .kC = 1e6, .clearance = 1e-3, .gravity = 9.81};
  const Scene scene = p.scene();
  MotionState state = test::state_of({0.0, -1e-3}, {0.0, 0.0});
  const ContactMeasure ring = measure(scene, state, 2, how());
  EXPECT_NEAR(ring.max_normal, 2.0 * p.m * p.gravity, 1e-3 * p.m * p.gravity);
  EXPECT_GT(ring.duty, 0.99);
  const double w = std::sqrt(p.kC / p.m), t = 2.0 * scene.contacts.period();
  const double depth = p.m * p.gravity / p.kC * (1.0 - std::cos(w * t));
  EXPECT_NEAR(state.y(1), -(p.clearance + depth), accuracy() * p.clearance);
}

// r = 0 has no direction: forces and slip are finite there, whether the mass rests or moves
// through.
TEST_P(HardCase, TheCenterIsAnOrdinaryPlace) {
  const MassInRing p{.Omega = 100.0, .k = 1e4, .U = 1e-6, .mu = 0.2, .R = 0.01};
  const Scene scene = p.scene();
  for (const double v : {0.0, 0.05}) {
    MotionState state = test::state_of({0.0, 0.0}, {v, 0.0});
    EXPECT_EQ(test::run(scene, state, 3, how()).outcome, Outcome::reached_end);
    EXPECT_TRUE(state.y.allFinite());
    EXPECT_GT(state.y.norm(), 0.0);
  }
}

// ---- linear extremes ----------------------------------------------------------------------------

// Nothing holds the mass: under its unbalance U it moves as x = (U / m) (1 - cos(Omega t)),
// y = (U / m) (Omega t - sin(Omega t)): it drifts by 2 pi U / m in a revolution.
TEST_P(HardCase, AFreeBodyDrifts) {
  const MassInRing p{.k = 0.0, .U = 1e-6, .clearance = 1e-3};
  const Scene scene = p.scene();
  MotionState state = test::state_of({0.0, 0.0}, {0.0, 0.0});
  EXPECT_EQ(test::run(scene, state, 20, how()).outcome, Outcome::reached_end);
  EXPECT_NEAR(state.y(0), 0.0, accuracy() * p.clearance);
  EXPECT_NEAR(state.y(1), 20.0 * 2.0 * pi * 1e-6, accuracy() * p.clearance);
}

// Overdamped, c = 50 sqrt(k m): roots -a and -b of s^2 + (c/m) s + k/m, far apart; from x0 at rest
// x = x0 (b e^(-a t) - a e^(-b t)) / (b - a).
TEST_P(HardCase, AnOverdampedModeCreeps) {
  const double k = 1e4, c = 50.0 * std::sqrt(k), x0 = 5e-4;
  const MassInRing p{.k = k, .c = c};
  const Scene scene = p.scene();
  MotionState state = test::state_of({x0, 0.0}, {0.0, 0.0});
  EXPECT_EQ(test::run(scene, state, 10, how()).outcome, Outcome::reached_end);
  const double root = std::sqrt(0.25 * c * c - k), b = 0.5 * c + root, a = k / b;
  const double t = 10.0 * scene.contacts.period();
  const double x = x0 * (b * std::exp(-a * t) - a * std::exp(-b * t)) / (b - a);
  EXPECT_NEAR(state.y(0), x, accuracy() * p.clearance);
}

// ---- long times ---------------------------------------------------------------------------------

// Time is a revolution and a phase: after a million revolutions a motion goes on as at the start,
// bit by bit, for any method.
TEST_P(HardCase, AMillionRevolutionsLoseNoPhase) {
  const MassInRing p{.U = 5e-6, .kC = 1e5, .mu = 0.1, .R = 0.01};
  const Scene scene = p.scene();
  MotionState early = test::state_of({8e-4, 0.0}, {0.0, 0.3}), late = early;
  late.revolution = 1'000'000;
  test::run(scene, early, 5, how());
  test::run(scene, late, 5, how());
  EXPECT_EQ(late.revolution - early.revolution, 1'000'000);
  EXPECT_EQ(early.phase, 0.0);
  EXPECT_EQ(early.y, late.y);
}

// And integrated: the answer to the unbalance after 5000 revolutions has the phase of the closed
// form z = (U/m) Omega^2 / (k/m - Omega^2 + i Omega c/m) e^(i Omega t).
TEST(LongTime, TheUnbalanceResponseKeepsItsPhase) {
  const MassInRing p{.Omega = 100.0, .k = 2e4, .c = 20.0, .U = 1e-5};
  const Scene scene = p.scene();
  MotionState state = test::state_of({0.0, 0.0}, {0.0, 0.0});
  test::run(scene, state, 5'000, {.tolerance = 1e-8});
  const Complex z = p.U * p.Omega * p.Omega / Complex(p.k - p.m * p.Omega * p.Omega, p.Omega * p.c);
  EXPECT_NEAR(std::arg(Complex(state.y(0), state.y(1)) / z), 0.0, 1e-5);
  EXPECT_NEAR(std::abs(Complex(state.y(0), state.y(1)) / z), 1.0, 1e-5);
}

// ---- failure ------------------------------------------------------------------------------------

// A system without bound, k < 0: x grows as e^(w t) until it is no number any more. The report says
// when, which contact, and in which state, and the state is the last good one.
TEST_P(HardCase, OverflowIsReportedWithTimeContactAndState) {
  MassInRing p{.Omega = 10.0, .clearance = 1e-3};
  Model model = p.model();
  model.structure.bearings = {test::bearing(test::body("mass"), test::isotropic(-1e6))};
  model.contacts[0].law = Radial<>{.k = 1.0};
  const Scene scene = make_scene(model);
  MotionState state = test::state_of({5e-4, 0.0}, {0.0, 0.0});
  const Integration result = test::run(scene, state, 100, how(1e-4));
  EXPECT_NE(result.outcome, Outcome::reached_end);
  EXPECT_NE(result.outcome, Outcome::stopped_by_observer);
  EXPECT_TRUE(state.y.allFinite());
  EXPECT_GT(state.revolution + state.phase, 0.0);
  for (const char* word : {"revolution", "ring", "sliding", "clearances"}) {
    EXPECT_NE(result.failure.text().find(word), std::string::npos) << result.failure;
  }
}

}  // namespace whirl::hard_cases_test
