// What must not change the motion: the direction of the axes, the sense of time, the time since
// the start.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "tests/support/scenes.hpp"

namespace whirl::invariance_test {

using test::RotorStator;

/// Both bodies' displacements and velocities turned by an angle.
Vec turned(const Vec& y, double angle) {
  const Mat2 Q = Eigen::Rotation2Dd(angle).toRotationMatrix();
  Vec z(8);
  for (int i = 0; i < 8; i += 2) z.segment<2>(i) = Q * y.segment<2>(i);
  return z;
}

// Without gravity no direction is special: the start and the unbalance turned by an angle turn the
// motion by that angle. Steps are chosen from components and differ, so the tolerance decides.
TEST(Invariance, TurningStartAndUnbalanceTurnsTheMotion) {
  constexpr double accurate = 1e-9;  // tolerance 1e-13, grown over 10 revolutions of impacts
  const Vec start = (Vec(8) << 5e-3, 1e-3, 1e-4, 0.0, 0.3, -0.8, 0.0, 0.1).finished();
  const auto end_of = [&](double angle) {
    RotorStator p = test::P1;
    p.gravity = 0.0;
    p.phase = 0.4 + angle;
    const Vec2 offset(3e-4, 1e-4);
    p.offset = Eigen::Rotation2Dd(angle) * offset;
    const Scene scene = p.scene();
    MotionState state = test::state_of(turned(start, angle));
    const Integration result = test::run(scene, state, 10, {.tolerance = 1e-13});
    EXPECT_GT(result.cost.events, 20);
    return std::pair{state.y, scene.contacts.state_scale()};
  };
  const auto [y, scale] = end_of(0.0);
  for (const double angle : {0.3, test::pi / 2.0, 2.0, 4.0}) {
    const Vec difference = end_of(angle).first - turned(y, angle);
    EXPECT_LT((difference.array() / scale.array()).abs().maxCoeff(), accurate) << angle;
  }
}

/// (x, y, x', y') to (-x, y, x', -y'): mirrored in the y axis, and backward in time.
Vec mirrored(const Vec& y) {
  const Vec signs = (Vec(8) << -1, 1, -1, 1, 1, -1, 1, -1).finished();
  return signs.cwiseProduct(y);
}

// A mirror alone makes the unbalance turn backward, which no rotor does. With time reversed as well
// it turns forward again, from the phase pi - p: without damping and friction the mirrored end
// leads back to the mirrored start, through the same impacts, gravity and all.
TEST(Invariance, MirroredAndBackwardInTimeTheMotionRetracesItself) {
  constexpr double accurate = 1e-8;  // tolerance 1e-13, grown over 8 revolutions there and back
  RotorStator p{.mu = 0.0, .cr = 0.0, .cs = 0.0, .phase = 0.4, .offset = {3e-4, 1e-4}};
  const Scene there = p.scene();
  const Vec start = (Vec(8) << 5e-3, 1e-3, 1e-4, 0.0, 0.3, -0.8, 0.0, 0.1).finished();
  MotionState state = test::state_of(start);
  const Integration out = test::run(there, state, 4, {.tolerance = 1e-13});
  EXPECT_GT(out.cost.events, 10);
  EXPECT_GT(distance(there.contacts, state.y, start), 0.1);

  p.phase = test::pi - p.phase;
  p.offset(0) = -p.offset(0);
  const Scene back = p.scene();
  MotionState returning = test::state_of(mirrored(state.y));
  const Integration home = test::run(back, returning, 4, {.tolerance = 1e-13});
  EXPECT_EQ(home.cost.events, out.cost.events);
  EXPECT_LT(distance(back.contacts, returning.y, mirrored(start)), accurate);
}

// A free mass in a ring moves the same when ring and mass are moved together. It flies at 0.2 m/s
// and its surface turns at 0.01 m/s, so that the direction of flight decides the sense of slip.
TEST(Invariance, MovingTheRingMovesTheMotion) {
  test::MassInRing p{.Omega = 100.0, .k = 0.0, .kC = 1e6, .mu = 0.2, .R = 1e-4};
  const Scene middle = p.scene();
  p.offset = {3e-4, 5e-4};
  const Scene aside = p.scene();
  const Vec shift = (Vec(4) << p.offset, 0.0, 0.0).finished();
  for (int k = 0; k < 12; ++k) {
    const double angle = 2.0 * test::pi * k / 12;
    const Vec y = (Vec(4) << 4e-4, -2e-4, 0.2 * std::cos(angle), 0.2 * std::sin(angle)).finished();
    MotionState a = test::state_of(y), b = test::state_of(Vec(y + shift));
    const Integration run = test::run(middle, a, 1);
    EXPECT_GT(run.cost.events, 4) << k;
    EXPECT_EQ(test::run(aside, b, 1).cost.events, run.cost.events) << k;
    EXPECT_LT(distance(middle.contacts, Vec(b.y - shift), a.y), 1e-7) << k;
  }
}

// Time is a revolution and a phase within it: a million revolutions later the same motion happens,
// to the last bit.
TEST(Invariance, TheTimeSinceTheStartDoesNotMatter) {
  for (const AnyMethod& method :
       {AnyMethod(Dop853{}), AnyMethod(CvodeAdams{}), AnyMethod(CvodeBdf{})}) {
    const Scene scene = test::P1.scene();
    MotionState early = test::start_of(test::P1.model(), scene), late = early;
    late.revolution = 1'000'000;
    const Integration first = test::run(scene, early, 10, {.method = method});
    const Integration second = test::run(scene, late, 10, {.method = method});
    EXPECT_EQ(early.y, late.y);
    EXPECT_EQ(early.contacts, late.contacts);
    EXPECT_EQ(late.revolution, 1'000'010);
    EXPECT_EQ(first.cost.steps, second.cost.steps);
    EXPECT_EQ(first.cost.events, second.cost.events);
    EXPECT_GT(first.cost.events, 10);
  }
}

// Ten revolutions at once, or one by one: a motion may be interrupted at the ends of revolutions.
// The step size is found anew at each start, so the tolerance decides.
TEST(Invariance, AMotionMayBeInterruptedAtRevolutions) {
  constexpr double accurate = 1e-7;  // tolerance 1e-10, grown over 10 revolutions of impacts
  const Scene scene = test::P1.scene();
  MotionState whole = test::start_of(test::P1.model(), scene), pieces = whole;
  test::run(scene, whole, 10);
  for (int i = 0; i < 10; ++i) test::run(scene, pieces, 1);
  EXPECT_EQ(pieces.revolution, 10);
  EXPECT_LT(distance(scene.contacts, whole.y, pieces.y), accurate);
}

// The steady motion of coordinates does not depend on how they are called: bodies in another order.
TEST(Invariance, TheOrderOfBodiesDoesNotMatter) {
  constexpr double accurate = 1e-9;
  const Scene scene = test::P3.scene();
  Model swapped = test::P3.model();
  std::swap(swapped.structure.bodies[0], swapped.structure.bodies[1]);
  const Scene other = make_scene(swapped);
  MotionState a = test::start_of(test::P3.model(), scene), b = test::start_of(swapped, other);
  test::run(scene, a, 100);
  test::run(other, b, 100);
  EXPECT_LT((a.y.segment<2>(0) - b.y.segment<2>(2)).norm(), accurate * test::P3.gap);
  EXPECT_LT((a.y.segment<2>(2) - b.y.segment<2>(0)).norm(), accurate * test::P3.gap);
}

}  // namespace whirl::invariance_test
