// Measuring integrators: errors against the reference, its own error, times, failures.

#include "libdyn/motions/work_precision.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>

#include "libbase/error.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::work_precision_test {

constexpr long revolutions = 20;
constexpr TimingOptions quick{.most_runs = 1, .most_time = 0.01};

struct Steady {
  Scene scene;
  MotionState start;
  ReferenceMotion reference;

  explicit Steady(const test::RotorStator& p) : scene(p.scene()) {
    start = test::start_of(p.model(), scene);
    test::run(scene, start, 400, {.method = Dop853{}});
    reference = reference_motion(scene.contacts, start, revolutions);
  }
};

/// Five impacts a revolution, made once for all tests.
const Steady& impacting() {
  static const Steady p(test::P1);
  return p;
}

// The impacting motion contracts: its largest Floquet exponent is -2.944 1/s, so a deviation
// shrinks to some exp(-2.944 * 20 * 2 pi / 136) = 0.066 of itself, times a factor for its shape.
TEST(WorkPrecision, ReferenceOfAStableMotionIsExactToRounding) {
  const Steady& p = impacting();
  EXPECT_GT(p.reference.error, 0.0);
  EXPECT_LT(p.reference.error, 3e-16);  // of its end as a double, a few clearances
  EXPECT_GT(p.reference.growth, 0.066 / 10.0);
  EXPECT_LT(p.reference.growth, 0.066 * 10.0);
  EXPECT_EQ(p.reference.made_by, "taylor in quadruple precision at 1e-26");
}

// A reference of another kind is as far off as it says, or less.
TEST(WorkPrecision, ReferencesAgreeWithinTheirErrors) {
  const Steady& p = impacting();
  const ReferenceMotion other = dop853_reference(p.scene.contacts, p.start, revolutions);
  EXPECT_EQ(other.made_by, "dop853 at 1e-15");
  EXPECT_LT(other.error, 1e-12);
  const double apart = distance(p.scene.contacts, other.end, p.reference.end);
  EXPECT_GT(apart, p.reference.error);
  EXPECT_LT(apart, 3.0 * other.error);
  EXPECT_NEAR(other.growth, p.reference.growth, 1e-4);
}

// Every freedom of a shaft: quadruple precision would take minutes for what DOP853 does in seconds.
TEST(WorkPrecision, BigSystemsHaveAReferenceInDouble) {
  const test::TwoDiskRub rub{.modes = 24};
  const Scene scene = rub.scene();
  const MotionState start = test::start_of(rub.model(), scene);
  EXPECT_EQ(reference_motion(scene.contacts, start, 4).made_by, "dop853 at 1e-15");
}

// At 146 rad/s the rotor and stator move chaotically: what a reference in double knows is lost
// after 100 revolutions, and it says so.
TEST(WorkPrecision, ChaosLimitsTheReference) {
  test::RotorStator p = test::P4;
  p.Omega = 146.0;
  const Steady chaotic(p);
  EXPECT_GT(chaotic.reference.growth, 100.0);
  EXPECT_FALSE(chaotic.reference.is_lost());
  EXPECT_LT(chaotic.reference.error, 1e-15);
  const ReferenceMotion later = dop853_reference(chaotic.scene.contacts, chaotic.start, 100);
  EXPECT_TRUE(later.is_lost());
  EXPECT_GT(later.error, 1e-4);
}

// The error is that of an independent run, and it falls with the tolerance; a tighter one costs
// time.
TEST(WorkPrecision, MeasuresErrorAndTimeOfMethods) {
  const Steady& p = impacting();
  MotionState end = p.start;
  test::run(p.scene, end, revolutions, {.tolerance = 1e-6, .method = Dop853{}});
  const Candidate dop853 = candidate(p.scene.contacts, "dop853");
  const TimedRun coarse = measure(dop853, 1e-6, p.scene.contacts, p.start, p.reference, quick);
  const TimedRun fine = measure(dop853, 1e-12, p.scene.contacts, p.start, p.reference, quick);
  EXPECT_EQ(coarse.method, "dop853");
  EXPECT_FALSE(coarse.has_failed());
  EXPECT_EQ(coarse.error, distance(p.scene.contacts, end.y, p.reference.end));
  EXPECT_LT(fine.error, 1e-4 * coarse.error);
  EXPECT_GT(coarse.time, 0.0);
  EXPECT_GT(fine.time, 0.0);
  EXPECT_GT(fine.integration.cost.steps, coarse.integration.cost.steps);
  EXPECT_EQ(fine.integration.cost.events, 10 * revolutions);
}

// Motions that one call moves at once share its time.
TEST(WorkPrecision, SharesTheTimeAmongMotions) {
  const Steady& p = impacting();
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

// A batch moves each of its motions as the method alone does, Taylor series bit by bit, RK4 but for
// rounding, in less time.
TEST(WorkPrecision, MeasuresABatch) {
  const Steady& p = impacting();
  const auto run = [&](std::string_view name) {
    return measure(candidate(p.scene.contacts, name), 1e-10, p.scene.contacts, p.start,
                   p.reference);
  };
  const TimedRun single = run("taylor"), batch = run("taylor-batch");
  EXPECT_EQ(batch.method, "taylor-batch");
  EXPECT_EQ(batch.error, single.error);
  EXPECT_EQ(batch.integration.cost.steps, single.integration.cost.steps);
  EXPECT_LT(batch.time, single.time);
  const TimedRun rk4 = run("rk4"), rk4_batch = run("rk4-batch");
  EXPECT_NEAR(rk4_batch.error, rk4.error, 1e-6 * rk4.error);
  EXPECT_EQ(rk4_batch.integration.cost.steps, rk4.integration.cost.steps);
  EXPECT_LT(rk4_batch.time, rk4.time);
}

// All methods by their names, and the batch; nothing else.
TEST(WorkPrecision, KnowsItsCandidates) {
  const Steady& p = impacting();
  for (const std::string_view name : candidate_names()) {
    EXPECT_EQ(candidate(p.scene.contacts, name).name, name);
  }
  EXPECT_EQ(candidate_names().size(), method_names().size() + 2);
  EXPECT_THROW(candidate(p.scene.contacts, "rk5"), ModelError);
}

// A run that fails is a result; a reference that does is an error.
TEST(WorkPrecision, KeepsFailures) {
  const Steady& p = impacting();
  MotionState start = p.start;
  start.y(0) = std::nan("");
  const TimedRun run = measure(candidate(p.scene.contacts, "rk4"), 1e-6, p.scene.contacts, start,
                               p.reference, quick);
  EXPECT_TRUE(run.has_failed());
  EXPECT_TRUE(std::isnan(run.error));
  EXPECT_NE(run.integration.failure, "");
  EXPECT_THROW(reference_motion(p.scene.contacts, start, revolutions), NumericalError);
  EXPECT_THROW(quad_reference(p.scene.contacts, start, revolutions), NumericalError);
  EXPECT_THROW(dop853_reference(p.scene.contacts, start, revolutions), NumericalError);
}

}  // namespace whirl::work_precision_test
