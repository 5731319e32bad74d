// Trees of branches and the curves of their bifurcations: what is known of one, and going on.

#include "libdyn/studies/branch_tree.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "tests/support/branch_trees.hpp"

namespace whirl::branch_tree_test {

using test::DoublingRotor;
using test::expect_same_tree;
using test::followed;

constexpr double doubling = 0.128110487;  // friction at 64 MN/m, as whirl continue tells it
constexpr double located = 1e-8;          // of the friction

/// A study that stops once so many scenes were asked for, which every evaluation of an orbit does.
struct StoppedStudy {
  BranchScenes scenes;
  std::shared_ptr<std::atomic<long>> asked = std::make_shared<std::atomic<long>>(0);

  explicit StoppedStudy(BranchScenes of) : scenes(std::move(of)) {
    scenes.along.at = [asked_ = asked, at = scenes.along.at](double value) {
      ++*asked_;
      return at(value);
    };
    scenes.plane.at = [asked_ = asked, at = scenes.plane.at](double one, double other) {
      ++*asked_;
      return at(one, other);
    };
  }
  Monitor<BranchStudy> after(long evaluations) const {
    return {.is_stopped = [asked_ = asked, evaluations] { return *asked_ >= evaluations; }};
  }
};

// Both ways from friction 0.13 there is one period doubling; the orbit of twice the period begins
// there.
TEST(BranchTree, BranchesOutAtThePeriodDoubling) {
  const DoublingRotor rotor;
  long shown = 0;
  const BranchTree tree =
      followed(rotor.all_scenes(), {.tree = rotor.begun()}, {.tree = rotor.options()},
               {.progress = [&](long done, long) { shown = done; }})
          .tree;
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

// Wherever it is stopped, and from every state that it gives to be saved, it ends the same; so it
// does in stretches of one point, and with several threads.
TEST(BranchTree, GoesOnWhereItWasStopped) {
  const DoublingRotor rotor;
  const BranchStudyOptions options{.tree = rotor.options()};
  const BranchStudy begun{.tree = rotor.begun()};
  std::vector<BranchTree> saved;
  BranchStudyOptions fine = options;
  fine.stretch = {};
  fine.threads = 2;
  const BranchTree whole =
      followed(rotor.all_scenes(), begun, fine,
               {.save = [&](const BranchStudy& so_far) { saved.push_back(so_far.tree); }})
          .tree;
  expect_same_tree(followed(rotor.all_scenes(), begun, options).tree, whole);
  EXPECT_FALSE(saved.empty());
  for (const BranchTree& part : saved) {
    expect_same_tree(followed(rotor.all_scenes(), {.tree = part}, options).tree, whole);
  }
  for (const long evaluations : {0L, 20L, 40L, 70L, 100L}) {
    const StoppedStudy study(rotor.all_scenes());
    const BranchStudy part = followed(study.scenes, begun, options, study.after(evaluations));
    EXPECT_FALSE(part.is_complete()) << evaluations;
    expect_same_tree(followed(rotor.all_scenes(), part, options).tree, whole);
  }
}

/// Walks branches to their ends, of those that wait always the last one first.
BranchTree last_first(const BranchScenes& scenes, BranchTree tree,
                      const BranchTreeOptions& options) {
  TreeGrowth growth(scenes.along, options, tree);
  std::vector<TreeGrowth::OpenWalk> open;
  while (true) {
    while (auto walk = growth.next()) open.push_back(std::move(*walk));
    if (open.empty()) return tree;
    TreeGrowth::OpenWalk last = std::move(open.back());
    open.pop_back();
    growth.keep(last.number, walk_branch(scenes.along, options, std::move(last.begun),
                                         {std::chrono::hours(1), [] { return false; }}));
  }
}

TEST(BranchTree, IsTheSameWhicheverBranchIsDoneFirst) {
  const DoublingRotor rotor;
  BranchTreeOptions options = rotor.options();
  options.along = {
      .low = 0.11, .high = 0.14, .first = 0.13, .largest_step = 0.01, .goes_both = true};
  options.generations = 2;
  const BranchTree begun = rotor.begun(options);
  const BranchTree tree = followed(rotor.all_scenes(), {.tree = begun}, {.tree = options}).tree;
  EXPECT_GT(tree.branches.size(), 3u);
  expect_same_tree(last_first(rotor.all_scenes(), begun, options), tree);
}

/// A branch with two points at these values.
TracedBranch known(int period, int parent, double from, double to,
                   std::optional<EndKind> end = {}) {
  TracedBranch branch{.branch = {.period = period, .points = {{.value = from}}}, .parent = parent};
  if (end) branch.branch.points.push_back({.value = to});
  if (end) branch.branch.end = BranchEnd{*end};
  return branch;
}
WalkNews ends_at(double value, EndKind end) {
  return {.branch = {.points = {{.value = value}}, .end = BranchEnd{end}},
          .measures = {{}},
          .starts = {Vec()}};
}

// A branch that another one turns out to have walked goes with all that was found of it, and its
// number goes to the next one, whether it is away, has been walked to its end meanwhile, or waits.
TEST(BranchTree, DropsABranchThatWasWalkedTwice) {
  const DoublingRotor rotor;
  const ParameterScenes scenes = rotor.scenes();
  BranchTreeOptions options = rotor.options();
  options.generations = 0;
  const BranchTree begun{
      .branches = {known(1, 0, 0.13, 0.12, EndKind::range), known(1, 0, 0.13, 0.14, EndKind::range),
                   known(2, 1, 0.121, 0.0), known(2, 1, 0.125, 0.0), known(2, 1, 0.129, 0.0)}};
  enum class Second { waits, is_away, is_done };
  for (const Second second : {Second::waits, Second::is_away, Second::is_done}) {
    BranchTree tree = begun;
    TreeGrowth growth(scenes, options, tree);
    const std::size_t first = growth.next()->number;
    const std::size_t twice = second != Second::waits ? growth.next()->number : 0;
    if (second == Second::is_done) growth.keep(twice, ends_at(0.121, EndKind::period_halved));
    growth.keep(first, ends_at(0.125, EndKind::period_halved));
    if (second == Second::is_away) growth.keep(twice, ends_at(0.121, EndKind::period_halved));
    ASSERT_EQ(tree.branches.size(), 4u);
    EXPECT_EQ(tree.branches[3].branch.points[0].value, 0.129);
    growth.keep(growth.next()->number, ends_at(0.128, EndKind::no_orbit));
    EXPECT_EQ(tree.branches[3].branch.points.back().value, 0.128);
    EXPECT_TRUE(tree.is_complete());
    EXPECT_FALSE(growth.next());
  }
}

// A first branch that closes is not walked the other way, even if it has been.
TEST(BranchTree, AClosedBranchIsAlone) {
  const DoublingRotor rotor;
  const ParameterScenes scenes = rotor.scenes();
  BranchTreeOptions options = rotor.options();
  options.generations = 0;
  BranchTree tree{.branches = {known(1, 0, 0.13, 0.0), known(1, 0, 0.13, 0.0)}};
  TreeGrowth growth(scenes, options, tree);
  const std::size_t one = growth.next()->number, other = growth.next()->number;
  growth.keep(other, ends_at(0.13, EndKind::closed));
  ASSERT_EQ(tree.branches.size(), 2u);
  growth.keep(one, ends_at(0.13, EndKind::closed));
  EXPECT_EQ(tree.branches.size(), 1u);
  EXPECT_TRUE(tree.is_complete());
}

// The curve of the doubling in the plane of friction and stiffness goes through it, and at another
// point of it a branch along friction doubles; stopped on the way it is the same.
TEST(BifurcationCurves, GoThroughTheDoublingsOfBranches) {
  const DoublingRotor rotor;
  BranchTreeOptions one = rotor.options();
  one.generations = 0;
  const BifurcationCurveOptions options = rotor.curve_options();
  const BranchStudyOptions both{.tree = one, .curves = options};
  const BranchStudy study = followed(rotor.all_scenes(), {.tree = rotor.begun()}, both);
  const BifurcationCurves& curves = study.curves;
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
  const BranchTree again =
      followed(stiffer.all_scenes(), {.tree = stiffer.begun()}, {.tree = one}).tree;
  bool is_there = false;
  for (const TracedBranch& b : again.branches) {
    for (const Bifurcation& x : b.branch.bifurcations) {
      constexpr double by_differences = 1e-6;  // derivatives of the curve's last equation
      is_there =
          is_there || std::abs(x.at.value - first_value(options.along, other)) < by_differences;
    }
  }
  EXPECT_TRUE(is_there);

  for (const long evaluations : {1L, 30L}) {
    const StoppedStudy stopped(rotor.all_scenes());
    const BranchStudy part =
        followed(stopped.scenes, {.tree = study.tree}, both, stopped.after(evaluations));
    EXPECT_FALSE(part.curves.is_complete()) << evaluations;
    test::expect_same_curves(followed(rotor.all_scenes(), part, both).curves, curves);
  }
}

}  // namespace whirl::branch_tree_test
