// One step of collocation, against the closed form of a mass that presses into a ring along one
// line: its end, the events in it, and its dense output.

#include "libdyn/methods/contact_step.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/scenes.hpp"

namespace whirl::contact_step_test {

using test::MassInRing;

constexpr double tolerance = 1e-10;
constexpr double of_steps = 1e-8;  ///< of displacements over the clearance, of fractions of a step

/// Pressed in, at rest: x'' = -(k x + k_C (x - c)) / m swings about x_e with W.
struct Pressed {
  MassInRing p{.Omega = 100.0, .m = 1.0, .k = 1e4, .kC = 1e6, .clearance = 1e-3};
  Scene scene = p.scene();
  double W = std::sqrt((p.k + p.kC) / p.m);
  double middle = p.kC * p.clearance / (p.k + p.kC);
  double release_angle = 0.5;  ///< W t at which it is on the surface
  double amplitude = (p.clearance - middle) / std::cos(release_angle);

  MotionState start() const {
    MotionState state = test::state_of({middle + amplitude, 0.0}, {0.0, 0.0});
    state.contacts = {{Touch::sliding, 1.0}};
    return state;
  }
  double x(double t) const { return middle + amplitude * std::cos(W * t); }
  double vx(double t) const { return -amplitude * W * std::sin(W * t); }
};

TEST(ContactStep, HasALadderOfSizes) {
  const Scene scene = MassInRing{}.scene();
  const ContactStep step(scene.contacts, 0.06, tolerance);
  for (int number = 0; number < 20; ++number) {
    const double size = 0.06 * std::pow(2.0, -0.5 * number);
    EXPECT_NEAR(step.size({number}), size, 1e-14 * size);
    // the shortest that is not below
    EXPECT_EQ(step.rung_for(0.999 * size).number, number);
    EXPECT_EQ(step.rung_for(1.001 * size).number, std::max(0, number - 1));
  }
}

TEST(ContactStep, EndsWhereAPressedMassIs) {
  const Pressed mass;
  ContactStep step(mass.scene.contacts, 0.5 / mass.W, tolerance);
  const MotionState from = mass.start();
  for (const int number : {0, 1, 5}) {
    ASSERT_TRUE(step.solve({number}, from));
    EXPECT_LT(step.error(), 1.0);
    EXPECT_GT(step.evaluations(), 0);
    for (const double fraction : {0.3, 0.5, 1.0}) {
      Vec y;
      step.advance(fraction, from, y);
      const double t = fraction * step.size({number});
      const double c = mass.p.clearance;
      EXPECT_NEAR(y(0), mass.x(t), of_steps * c) << number << " " << fraction;
      EXPECT_NEAR(y(1), 0.0, of_steps * c);
      EXPECT_NEAR(y(2), mass.vx(t), of_steps * c * mass.W);
    }
  }
}

TEST(ContactStep, FindsTheReleaseWithinIt) {
  const Pressed mass;
  ContactStep step(mass.scene.contacts, 1.0 / mass.W, tolerance);
  const MotionState from = mass.start();
  const EventWatcher watcher(mass.scene.contacts);
  ASSERT_TRUE(step.solve({0}, from));
  bool is_sure = false;
  const auto event = step.first_event(watcher, 1.0, from, is_sure);
  ASSERT_TRUE(event);
  EXPECT_TRUE(is_sure);
  EXPECT_EQ(event->kind, EventKind::release);
  EXPECT_EQ(event->contact, 0);
  // an error of the path of 1e-10 clearances moves the event by that over the slope of the path,
  // amplitude sin(1/2) of 1e-2 clearances
  EXPECT_NEAR(event->s, mass.release_angle, 1e-6);
  EXPECT_LT(step.event_slope(), 0.0);
  EXPECT_FALSE(step.first_event(watcher, 0.9 * mass.release_angle, from, is_sure));
}

// Apart, x = (v / w) sin(w t) is exact, and so is when it touches.
TEST(ContactStep, FindsATouchOnAFreeFlight) {
  const MassInRing p{.Omega = 100.0, .m = 1.0, .k = 1e4, .clearance = 1e-3};
  const Scene scene = p.scene();
  const double w = std::sqrt(p.k / p.m), v = 2.0 * w * p.clearance;
  ContactStep step(scene.contacts, 1.0 / w, tolerance);
  MotionState from = test::state_of({0.0, 0.0}, {0.0, v});
  from.contacts = {{}};
  ASSERT_TRUE(step.solve({0}, from));
  EXPECT_EQ(step.error(), 0.0);
  const EventWatcher watcher(scene.contacts);
  bool is_sure = false;
  const auto event = step.first_event(watcher, 1.0, from, is_sure);
  ASSERT_TRUE(event);
  EXPECT_TRUE(is_sure);
  EXPECT_EQ(event->kind, EventKind::touch);
  EXPECT_NEAR(event->s, std::asin(0.5), of_steps);
  Vec y;
  step.advance(1.0, from, y);
  EXPECT_NEAR(y(1), v / w * std::sin(1.0), 1e-11 * p.clearance);
}

// Pieces follow one another without a gap, end where the step does, and are the closed form inside.
TEST(ContactStep, HasDenseOutputUpToItsLimit) {
  const Pressed mass;
  ContactStep step(mass.scene.contacts, 1.0 / mass.W, tolerance);
  const MotionState from = mass.start();
  ASSERT_TRUE(step.solve({0}, from));
  for (const double limit : {0.4, 1.0}) {
    double t = 0.0;
    Vec last = from.y, y(4);
    EXPECT_TRUE(step.dense(from, limit, [&](const Step& piece, const Vec& end) {
      piece.at(0.0, y.data());
      EXPECT_LT(distance(mass.scene.contacts, y, last), of_steps);
      for (const double s : {0.25, 0.6}) {
        piece.at(s, y.data());
        EXPECT_NEAR(y(0), mass.x(t + s * piece.h), of_steps * mass.p.clearance);
        EXPECT_NEAR(y(2), mass.vx(t + s * piece.h), of_steps * mass.p.clearance * mass.W);
      }
      piece.at(1.0, y.data());
      EXPECT_LT(distance(mass.scene.contacts, y, end), of_steps);
      EXPECT_NEAR(piece.phase, mass.p.Omega * t, 1e-12);
      EXPECT_NEAR(piece.turn(), mass.p.Omega * piece.h, 1e-12);
      t += piece.h;
      last = end;
      return true;
    }));
    EXPECT_NEAR(t, limit * step.size({0}), 1e-12 * step.size({0}));
    EXPECT_NEAR(last(0), mass.x(t), of_steps * mass.p.clearance);
  }
  int pieces = 0;
  EXPECT_FALSE(step.dense(from, 1.0, [&](const Step&, const Vec&) {
    ++pieces;
    return false;
  }));
  EXPECT_EQ(pieces, 1);
}

}  // namespace whirl::contact_step_test
