// Measuring integrators: errors against the reference, its own error, times, failures.

#include "libdyn/work_precision.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>

#include "libfe/base/error.hpp"
#include "tests/support/scenes.hpp"

namespace whirl {
namespace {

constexpr long revolutions = 20;
constexpr TimingOptions quick{.most_runs = 1, .most_time = 0.01};

struct Steady {
  Scene scene;
  MotionState start;
  ReferenceMotion reference;

  explicit Steady(const test::RotorStator& p) : scene(p.scene()) {
    start = test::start_of(p.model(), scene);
    test::run(scene, start, 400, {.method = Dop853{}});
    reference = dop853_reference(scene.contacts, start, revolutions);
  }
};

// The impacting motion contracts: its largest Floquet exponent is -2.944 1/s, so a deviation
// shrinks to some exp(-2.944 * 20 * 2 pi / 136) = 0.066 of itself, times a factor for its shape.
TEST(WorkPrecision, ReferenceOfAStableMotionIsExactToRounding) {
  const Steady p(test::P1);
  EXPECT_GT(p.reference.error, 0.0);
  EXPECT_LT(p.reference.error, 1e-12);
  EXPECT_GT(p.reference.growth, 0.066 / 10.0);
  EXPECT_LT(p.reference.growth, 0.066 * 10.0);
  EXPECT_EQ(p.reference.made_by, "dop853 at 1e-15");
}

// At 146 rad/s the rotor and stator move chaotically: what a reference knows after 20 revolutions
// is lost after 100, and it says so.
TEST(WorkPrecision, ChaosLimitsTheReference) {
  test::RotorStator p = test::P4;
  p.Omega = 146.0;
  const Steady chaotic(p);
  EXPECT_GT(chaotic.reference.growth, 100.0);
  EXPECT_FALSE(chaotic.reference.is_lost());
  EXPECT_LT(chaotic.reference.error, 1e-8);
  const ReferenceMotion later = dop853_reference(chaotic.scene.contacts, chaotic.start, 100);
  EXPECT_TRUE(later.is_lost());
  EXPECT_GT(later.error, 1e-4);
}

// The error is that of an independent run, and it falls with the tolerance; a tighter one costs
// time.
TEST(WorkPrecision, MeasuresErrorAndTimeOfMethods) {
  const Steady p(test::P1);
  MotionState end = p.start;
  test::run(p.scene, end, revolutions, {.tolerance = 1e-6, .method = Dop853{}});
  const Candidate dop853 = candidate(p.scene.contacts, "dop853");
  const TimedRun coarse = measure(dop853, 1e-6, p.scene.contacts, p.start, p.reference, quick);
  const TimedRun fine = measure(dop853, 1e-12, p.scene.contacts, p.start, p.reference, quick);
  EXPECT_EQ(coarse.method, "dop853");
  EXPECT_FALSE(coarse.has_failed());
  EXPECT_EQ(coarse.error, test::distance(p.scene.contacts, end.y, p.reference.end));
  EXPECT_LT(fine.error, 1e-4 * coarse.error);
  EXPECT_GT(coarse.time, 1e-7);  // 100 ns and 10 ms a revolution: any machine is in between
  EXPECT_LT(fine.time, 1e-2);
  EXPECT_GT(fine.integration.cost.steps, coarse.integration.cost.steps);
  EXPECT_EQ(fine.integration.cost.events, 10 * revolutions);
}

// Motions that one call moves at once share its time.
TEST(WorkPrecision, SharesTheTimeAmongMotions) {
  const Steady p(test::P3);
  const auto burn = [&](MotionState& state, long, double) {
    state.y = p.reference.end;
    const std::clock_t begin = std::clock();
    while (std::clock() - begin < CLOCKS_PER_SEC / 500) {
    }
    return Integration{};
  };
  const TimedRun four = measure({"burn", burn, 4.0}, 1e-6, p.scene.contacts, p.start, p.reference);
  EXPECT_EQ(four.error, 0.0);
  EXPECT_NEAR(four.time, 2e-3 / revolutions / 4.0, 0.5e-3 / revolutions / 4.0);
}

// A run that fails is a result; a reference that does is an error.
TEST(WorkPrecision, KeepsFailures) {
  Steady p(test::P1);
  p.start.y(0) = std::nan("");
  const TimedRun run = measure(candidate(p.scene.contacts, "rk4"), 1e-6, p.scene.contacts, p.start,
                               p.reference, quick);
  EXPECT_TRUE(run.has_failed());
  EXPECT_TRUE(std::isnan(run.error));
  EXPECT_NE(run.integration.diagnosis, "");
  EXPECT_THROW(dop853_reference(p.scene.contacts, p.start, revolutions), NumericalError);
}

}  // namespace
}  // namespace whirl
