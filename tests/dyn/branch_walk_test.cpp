// Walks along branches that are stopped, between points and on the way to one.

#include "libdyn/studies/branch_walk.hpp"

#include <gtest/gtest.h>

#include "libbase/system/interruption.hpp"

namespace whirl::branch_walk_test {

/// x^2 + u^2 = 1 of u from -2 to 2: a closed branch with two folds.
/// @param evaluations  counts how often the equation is asked for
Continuation on_a_circle(long& evaluations) {
  BranchEquations circle{[&evaluations](const Vec& x, double u, WithTangent) {
    interruption_point();
    ++evaluations;
    BranchEquations::Value at{.residual = Vec::Constant(1, x(0) * x(0) + u * u - 1.0),
                              .jacobian = Mat::Constant(1, 1, 2.0 * x(0))};
    at.multipliers = [u] { return CVec{{Complex(1.0 - 0.1 * u, 0.0)}}; };
    return at;
  }};
  return {std::move(circle),
          Vec::Constant(1, std::sqrt(1.0 - 0.3 * 0.3)),
          {.low = -2.0, .high = 2.0, .first = 0.3, .largest_step = 0.1, .most_points = 400}};
}

/// x = 1 - u of u from 0 to 2: there is no solution beyond 1, and the branch ends before it.
Continuation to_where_nothing_is(long& evaluations) {
  BranchEquations equations{[&evaluations](const Vec& x, double u, WithTangent) {
    interruption_point();
    ++evaluations;
    if (u > 1.0) return BranchEquations::Value{.failure = "nothing"};
    BranchEquations::Value at{.residual = Vec::Constant(1, x(0) - (1.0 - u)),
                              .jacobian = Mat::Identity(1, 1)};
    at.multipliers = [] { return CVec{{Complex(0.5, 0.0)}}; };
    return at;
  }};
  return {std::move(equations),
          Vec::Ones(1),
          {.low = 0.0, .high = 2.0, .first = 0.0, .largest_step = 0.1, .most_points = 400}};
}

bool never() {
  return false;
}

// Wherever a walk is stopped, its branch ends with a whole point, and the walk goes on from there
// as if it had not been stopped.
TEST(BranchWalk, IsWhereItWasIfItIsStoppedOnTheWayToAPoint) {
  long all = 0;
  Continuation whole = on_a_circle(all);
  const long begun = all;
  while (advance(whole, never)) {
  }
  const Branch& expected = whole.branch();
  ASSERT_GE(expected.bifurcations.size(), 2u);
  for (long last = begun; last < all; last += 7) {
    long evaluations = 0;
    Continuation walk = on_a_circle(evaluations);
    while (advance(walk, [&] { return evaluations >= last; })) {
    }
    const Branch& branch = walk.branch();
    ASSERT_FALSE(branch.end) << last;
    for (const Bifurcation& b : branch.bifurcations) {
      ASSERT_LT(b.after, branch.points.size() - 1) << last;
    }
    const std::size_t points = branch.points.size();
    ASSERT_EQ(evaluations, last);
    while (advance(walk, never)) {
    }
    ASSERT_EQ(branch.points.size(), expected.points.size()) << last << " at " << points;
    ASSERT_EQ(branch.bifurcations.size(), expected.bifurcations.size()) << last;
    for (std::size_t i = 0; i < branch.points.size(); ++i) {
      ASSERT_EQ(branch.points[i].z, expected.points[i].z) << last << " at " << i;
    }
    for (std::size_t i = 0; i < branch.bifurcations.size(); ++i) {
      ASSERT_EQ(branch.bifurcations[i].at.z, expected.bifurcations[i].at.z) << last;
    }
  }
}

// Where a walk is stopped while it looks why nothing is ahead, the branch has not ended.
TEST(BranchWalk, HasNotEndedIfItIsStoppedAtItsEnd) {
  long all = 0;
  Continuation whole = to_where_nothing_is(all);
  const long begun = all;
  while (advance(whole, never)) {
  }
  ASSERT_TRUE(whole.branch().end);
  for (long last = begun; last < all; ++last) {
    long evaluations = 0;
    Continuation walk = to_where_nothing_is(evaluations);
    while (advance(walk, [&] { return evaluations >= last; })) {
    }
    ASSERT_FALSE(walk.branch().end) << last;
    while (advance(walk, never)) {
    }
    ASSERT_EQ(walk.branch().points.size(), whole.branch().points.size()) << last;
    ASSERT_EQ(walk.branch().end->kind, whole.branch().end->kind) << last;
  }
}

TEST(BranchWalk, DoesNotBeginAPointOnceItIsStopped) {
  long evaluations = 0;
  Continuation walk = on_a_circle(evaluations);
  const long begun = evaluations;
  EXPECT_FALSE(advance(walk, [] { return true; }));
  EXPECT_EQ(evaluations, begun);
  EXPECT_EQ(walk.branch().points.size(), 1u);
}

}  // namespace whirl::branch_walk_test
