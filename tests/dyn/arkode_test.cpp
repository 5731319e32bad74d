// ARKODE's methods have the order of their tables, on smooth motions and over events, measured with
// fixed steps.

#include "libdyn/methods/arkode.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/scenes.hpp"

namespace whirl::arkode_test {

using test::RotorStator;

/// Order after some revolutions of steady motion, against controlled steps of the smallest error.
double order(const AnyMethod& method, const RotorStator& p, long revolutions,
             const std::vector<double>& steps) {
  const Scene scene = p.scene();
  MotionState start = test::start_of(p.model(), scene);
  test::run(scene, start, 400);
  MotionState reference = start;
  test::run(scene, reference, revolutions, {.tolerance = 1e-15});
  std::vector<double> error;
  for (const double n : steps) {
    MotionState state = start;
    const Integration result = test::run(
        scene, state, revolutions, {.fixed_step = scene.contacts.period() / n, .method = method});
    EXPECT_EQ(result.outcome, Outcome::reached_end) << result.failure;
    error.push_back(distance(scene.contacts, state.y, reference.y));
  }
  return test::order_of(steps, error);
}

// Below 280 steps Newton's method fails in some stage of the implicit one, whose step is fixed.
const std::vector<double> steps{280.0, 400.0, 560.0, 800.0};

TEST(Arkode, HasOrderFiveInPermanentContact) {
  EXPECT_NEAR(order(Arkode{}, test::P3, 2, steps), 5.0, 0.2);
  EXPECT_NEAR(order(ArkodeDirk{}, test::P3, 2, steps), 5.0, 0.2);
}

// Four events a revolution, found on the interpolant.
TEST(Arkode, KeepsItsOrderOverEvents) {
  EXPECT_NEAR(order(Arkode{}, test::P2, 2, steps), 5.0, 0.3);
  EXPECT_NEAR(order(ArkodeDirk{}, test::P2, 2, steps), 5.0, 0.3);
}

}  // namespace whirl::arkode_test
