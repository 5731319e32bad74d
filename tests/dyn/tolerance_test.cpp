// The error follows the tolerance, for every method, over events; all methods agree.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/scenes.hpp"

namespace whirl::tolerance_test {

using test::RotorStator;

constexpr long revolutions = 20;

/// A reference point: how many times the tolerance the error is after 20 revolutions at most. These
/// are five times the largest ratio met between tolerances of 1e-6 and 1e-12 (one-step methods) or
/// 1e-7 and 1e-11 (multistep methods, which restart at every event).
struct Point {
  std::string name;
  RotorStator rotor;
  double events;  ///< per revolution, as an independent program counts them
  double taylor, dop853, adams, bdf, arkode, dirk, collocation;
};
std::vector<Point> points() {
  return {
      {"P1, five impacts", test::P1, 10.0, 180.0, 8.0, 2e3, 5e3, 110.0, 80.0, 3.0},
      {"P2, two long contacts", test::P2, 4.0, 80.0, 18.0, 4e2, 1e3, 7.5, 15.0, 3.0},
      {"P3, permanent contact", test::P3, 0.0, 60.0, 0.7, 2e2, 2e3, 1.0, 23.0, 35.0},
      {"P4, weakly chaotic", test::P4, 12.0, 4700.0, 320.0, 4e4, 2e5, 3.5e3, 2.6e3, 35.0},
  };
}

/// The steady motion of each point, and where it is 20 revolutions later. A reference at 1e-15
/// differs from one at 3e-15 by 2e-14 to 6e-14.
struct Reference {
  Point point;
  Scene scene;
  MotionState start, end;
};
const std::vector<Reference>& references() {
  static const std::vector<Reference> all = [] {
    std::vector<Reference> list;
    for (const Point& point : points()) {
      Reference r{point, point.rotor.scene(), {}, {}};
      r.start = test::start_of(point.rotor.model(), r.scene);
      test::run(r.scene, r.start, 400);
      r.end = r.start;
      test::run(r.scene, r.end, revolutions, {.tolerance = 1e-15, .method = Dop853{}});
      list.push_back(std::move(r));
    }
    return list;
  }();
  return all;
}

void expect_proportional(const Reference& r, const AnyMethod& method, double ratio,
                         const std::vector<double>& tolerances) {
  double loosest = 0.0, tightest = 0.0;
  for (const double tolerance : tolerances) {
    SCOPED_TRACE(r.point.name + " at " + std::to_string(std::log10(tolerance)));
    MotionState state = r.start;
    const Integration result =
        test::run(r.scene, state, revolutions, {.tolerance = tolerance, .method = method});
    ASSERT_EQ(result.outcome, Outcome::reached_end);
    const double error = distance(r.scene.contacts, state.y, r.end.y);
    EXPECT_LT(error, ratio * tolerance);
    EXPECT_EQ(static_cast<double>(result.cost.events), r.point.events * revolutions);
    if (loosest == 0.0) loosest = error;
    tightest = error;
  }
  // and it does fall, by a hundredth of what the tolerance does at least
  EXPECT_LT(tightest / loosest, 100.0 * tolerances.back() / tolerances.front()) << r.point.name;
}

TEST(Tolerance, BoundsTheErrorOfTaylorOverEvents) {
  for (const Reference& r : references()) {
    expect_proportional(r, Taylor{}, r.point.taylor, {1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12});
  }
}

TEST(Tolerance, BoundsTheErrorOfDop853OverEvents) {
  for (const Reference& r : references()) {
    expect_proportional(r, Dop853{}, r.point.dop853, {1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12});
  }
}

TEST(Tolerance, BoundsTheErrorOfCollocationOverEvents) {
  for (const Reference& r : references()) {
    expect_proportional(r, Collocation{}, r.point.collocation, {1e-6, 1e-8, 1e-10, 1e-12});
  }
}

// Multistep methods against the same reference: all agree to bounds that follow the
// tolerance.
TEST(Tolerance, BoundsTheErrorOfCvodeAdamsOverEvents) {
  for (const Reference& r : references()) {
    expect_proportional(r, CvodeAdams{}, r.point.adams, {1e-8, 1e-11});
  }
}

TEST(Tolerance, BoundsTheErrorOfCvodeBdfOverEvents) {
  for (const Reference& r : references()) {
    expect_proportional(r, CvodeBdf{}, r.point.bdf, {1e-8, 1e-11});
  }
}

// One-step methods of order 5 with SUNDIALS' root finding on an interpolant, from which they go on.
TEST(Tolerance, BoundsTheErrorOfArkodeOverEvents) {
  for (const Reference& r : references()) {
    expect_proportional(r, Arkode{}, r.point.arkode, {1e-6, 1e-8, 1e-11});
  }
}

TEST(Tolerance, BoundsTheErrorOfArkodeDirkOverEvents) {
  for (const Reference& r : references()) {
    expect_proportional(r, ArkodeDirk{}, r.point.dirk, {1e-6, 1e-9});
  }
}

// A tighter tolerance costs more steps: at order 8 (DOP853), ten times the accuracy takes 1.33
// times as many where steps are not cut short by events.
TEST(Tolerance, CostsStepsAsTheOrderSays) {
  const Reference& r = references()[2];
  std::vector<double> tolerances{1e-6, 1e-8, 1e-10, 1e-12}, steps;
  for (const double tolerance : tolerances) {
    MotionState state = r.start;
    steps.push_back(static_cast<double>(
        test::run(r.scene, state, revolutions, {.tolerance = tolerance, .method = Dop853{}})
            .cost.steps));
  }
  EXPECT_NEAR(test::order_of(tolerances, steps), 1.0 / 8.0, 0.02);
}

}  // namespace whirl::tolerance_test
