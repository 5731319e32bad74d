// What equal steps of the classical Runge-Kutta method make of motions with contact: exponents from
// copies of the motion, without variational equations.

#include "libdyn/studies/stepped.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "libdyn/studies/classify.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::stepped_test {

using test::RotorStator;

/// A motion by equal steps after a transient, with its exponents.
Trajectory stepped(const Scene& scene, const Model& model, long transient, long revolutions,
                   long steps, double apart = copies_apart) {
  std::vector<Trajectory> one{
      {.system = &scene.contacts, .state = test::start_of(model, scene), .revolutions = transient}};
  integrate_stepped(one, {}, steps);
  one[0].revolutions = revolutions;
  integrate_stepped(one, {.sections = true, .measures = true, .exponents = true}, steps, apart);
  EXPECT_EQ(one[0].outcome, Outcome::reached_end) << one[0].failure;
  return one[0];
}

// Without contact the largest exponent is the rotor's damping, -c / 2 m, and the sum of all is the
// divergence of both masses.
TEST(Stepped, CopiesOfAFreeMotionHaveItsDamping) {
  const RotorStator p{.Omega = 100.0};
  const Trajectory t = stepped(p.scene(), p.model(), 0, 60, 1000);
  ASSERT_EQ(t.exponents.size(), 8);
  constexpr double directions =
      0.5;  // what they take to turn to where they stay, over the time [1/s]
  EXPECT_NEAR(t.exponents(0), -280.0 / 100.0, directions);
  EXPECT_NEAR(t.exponents.sum(), -119.2, 1e-4);
}

// In permanent contact nothing is switched: exponents are those of the tangents of the engine, and
// measures say so.
TEST(Stepped, HasTheExponentsOfTangentsWhereContactIsPermanent) {
  const Scene scene = test::P3.scene();
  const Classification exact =
      classify(scene.contacts, test::start_of(test::P3.model(), scene), {.revolutions = 100});
  ASSERT_TRUE(exact.is_proven);
  const Trajectory t = stepped(scene, test::P3.model(), 300, 100, 1000);
  constexpr double directions = 0.3;  // [1/s]
  EXPECT_NEAR(t.exponents(0), exact.exponents(0) / scene.contacts.period(), directions);
  EXPECT_NEAR(t.exponents.sum(), -119.2, 1e-3);
  ASSERT_EQ(t.contacts.size(), 1u);
  EXPECT_NEAR(t.contacts[0].in_touch, 100.0 * scene.contacts.period(), 1e-9);
  EXPECT_EQ(t.contacts[0].impacts, 0.0);
}

// At 150 rad/s, 100 MN/m and friction 0.12 the motion is a torus. A thousand steps a revolution
// make chaos of it, which gets weaker as they get smaller: largest exponents of an independent
// program over 3000 revolutions are 9.9, 6.1 and 3.2 1/s with 1000, 2000 and 4000 steps.
TEST(Stepped, StepsMakeChaosOfATorus) {
  const RotorStator p{.Omega = 150.0, .kC = 100e6, .mu = 0.12};
  const Scene scene = p.scene();
  const MotionState start = test::start_of(p.model(), scene);
  const ClassifyOptions options{.discard = 500, .revolutions = 150, .exponents = 150};
  const Classification torus =
      classify(scene.contacts, start, {.discard = 1000, .revolutions = 300, .exponents = 300});
  EXPECT_EQ(torus.kind, MotionKind::quasi_periodic);
  const auto exponent = [&](long steps) {
    ClassifyOptions by_steps = options;
    by_steps.rk4_steps = steps;
    const Classification c = classify(scene.contacts, start, by_steps);
    EXPECT_FALSE(c.is_proven);
    EXPECT_GT(c.contacts.at(0).impacts, 150.0);
    EXPECT_EQ(c.kind, MotionKind::chaotic) << steps;
    return c.exponents(0) / scene.contacts.period();  // [1/s]
  };
  const double coarse = exponent(1000), fine = exponent(4000);
  EXPECT_GT(coarse, 6.0);
  EXPECT_LT(fine, 0.7 * coarse);
}

// It is the motion that is chaotic, not an exponent of it that is taken wrongly: copies part from
// it at the same rate whatever the distance that they begin with.
TEST(Stepped, CopiesPartAtOneRateWhateverTheirDistance) {
  const RotorStator p{.Omega = 150.0, .kC = 100e6, .mu = 0.12};
  const Scene scene = p.scene();
  const auto exponent = [&](double apart) {
    return stepped(scene, p.model(), 500, 150, 1000, apart).exponents(0);
  };
  const double near = exponent(1e-9);
  EXPECT_GT(near, 4.0);
  EXPECT_NEAR(exponent(1e-8), near, 0.2);
  EXPECT_NEAR(exponent(1e-7), near, 0.2);
}

// What repeats is periodic by equal steps, too, but not proven.
TEST(Stepped, TellsPeriods) {
  const Scene scene = test::P1.scene();
  const Classification c =
      classify(scene.contacts, test::start_of(test::P1.model(), scene),
               {.discard = 300, .revolutions = 100, .exponents = 100, .rk4_steps = 1000});
  EXPECT_EQ(c.kind, MotionKind::periodic);
  EXPECT_EQ(c.period, 1);
  EXPECT_FALSE(c.is_proven);
  EXPECT_NEAR(c.impacts(), 500.0, 1.0);  // a revolution may begin within one
}

}  // namespace whirl::stepped_test
