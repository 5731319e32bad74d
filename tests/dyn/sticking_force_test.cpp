// The friction that keeps a contact from sliding: the slip velocity stays zero along the motion
// that it makes, for one contact and for two that act on each other.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/scenes.hpp"

namespace whirl::sticking_force_test {

using test::RotorStator;

constexpr double rounding = 1e-12;

/// Velocities [m/s] and displacements [m] after a short time with the acceleration held:
/// q + q' t + q'' t^2 / 2, q' + q'' t. The slip's rate is exact to second order in t.
Vec moved(const Vec& y, const Vec& a, double t) {
  const auto n = a.size();
  Vec z(2 * n);
  z << y.head(n) + t * y.tail(n) + 0.5 * t * t * a, y.tail(n) + t * a;
  return z;
}

double slip(const ContactSystem& system, std::size_t i, const Vec& y) {
  return kinematics(system.contacts()[i], y.data(), system.coordinates()).slip;
}

/// v_t' by a central difference [m/s^2].
double slip_rate(const ContactSystem& system, std::size_t i, const Vec& y, const Vec& a) {
  constexpr double t = 2e-8;
  return (slip(system, i, moved(y, a, t)) - slip(system, i, moved(y, a, -t))) / (2.0 * t);
}

/// Of a slip rate by differences [m/s^2]: rounding of 20 m/s over 4e-8 s is 1e-7, truncation is
/// v (v / r)^3 t^2 / 6, about 1e-6.
constexpr double differences = 1e-5;

Vec acceleration(const ContactSystem& system, const Vec& y, const ContactStates& states) {
  Vec a(system.coordinates());
  system.acceleration(0.3, y.data(), states, a.data());
  return a;
}

TEST(StickingForce, KeepsTheSlipVelocityConstant) {
  const RotorStator p{.mu = 0.3, .ms = 20.0, .offset = {2e-4, 1e-4}};
  const Scene scene = p.scene();
  Vec y(8);
  y << 4.6e-3, 4.3e-3, 1e-4, -2e-4, 7.0, -6.0, -0.3, 0.2;
  const ContactStates sticking{{Touch::sticking, 1.0}}, sliding{{Touch::sliding, 1.0}};
  scene.contacts.remove_slip(y.data(), sticking);
  ASSERT_GT(kinematics(scene.contacts.contacts()[0], y.data(), 4).depth, 0.0);
  ASSERT_GT(std::abs(kinematics(scene.contacts.contacts()[0], y.data(), 4).rate), 0.5);
  const double free_rate =
      slip_rate(scene.contacts, 0, y, acceleration(scene.contacts, y, sliding));
  EXPECT_GT(std::abs(free_rate), 100.0);  // friction of full size does not hold it there
  EXPECT_NEAR(slip_rate(scene.contacts, 0, y, acceleration(scene.contacts, y, sticking)), 0.0,
              differences);
}

// hold() asks what would hold a contact that slides now; it is the T of forces() as if it
// stuck, and its sign is that of the slip that would begin.
TEST(StickingForce, IsWhatASlidingContactIsComparedWith) {
  const RotorStator p{.mu = 0.3};
  const Scene scene = p.scene();
  Vec y(8);
  y << 4.6e-3, 4.3e-3, 1e-4, -2e-4, 7.0, -6.0, -0.3, 0.2;
  const ContactStates sticking{{Touch::sticking, 1.0}}, sliding{{Touch::sliding, 1.0}};
  scene.contacts.remove_slip(y.data(), sticking);
  std::vector<ContactForces> forces;
  scene.contacts.forces(0.3, y.data(), sticking, forces);
  const double T = scene.contacts.hold(0.3, y.data(), sliding, 0).force;
  EXPECT_NEAR(T, forces[0].friction, rounding * std::abs(T));

  RotorStator frictionless = p;
  frictionless.mu = 0.0;
  const Scene slippery = frictionless.scene();
  const double rate =
      slip_rate(slippery.contacts, 0, y, acceleration(slippery.contacts, y, sliding));
  EXPECT_GT(T * rate, 0.0);
}

// One rotor sticks in two rings that move by themselves: each friction force changes both slips.
TEST(StickingForce, OfTwoContactsIsSolvedTogether) {
  RotorStator p{.mu = 0.3};
  Model model = p.model();
  model.structure.bodies.push_back({.name = "second", .m = 10.0});
  model.structure.bearings.push_back(
      test::bearing(test::body("second"), test::isotropic(5e6, 100.0)));
  model.contacts.push_back(model.contacts[0]);
  model.contacts[1].name = "second ring";
  model.contacts[1].against = test::body("second");
  model.contacts[1].friction.radius = 0.06;
  const Scene scene = make_scene(model);
  Vec y(12);
  y << 4.6e-3, 4.3e-3, 1e-4, -2e-4, 2e-4, 1e-4, 7.0, -6.0, -0.3, 0.2, 0.4, -0.5;
  const ContactStates both{{Touch::sticking, 1.0}, {Touch::sticking, 1.0}};
  for (int i = 0; i < 60; ++i) scene.contacts.remove_slip(y.data(), both);  // one after the other
  for (const std::size_t i : {0u, 1u}) ASSERT_NEAR(slip(scene.contacts, i, y), 0.0, 1e-9);

  const Vec a = acceleration(scene.contacts, y, both);
  const ContactStates first{{Touch::sticking, 1.0}, {Touch::sliding, -1.0}};
  const Vec a_first = acceleration(scene.contacts, y, first);
  const double size = std::abs(slip_rate(scene.contacts, 1, y, a_first));
  EXPECT_GT(size, 100.0);
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_NEAR(slip_rate(scene.contacts, i, y, a), 0.0, differences) << i;
  }
  EXPECT_NEAR(slip_rate(scene.contacts, 0, y, a_first), 0.0, differences);

  // the force that holds the first depends on whether the second sticks
  std::vector<ContactForces> together, alone;
  scene.contacts.forces(0.3, y.data(), both, together);
  scene.contacts.forces(0.3, y.data(), first, alone);
  EXPECT_GT(std::abs(together[0].friction - alone[0].friction), 1e-3 * alone[0].normal);
}

}  // namespace whirl::sticking_force_test
