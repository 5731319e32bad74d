// Where rotors lie at rest: closed forms, and no acceleration.

#include "libdyn/motions/equilibrium.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "libbase/error.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::equilibrium_test {

using test::MassInRing;

constexpr double weight = 9.81;  // of a mass of 1 kg [N]

double sag(const MassInRing& p) {
  const Vec eta = equilibrium(p.scene().contacts);
  EXPECT_NEAR(eta(0), 0.0, 1e-15);
  return -eta(1);
}

TEST(Equilibrium, IsTheLinearSagWithinTheClearance) {
  EXPECT_NEAR(sag({.k = 1e4, .clearance = 1e-3, .gravity = 9.81}), weight / 1e4, 1e-15);
}

// k y + k_C (y - c) = m g
TEST(Equilibrium, SharesTheWeightBetweenSpringAndRing) {
  for (const double kC : {1e4, 1e7, 1e11}) {
    const double found = sag({.k = 1e4, .kC = kC, .clearance = 0.5e-3, .gravity = 9.81});
    EXPECT_NEAR(found, (weight + kC * 0.5e-3) / (1e4 + kC), 1e-12 * found) << kC;
  }
}

// k y + k_H (y - c)^1.5 = m g
TEST(Equilibrium, OnAHertzContact) {
  const double y = sag({.k = 1e4, .kH = 1e8, .clearance = 0.5e-3, .gravity = 9.81});
  EXPECT_NEAR(1e4 * y + 1e8 * std::pow(y - 0.5e-3, 1.5), weight, 1e-9 * weight);
}

// A ring off center pushes sideways, too; a shaft of eight modes lies on its ring. Nothing moves.
TEST(Equilibrium, LeavesNoAcceleration) {
  MassInRing p{.k = 1e4, .clearance = 0.5e-3, .gravity = 9.81};
  p.offset = {3e-4, 1e-4};
  test::TwoDiskRub rotor{.mu = 0.0, .gravity = 9.81 * 200.0};
  Model model = rotor.model();
  model.structure.unbalances.clear();
  for (const Scene& scene : {p.scene(), make_scene(model)}) {
    const ContactSystem& system = scene.contacts;
    const int n = system.coordinates();
    Vec y = Vec::Zero(2 * n), a(n);
    y.head(n) = equilibrium(system);
    ASSERT_GT(kinematics(system.contacts()[0], y.data(), n).depth, 0.0);
    system.acceleration(0.0, y.data(), a.data());
    EXPECT_LT(a.norm(), 1e-10 * system.constant_load().norm());
  }
}

// It is where a simulation starts, so that nothing happens without unbalance.
TEST(Equilibrium, IsTheStartOfASimulation) {
  const MassInRing p{.k = 1e4, .c = 1.0, .clearance = 0.5e-3, .gravity = 9.81};
  const Scene scene = p.scene();
  MotionState state = test::start_of(p.model(), scene);
  const Vec start = state.y;
  test::run(scene, state, 20, {.tolerance = 1e-13});
  EXPECT_LT(distance(scene.contacts, state.y, start), 1e-10);
}

TEST(Equilibrium, NeedsARotorThatIsHeld) {
  const MassInRing p{.k = 0.0, .c = 1.0, .gravity = 9.81};
  EXPECT_THROW(equilibrium(p.scene().contacts), NumericalError);
}

}  // namespace whirl::equilibrium_test
