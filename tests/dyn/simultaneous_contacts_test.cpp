// Contacts that touch and part at the same instant, to the last digit.

#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace whirl::simultaneous_contacts_test {

// Two equal masses in equal rings, started alike: each does what it does alone, with all events
// twice.
TEST(SimultaneousContacts, AreEachWhatTheyAreAlone) {
  const test::MassInRing single{.c = 100.0, .U = 2e-3, .mu = 0.1, .R = 0.01, .gravity = 9.81};
  const Model alone = single.model();
  Model both = alone;
  both.structure.bodies.push_back({.name = "twin", .m = single.m, .spins = true});
  both.structure.bearings.push_back(alone.structure.bearings[0]);
  both.structure.bearings.back().from = test::body("twin");
  both.structure.unbalances.push_back({.at = test::body("twin"), .moment = single.U});
  both.contacts.push_back(alone.contacts[0]);
  both.contacts.back().at = test::body("twin");
  both.contacts.back().name = "other ring";
  const double near = 1e-7 * single.clearance;  // both make different steps, of 1e-10
  const Scene one = make_scene(alone), two = make_scene(both);
  for (const AnyMethod& method :
       {AnyMethod(Taylor{}), AnyMethod(Dop853{}), AnyMethod(CvodeAdams{})}) {
    MotionState a = test::start_of(alone, one), b = test::start_of(both, two);
    const Integration of_one = test::run(one, a, 10, {.method = method}),
                      of_two = test::run(two, b, 10, {.method = method});
    ASSERT_EQ(of_one.outcome, Outcome::reached_end) << of_one.failure;
    ASSERT_EQ(of_two.outcome, Outcome::reached_end) << of_two.failure;
    EXPECT_GT(of_one.cost.events, 10);
    EXPECT_EQ(of_two.cost.events, 2 * of_one.cost.events) << name_of_method(method);
    for (const int i : {0, 1}) {
      EXPECT_NEAR(b.y(i), a.y(i), near) << name_of_method(method);
      EXPECT_NEAR(b.y(2 + i), a.y(i), near) << name_of_method(method);
    }
  }
}

}  // namespace whirl::simultaneous_contacts_test
