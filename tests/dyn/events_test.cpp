// Events of contacts: where the first one lies in a step that is known in closed form, what each
// function is at a state, and what becomes of a contact at its event.

#include "libdyn/system/events.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

#include "tests/support/scenes.hpp"

namespace whirl::events_test {

using test::MassInRing;

constexpr double rounding = 1e-12;   ///< of functions of order one and of their simple zeros
constexpr double of_samples = 1e-9;  ///< zeros of functions that are interpolated to 1e-12
constexpr double of_grazes = 1e-8;   ///< zeros whose slope is 1e-4: rounding over that, and more

/// A step of a duration whose displacements are polynomials of s; the velocities follow from them.
Step step_of(const ContactSystem& system, double h, const Mat& q, const ContactStates& states) {
  Step step;
  step.set(system.clock(), 0.0, h);
  step.q = q;
  step.v = Mat::Zero(q.rows(), q.cols());
  for (Eigen::Index k = 1; k < q.cols(); ++k) {
    step.v.col(k - 1) = static_cast<double>(k) / h * q.col(k);
  }
  step.contacts = states;
  return step;
}

/// Displacements of a mass, a column for each power of s.
Mat path(std::initializer_list<Vec2> powers) {
  Mat q(2, static_cast<Eigen::Index>(powers.size()));
  Eigen::Index k = 0;
  for (const Vec2& power : powers) q.col(k++) = power;
  return q;
}

/// A state of a mass.
Vec at(double x, double y, double vx, double vy) {
  return Vec{{x, y, vx, vy}};
}

const ContactStates apart{{}};
const ContactStates receding{{Touch::receding, 1.0}};
const ContactStates sliding{{Touch::sliding, 1.0}};
const ContactStates sticking{{Touch::sticking, 1.0}};

// ---- places -------------------------------------------------------------------------------------

// |p + s q| = c is a quadratic equation.
TEST(Events, LieWhereAStraightPathMeetsTheCircle) {
  const MassInRing p{.k = 0.0, .offset = {2e-4, -1e-4}};
  const Scene scene = p.scene();
  const ContactSystem& system = scene.contacts;
  const EventWatcher watcher(system);
  for (const double angle : {0.3, 2.0, 4.5}) {
    const Vec2 start{-1e-4, 3e-4}, by = 2.5e-3 * Vec2(std::cos(angle), std::sin(angle));
    const Vec2 d = start - p.offset;
    const double c = p.clearance, b = d.dot(by), q = by.squaredNorm();
    const double expected = (-b + std::sqrt(b * b - q * (d.squaredNorm() - c * c))) / q;
    ASSERT_GT(expected, 0.0);
    ASSERT_LT(expected, 1.0);
    const auto event = watcher.first(step_of(system, 1e-3, path({start, by}), apart));
    ASSERT_TRUE(event) << angle;
    EXPECT_EQ(event->kind, EventKind::touch);
    EXPECT_EQ(event->contact, 0);
    EXPECT_NEAR(event->s, expected, rounding);
    // half as far it touches nothing
    const Step shorter = step_of(system, 1e-3, path({start, 0.9 * expected * by}), apart);
    EXPECT_FALSE(watcher.first(shorter)) << angle;
  }
}

// x = c (1 + e) - a (s - 1/2)^2 is beyond the surface for 2 (c e / a)^(1/2) of the step, or never.
TEST(Events, AreNotJumpedOverWhereAPathHardlyTouches) {
  const MassInRing p{.k = 0.0};
  const Scene scene = p.scene();
  const EventWatcher watcher(scene.contacts);
  const double c = p.clearance, a = 0.4 * c;
  const auto graze = [&](double e) {
    const Mat q = path({{c * (1.0 + e) - 0.25 * a, 0.0}, {a, 0.0}, {-a, 0.0}});
    return watcher.first(step_of(scene.contacts, 1e-3, q, apart));
  };
  const double e = 1e-9;
  const auto event = graze(e);
  ASSERT_TRUE(event);
  EXPECT_NEAR(event->s, 0.5 - std::sqrt(c * e / a), of_grazes);
  EXPECT_FALSE(graze(-e));
}

// Of two rings the narrower one is touched first, whatever their order in the model.
TEST(Events, AreTheFirstOfAllContacts) {
  for (const bool wide_first : {true, false}) {
    Model m = MassInRing{.k = 0.0, .clearance = wide_first ? 1e-3 : 0.8e-3}.model();
    m.contacts.push_back(m.contacts[0]);
    m.contacts[1].clearance = wide_first ? 0.8e-3 : 1e-3;
    const Scene scene = make_scene(m);
    const EventWatcher watcher(scene.contacts);
    const Mat q = path({{0.0, 0.0}, {0.0, 2e-3}});
    const auto event = watcher.first(step_of(scene.contacts, 1e-3, q, {{}, {}}));
    ASSERT_TRUE(event);
    EXPECT_EQ(event->contact, wide_first ? 1 : 0);
    EXPECT_NEAR(event->s, 0.4, rounding);
  }
}

// Along x the depth is A s (1 - s), its rate A (1 - 2 s) / h, and with g = c / (k h)
//   N = k A (s (1 - s) + g (1 - 2 s)) = 0   =>   s = (1 - 2 g + (1 + 4 g^2)^(1/2)) / 2,
// before the depth is zero again.
TEST(Events, EndTheForceOfADampedContactBeforeItsDepth) {
  const double h = 1e-3, g = 0.25;
  const MassInRing p{.k = 0.0, .kC = 1e6, .cC = g * 1e6 * h};
  const Scene scene = p.scene();
  const EventWatcher watcher(scene.contacts);
  const double A = 0.1 * p.clearance;
  const Mat q = path({{p.clearance, 0.0}, {A, 0.0}, {-A, 0.0}});
  const auto event = watcher.first(step_of(scene.contacts, h, q, sliding));
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, EventKind::release);
  EXPECT_NEAR(event->s, 0.5 * (1.0 - 2.0 * g + std::sqrt(1.0 + 4.0 * g * g)), of_samples);
}

// In touch with its slip Omega R + y' falling along a line, it stops where that is zero.
TEST(Events, StopTheSlipWhereItIsZero) {
  const MassInRing p{.Omega = 100.0, .k = 0.0, .mu = 0.2, .R = 0.01};
  const Scene scene = p.scene();
  const EventWatcher watcher(scene.contacts);
  const double h = 1e-4, rim = p.Omega * p.R, ratio = 0.7;
  // y' = -rim s / ratio, so near y = 0 that n stays along x to a part in a thousand
  const Mat q = path({{1.1e-3, 0.0}, {0.0, 0.0}, {0.0, -0.5 * rim * h / ratio}});
  const Step step = step_of(scene.contacts, h, q, sliding);
  const auto event = watcher.first(step);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, EventKind::slip_stop);
  // bisection of the slip on the path: n = d / r
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double s = 0.5 * (low + high), y = q(1, 2) * s * s, vy = 2.0 * q(1, 2) * s / h;
    const double slip = rim + q(0, 0) * vy / std::hypot(q(0, 0), y);
    (slip > 0.0 ? low : high) = s;
  }
  EXPECT_NEAR(event->s, low, of_samples);
  EXPECT_NEAR(event->s, ratio, 1e-2);
}

// What has just happened is no event of the next step, unless that falls below the surface anew.
TEST(Events, DoNotHappenTwiceOnOneSurface) {
  const MassInRing p{.k = 0.0};
  const Scene scene = p.scene();
  const ContactSystem& system = scene.contacts;
  EventWatcher watcher(system);
  const double x = p.clearance * (1.0 + 1e-14);  // as rounding leaves it
  const Step inward = step_of(system, 1e-3, path({{x, 0.0}, {-0.5e-3, 0.0}}), apart);
  const Step outward = step_of(system, 1e-3, path({{x, 0.0}, {0.5e-3, 0.0}}), apart);
  ASSERT_TRUE(watcher.first(inward));
  EXPECT_EQ(watcher.first(inward)->s, 0.0);
  ContactStates states = sliding;
  watcher.apply({1.0, 0, EventKind::release}, 0.0, at(x, 0.0, -0.5, 0.0).data(), states);
  EXPECT_EQ(states, apart);
  EXPECT_TRUE(watcher.on_surface(0, EventKind::touch));
  EXPECT_FALSE(watcher.on_surface(0, EventKind::release));
  EXPECT_FALSE(watcher.first(inward));
  ASSERT_TRUE(watcher.first(outward));
  EXPECT_EQ(watcher.first(outward)->s, 0.0);
  watcher.moved_on();
  EXPECT_FALSE(watcher.on_surface(0, EventKind::touch));
  EXPECT_TRUE(watcher.first(inward));
}

// ---- functions ----------------------------------------------------------------------------------

double value(const EventWatcher& watcher, EventKind kind, const Vec& y,
             const ContactStates& states) {
  return watcher.value({0.0, 0, kind}, 0.0, y.data(), states);
}

TEST(Events, HaveFunctionsOfTheDistance) {
  const MassInRing p{.k = 0.0, .offset = {1e-4, 0.0}};
  const Scene scene = p.scene();
  const EventWatcher watcher(scene.contacts);
  for (const double r : {0.5, 0.999, 1.001, 1.5}) {  // in clearances from the middle
    const Vec y = at(1e-4 + 0.6 * r * p.clearance, -0.8 * r * p.clearance, 0.3, 0.2);
    const double beyond = r * r - 1.0;
    EXPECT_NEAR(value(watcher, EventKind::touch, y, apart), -beyond, rounding);
    EXPECT_NEAR(value(watcher, EventKind::part, y, receding), beyond, rounding);
    EXPECT_NEAR(value(watcher, EventKind::release, y, sliding), beyond, rounding);
  }
}

TEST(Events, HaveFunctionsOfTheForceWhereItIsDamped) {
  const MassInRing p{.k = 0.0, .kC = 1e6, .cC = 500.0};
  const Scene scene = p.scene();
  const EventWatcher watcher(scene.contacts);
  const auto both = [&](double depth, double rate) {
    const Vec y = at(p.clearance + depth, 0.0, rate, 0.0);
    const double release = value(watcher, EventKind::release, y, sliding);
    EXPECT_EQ(value(watcher, EventKind::retouch, y, receding), -release);
    return release;
  };
  const double one = both(1e-4, 0.0);  // 100 N
  EXPECT_GT(one, 0.0);
  EXPECT_NEAR(both(1e-4, 0.2), 2.0 * one, rounding);
  EXPECT_NEAR(both(1e-4, -0.3), -0.5 * one, rounding);
  EXPECT_NEAR(both(2e-4, -0.3), 0.5 * one, rounding);
}

// 1 + 1.5 alpha d', whatever the depth.
TEST(Events, HaveTheRateFactorWhereTheLawHasOne) {
  const MassInRing p{.k = 0.0, .kH = 1e9, .alpha = 0.4};
  const Scene scene = p.scene();
  const EventWatcher watcher(scene.contacts);
  for (const double depth : {1e-5, 1e-4}) {
    for (const double rate : {1.0, -1.0, -2.0}) {
      const Vec y = at(0.0, p.clearance + depth, 5.0, rate);
      const double factor = 1.0 + 1.5 * p.alpha * rate;
      EXPECT_NEAR(value(watcher, EventKind::pull, y, sliding), factor, rounding);
      EXPECT_NEAR(value(watcher, EventKind::retouch, y, receding), -factor, rounding);
    }
  }
}

TEST(Events, HaveTheSlipTimesItsSign) {
  const MassInRing p{.Omega = 100.0, .k = 0.0, .mu = 0.2, .R = 0.01};
  const Scene scene = p.scene();
  const EventWatcher watcher(scene.contacts);
  const auto of = [&](double vy, double sign) {
    return value(watcher, EventKind::slip_stop, at(1.1e-3, 0.0, 0.3, vy), {{Touch::sliding, sign}});
  };
  const double one = of(0.0, 1.0);  // slip Omega R = 1 m/s
  EXPECT_GT(one, 0.0);
  EXPECT_NEAR(of(0.5, 1.0), 1.5 * one, rounding);
  EXPECT_NEAR(of(-1.0, 1.0), 0.0, rounding);
  EXPECT_NEAR(of(-3.0, 1.0), -2.0 * one, rounding);
  EXPECT_NEAR(of(-3.0, -1.0), 2.0 * one, rounding);
}

TEST(Events, HaveTheMarginOfSticking) {
  const Scene scene = MassInRing{.mu = 0.2, .R = 0.01}.scene();
  const EventWatcher watcher(scene.contacts);
  const auto margin = [&](double force, double limit) {
    return watcher.stick_margin(0, {.force = force, .limit = limit});
  };
  const double one = margin(0.0, 1.0);
  EXPECT_GT(one, 0.0);
  EXPECT_NEAR(margin(0.0, 2.0) / one, 4.0, rounding);
  EXPECT_NEAR(margin(1.0, 2.0) / one, 3.0, rounding);
  EXPECT_NEAR(margin(-2.0, 1.0) / one, -3.0, rounding);
  EXPECT_EQ(margin(-7.0, 7.0), 0.0);
}

// ---- kinds --------------------------------------------------------------------------------------

std::vector<EventKind> kinds(const MassInRing& p, const ContactStates& states) {
  const Scene scene = p.scene();
  const EventWatcher watcher(scene.contacts);
  const auto all = watcher.kinds(0, states);
  return {all.begin(), all.end()};
}

TEST(Events, AreOfTheKindsThatAStateAndALawHave) {
  using enum EventKind;
  using Kinds = std::vector<EventKind>;
  const MassInRing plain{}, rubbing{.mu = 0.2, .R = 0.01};
  const MassInRing factor{.kH = 1e9, .alpha = 0.4, .mu = 0.2, .R = 0.01};
  EXPECT_EQ(kinds(plain, apart), Kinds{touch});
  EXPECT_EQ(kinds(plain, receding), (Kinds{retouch, part}));
  EXPECT_EQ(kinds(plain, sliding), Kinds{release});
  EXPECT_EQ(kinds(rubbing, sliding), (Kinds{release, slip_stop}));
  EXPECT_EQ(kinds(rubbing, sticking), (Kinds{release, stick_limit}));
  EXPECT_EQ(kinds(factor, sliding), (Kinds{pull, release, slip_stop}));
  EXPECT_EQ(kinds(factor, sticking), (Kinds{pull, release, stick_limit}));
}

/// Two equal rings at one place.
Model twins() {
  Model m = MassInRing{.k = 0.0, .mu = 0.2, .R = 0.01, .gravity = 9.81}.model();
  m.contacts.push_back(m.contacts[0]);
  return m;
}

TEST(Events, AskTheFirstOfContactsThatStickAlike) {
  const Scene scene = make_scene(twins());
  const EventWatcher watcher(scene.contacts);
  const ContactStates stuck{{Touch::sticking, 1.0}, {Touch::sticking, 1.0}};
  EXPECT_EQ(watcher.kinds(0, stuck).size(), 2u);
  ASSERT_EQ(watcher.kinds(1, stuck).size(), 1u);
  EXPECT_EQ(watcher.kinds(1, stuck)[0], EventKind::release);
}

// ---- what changes -------------------------------------------------------------------------------

TEST(Events, LetAContactTouchInTheSenseOfItsSlip) {
  const Scene scene = MassInRing{.Omega = 100.0, .k = 0.0, .mu = 0.2, .R = 0.01}.scene();
  for (const double vy : {-2.0, 0.5}) {  // the rim moves at 1 m/s
    EventWatcher watcher(scene.contacts);
    ContactStates states = apart;
    watcher.apply({1.0, 0, EventKind::touch}, 0.0, at(1e-3, 0.0, 0.1, vy).data(), states);
    EXPECT_EQ(states[0], (ContactState{Touch::sliding, vy < -1.0 ? -1.0 : 1.0}));
    EXPECT_TRUE(watcher.on_surface(0, EventKind::release));
    EXPECT_FALSE(watcher.on_surface(0, EventKind::slip_stop));
  }
}

TEST(Events, LetTheSecondOfTwoAlikeJoinTheFirst) {
  const Scene scene = make_scene(twins());
  for (const ContactState& first : {sticking[0], ContactState{Touch::sliding, -1.0}}) {
    EventWatcher watcher(scene.contacts);
    ContactStates states{first, {}};
    watcher.apply({1.0, 1, EventKind::touch}, 0.0, at(1e-3, 0.0, 0.1, -1.0).data(), states);
    EXPECT_EQ(states[0], first);
    EXPECT_EQ(states[1], first);
  }
}

TEST(Events, LetADampedContactRecedeBeyondItsSurfaceAndPartOnIt) {
  const MassInRing p{.k = 0.0, .cC = 500.0};
  const Scene scene = p.scene();
  EventWatcher watcher(scene.contacts);
  ContactStates states = sliding;
  const Vec beyond = at(p.clearance + 1e-4, 0.0, -0.2, 0.0), on = at(p.clearance, 0.0, -0.2, 0.0);
  watcher.apply({1.0, 0, EventKind::release}, 0.0, beyond.data(), states);
  EXPECT_EQ(states, receding);
  EXPECT_TRUE(watcher.on_surface(0, EventKind::retouch));
  watcher.apply({1.0, 0, EventKind::retouch}, 0.0, beyond.data(), states);
  EXPECT_EQ(states[0].touch, Touch::sliding);
  EXPECT_TRUE(watcher.on_surface(0, EventKind::release));
  EXPECT_FALSE(watcher.on_surface(0, EventKind::retouch));
  states = receding;
  watcher.apply({1.0, 0, EventKind::part}, 0.0, on.data(), states);
  EXPECT_EQ(states, apart);
  EXPECT_TRUE(watcher.on_surface(0, EventKind::touch));
}

// Friction carries the weight of a mass at the wall, T = -m g; where it does no longer, the mass
// falls, its slip goes below zero, and the rate of that begins at zero, too.
TEST(Events, LetWhatSticksSlipTheWayThatItIsPushed) {
  const MassInRing p{.Omega = 50.0, .k = 0.0, .mu = 0.2, .R = 0.01, .gravity = 9.81};
  const Scene scene = p.scene();
  EventWatcher watcher(scene.contacts);
  ContactStates states = sticking;
  const Vec y = at(p.clearance + 1e-5, 0.0, 0.0, -p.Omega * p.R);
  watcher.apply({1.0, 0, EventKind::stick_limit}, 0.0, y.data(), states);
  EXPECT_EQ(states[0], (ContactState{Touch::sliding, -1.0}));
  EXPECT_TRUE(watcher.on_surface(0, EventKind::slip_stop));
  EXPECT_TRUE(watcher.is_level(0, EventKind::slip_stop));
  EXPECT_FALSE(watcher.is_level(0, EventKind::release));
  watcher.moved_on();
  EXPECT_FALSE(watcher.on_surface(0, EventKind::slip_stop));
  EXPECT_FALSE(watcher.is_level(0, EventKind::slip_stop));
}

// Two alike slip at once.
TEST(Events, LetContactsThatStickAlikeSlipTogether) {
  const Scene scene = make_scene(twins());
  EventWatcher watcher(scene.contacts);
  ContactStates states{sticking[0], sticking[0]};
  const double rim = scene.contacts.contacts()[0].rim_speed;
  const Vec y = at(1e-3 + 1e-6, 0.0, 0.0, -rim);
  watcher.apply({1.0, 0, EventKind::stick_limit}, 0.0, y.data(), states);
  for (const int i : {0, 1}) {
    EXPECT_EQ(states[static_cast<std::size_t>(i)], (ContactState{Touch::sliding, -1.0}));
    EXPECT_TRUE(watcher.on_surface(i, EventKind::slip_stop));
    EXPECT_TRUE(watcher.is_level(i, EventKind::slip_stop));
  }
}

}  // namespace whirl::events_test
