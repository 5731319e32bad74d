// The hardest touches of motions, against closed forms.

#include "libdyn/system/hardest_touch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "libdyn/system/model.hpp"

namespace whirl::hardest_touch_test {

TEST(HardestTouch, KeepsTheLargestForcesAndTheirMotions) {
  HardestTouches touches;
  touches.add(3, {{.name = "a", .duty = 1.0, .max_normal = 5.0, .max_tangential = 2.0}});
  touches.add(7, {{.name = "a", .duty = 0.1, .max_normal = 9.0, .max_tangential = 4.0},
                  {.name = "b", .duty = 0.5, .max_normal = 1.0, .max_tangential = 0.5}});
  ASSERT_EQ(touches.contacts().size(), 2u);
  EXPECT_EQ(touches.contacts()[0].normal, 9.0);
  EXPECT_EQ(touches.contacts()[0].pressed, 7u);
  EXPECT_EQ(touches.contacts()[0].rubbing, 2.0);  // all the time, where 4 N last a tenth of it
  EXPECT_EQ(touches.contacts()[0].rubbed, 3u);
  EXPECT_EQ(touches.contacts()[1].rubbing, 0.25);
}

TEST(HardestTouch, DepthIsThatOfTheLaw) {
  constexpr double N = 1234.5, k = 3.6e7, k_hertz = 2.3e10;
  EXPECT_NEAR(depth_under(Radial<double>{.k = k}, N), N / k, 1e-6 * N / k);
  const double hertz = std::pow(N / k_hertz, 2.0 / 3.0);
  EXPECT_NEAR(depth_under(Hertz<double>{.k = k_hertz, .alpha = 0.4}, N), hertz, 1e-6 * hertz);
  EXPECT_EQ(depth_under(Radial<double>{.k = k}, 0.0), 0.0);
  // its force begins with the rate, so that it tells no depth
  EXPECT_TRUE(std::isnan(depth_under(Radial<double>{.k = k, .c = 100.0}, N)));
}

// A disk alone: P = T R Omega, E = Ip Omega^2 / 2, which lasts E / P Omega / (2 pi) revolutions.
TEST(HardestTouch, FrictionTakesTheEnergyOfTheSpin) {
  Model model;
  model.speed = 300.0;
  Body body;
  body.name = "rotor";
  body.m = {2.0, 2.0};
  body.spins = true;
  body.tilts = true;
  body.Ip = 0.05;
  body.Id = 0.03;
  model.structure.bodies.push_back(body);
  Contact contact;
  contact.friction.radius = 0.1;
  const FrictionPower friction = friction_power(model, contact, 40.0);
  EXPECT_DOUBLE_EQ(friction.power, 40.0 * 0.1 * 300.0);
  const double energy = 0.5 * 0.05 * 300.0 * 300.0;
  EXPECT_DOUBLE_EQ(friction.revolutions,
                   energy / friction.power * 300.0 / (2.0 * std::numbers::pi));
  // of a toy, too, which holds less than a joule
  model.structure.bodies[0].Ip = 1e-6;
  EXPECT_DOUBLE_EQ(friction_power(model, contact, 40.0).revolutions,
                   0.5 * 1e-6 * 300.0 * 300.0 / friction.power * 300.0 / (2.0 * std::numbers::pi));
  model.structure.bodies[0].Ip = 0.0;
  EXPECT_TRUE(std::isnan(friction_power(model, contact, 40.0).revolutions));
}

}  // namespace whirl::hardest_touch_test
