#pragma once
/// A rotor in its stator whose orbits double their period, for studies along its friction.

#include <gtest/gtest.h>

#include "libdyn/branches/range_slopes.hpp"
#include "libdyn/motions/start.hpp"
#include "libdyn/studies/branch_study.hpp"
#include "libdyn/taylor/batch.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::test {

/// At 138.4 rad/s along friction, and in the plane of friction and contact stiffness.
struct DoublingRotor {
  static constexpr double low = 0.12, high = 0.14;  ///< range of the friction
  double stiffness = 64e6;                          ///< of the contact [N/m]

  std::shared_ptr<const Scene> scene(double friction, double k) const {
    return std::make_shared<const Scene>(
        RotorStator{.Omega = 138.4, .kC = k, .mu = friction}.scene());
  }
  ParameterScenes scenes() const {
    const auto first = scene(0.13, stiffness);
    const SceneAt at = [*this](double mu) { return scene(mu, stiffness); };
    return {first, at, std::make_shared<const RangeSlopes>(at, first, low, high)};
  }
  PlaneScenes plane() const {
    const auto at = [*this](double mu, double k) { return scene(mu, k); };
    return {scene(0.13, stiffness), at,
            std::make_shared<const PlaneSlopes>(at, ParameterEnds{low, high},
                                                ParameterEnds{62e6, 66e6})};
  }
  BranchTreeOptions options() const {
    return {.along =
                {.low = low, .high = high, .first = 0.13, .largest_step = 0.002, .goes_both = true},
            .generations = 1,
            .stations = {scenes().first->assembler.point(body("rotor"))}};
  }
  BifurcationCurveOptions curve_options() const {
    return {.along = options().along,
            .across = {.low = 62e6,
                       .high = 66e6,
                       .first = stiffness,
                       .largest_step = 0.5e6,
                       .goes_both = true}};
  }

  /// The first branches, from the model's start.
  BranchTree begun() const { return begun(options()); }
  BranchTree begun(const BranchTreeOptions& how) const {
    const ParameterScenes all = scenes();
    Trajectory motion{.system = &all.first->contacts,
                      .state = start_state(RotorStator{}.model(), *all.first, nullptr),
                      .revolutions = 500};
    integrate_single(motion, {});
    return begin_tree(all, motion.state.y, how);
  }
  BranchScenes all_scenes() const { return {scenes(), plane()}; }
};

/// Branches that are begun, followed to their end or until they are stopped.
inline BranchStudy followed(const BranchScenes& scenes, BranchStudy begun,
                            const BranchStudyOptions& options,
                            const Monitor<BranchStudy>& monitor = {}) {
  return follow_branches(scenes, std::move(begun), {}, options, monitor);
}

/// All numbers of two trees are the same, bit by bit.
inline void expect_same_tree(const BranchTree& a, const BranchTree& b) {
  ASSERT_EQ(a.branches.size(), b.branches.size());
  for (std::size_t k = 0; k < a.branches.size(); ++k) {
    const TracedBranch &x = a.branches[k], &y = b.branches[k];
    EXPECT_EQ(x.parent, y.parent);
    EXPECT_EQ(x.generation, y.generation);
    EXPECT_EQ(x.direction, y.direction);
    EXPECT_EQ(x.branch.end_text(), y.branch.end_text());
    ASSERT_EQ(x.branch.points.size(), y.branch.points.size()) << k;
    EXPECT_EQ(packed(x.branch, x.measures, x.starts), packed(y.branch, y.measures, y.starts)) << k;
  }
}
inline void expect_same_curves(const BifurcationCurves& a, const BifurcationCurves& b) {
  ASSERT_EQ(a.curves.size(), b.curves.size());
  for (std::size_t k = 0; k < a.curves.size(); ++k) {
    EXPECT_EQ(a.curves[k].branch_number, b.curves[k].branch_number);
    EXPECT_EQ(packed(begun_walk(a.curves[k])), packed(begun_walk(b.curves[k]))) << k;
  }
}

}  // namespace whirl::test
