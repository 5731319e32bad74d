// Trees of branches and the curves of their bifurcations: what is known of one, and going on.

#include "libdyn/studies/branch_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/branch_trees.hpp"

namespace whirl::branch_tree_test {

using test::DoublingRotor;

constexpr double doubling = 0.128110487;  // friction at 64 MN/m, as whirl continue tells it
constexpr double located = 1e-8;          // of the friction

/// All numbers of a tree are the same, bit by bit.
void expect_same(const BranchTree& a, const BranchTree& b) {
  ASSERT_EQ(a.branches.size(), b.branches.size());
  for (std::size_t k = 0; k < a.branches.size(); ++k) {
    const TracedBranch &x = a.branches[k], &y = b.branches[k];
    EXPECT_EQ(x.parent, y.parent);
    EXPECT_EQ(x.branch.end_text(), y.branch.end_text());
    ASSERT_EQ(x.branch.points.size(), y.branch.points.size()) << k;
    for (std::size_t i = 0; i < x.branch.points.size(); ++i) {
      EXPECT_EQ(x.branch.points[i].z, y.branch.points[i].z);
      EXPECT_EQ(x.starts[i], y.starts[i]);
      EXPECT_EQ(x.measures[i].radii, y.measures[i].radii);
    }
    ASSERT_EQ(x.branch.bifurcations.size(), y.branch.bifurcations.size()) << k;
  }
}

// Both ways from friction 0.13 there is one period doubling; the orbit of twice the period begins there.
TEST(BranchTree, BranchesOutAtThePeriodDoubling) {
  const DoublingRotor rotor;
  long shown = 0;
  const BranchTree tree = grow_tree(rotor.scenes(), rotor.begun(), rotor.options(),
                                    {.progress = [&](long done, long) { shown = done; }});
  EXPECT_TRUE(tree.is_complete());
  EXPECT_GT(shown, 0);
  ASSERT_EQ(tree.branches.size(), 3u);  // both ways, and the doubled one
  const TracedBranch &down = tree.branches[0], &up = tree.branches[1], &doubled = tree.branches[2];
  EXPECT_EQ(down.branch.points.back().value, 0.12);
  EXPECT_EQ(up.branch.points.back().value, 0.14);
  ASSERT_EQ(down.branch.bifurcations.size(), 1u);
  EXPECT_TRUE(up.branch.bifurcations.empty());
  const Bifurcation& b = down.branch.bifurcations[0];
  EXPECT_EQ(b.kind, BifurcationKind::period_doubling);
  EXPECT_NEAR(b.at.value, doubling, located);
  EXPECT_EQ(doubled.parent, 1);
  EXPECT_EQ(doubled.branch.period, 2);
  EXPECT_EQ(doubled.branch.points[0].value, b.at.value);
  for (const BranchPoint& p : down.branch.points) EXPECT_EQ(p.is_stable(), p.value > doubling);
}

// Wherever it is stopped, and from every state that it gives to be saved, it ends the same.
TEST(BranchTree, GoesOnWhereItWasStopped) {
  const DoublingRotor rotor;
  const ParameterScenes scenes = rotor.scenes();
  const BranchTreeOptions options = rotor.options();
  const BranchTree begun = rotor.begun();
  std::vector<BranchTree> saved;
  const BranchTree whole = grow_tree(
      scenes, begun, options, {.save = [&](const BranchTree& so_far) { saved.push_back(so_far); }});
  EXPECT_FALSE(saved.empty());
  for (const BranchTree& part : saved) expect_same(grow_tree(scenes, part, options, {}), whole);
  for (const long stop : {0L, 3L, 8L, 14L, 20L}) {
    long asked = 0;
    const BranchTree part =
        grow_tree(scenes, begun, options, {.is_stopped = [&] { return asked++ >= stop; }});
    EXPECT_FALSE(part.is_complete()) << stop;
    expect_same(grow_tree(scenes, part, options, {}), whole);
  }
}

// The curve of the doubling in the plane of friction and stiffness goes through it, and at another
// point of it a branch along friction doubles; stopped on the way it is the same.
TEST(BifurcationCurves, GoThroughTheDoublingsOfBranches) {
  const DoublingRotor rotor;
  BranchTreeOptions one = rotor.options();
  one.generations = 0;
  const BranchTree tree = grow_tree(rotor.scenes(), rotor.begun(), one, {});
  const BifurcationCurveOptions options = rotor.curve_options();
  const BifurcationCurves curves = follow_bifurcations(rotor.plane(), tree, {}, options, {});
  ASSERT_EQ(curves.curves.size(), 2u);  // both ways
  EXPECT_TRUE(curves.is_complete());
  for (const BifurcationCurve& c : curves.curves) {
    EXPECT_EQ(c.kind, BifurcationKind::period_doubling);
    EXPECT_EQ(c.branch_number, 1);
    EXPECT_NEAR(first_value(options.along, c.branch.points[0]), doubling, located);
  }
  const auto& points = curves.curves[1].branch.points;
  ASSERT_GT(points.size(), 3u);
  const BranchPoint& other = points[points.size() / 2];
  EXPECT_GT(other.value, 64.3e6);
  const DoublingRotor stiffer{.stiffness = other.value};
  const BranchTree again = grow_tree(stiffer.scenes(), stiffer.begun(), one, {});
  bool is_there = false;
  for (const TracedBranch& b : again.branches) {
    for (const Bifurcation& x : b.branch.bifurcations) {
      constexpr double by_differences = 1e-6;  // derivatives of the curve's last equation
      is_there =
          is_there || std::abs(x.at.value - first_value(options.along, other)) < by_differences;
    }
  }
  EXPECT_TRUE(is_there);

  long asked = 0;
  const BifurcationCurves part = follow_bifurcations(rotor.plane(), tree, {}, options,
                                                     {.is_stopped = [&] { return asked++ >= 2; }});
  EXPECT_FALSE(part.is_complete());
  const BifurcationCurves rest = follow_bifurcations(rotor.plane(), tree, part, options, {});
  for (std::size_t k = 0; k < 2; ++k) {
    const auto &x = rest.curves[k].branch.points, &y = curves.curves[k].branch.points;
    ASSERT_EQ(x.size(), y.size());
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_EQ(x[i].z, y[i].z);
  }
}

}  // namespace whirl::branch_tree_test
