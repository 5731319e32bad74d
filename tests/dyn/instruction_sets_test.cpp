// The engine on every instruction set that it is compiled for and this processor has: the same
// motions, to the rounding of products that are fused or not.

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <set>
#include <string>

#include "libdyn/taylor/batch.hpp"
#include "libdyn/taylor/motion_slopes.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::instruction_sets_test {

/// Lets the engine see only one instruction set, until the end of its life.
struct Only {
  explicit Only(int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  ~Only() {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

/// Rotors that touch, one by one more damped, more sliding and with rolling ones among them.
struct Rotors {
  std::vector<Scene> scenes;
  std::vector<Trajectory> trajectories;

  Rotors() {
    constexpr int size = 20;  // more than lanes, so that some are refilled
    scenes.reserve(size);
    for (int i = 0; i < size; ++i) {
      test::RotorStator p{.Omega = 130.0 + i, .kC = 20e6, .mu = 0.02 * i};
      p.cC = i % 4 == 0 ? 1e3 : 0.0;
      scenes.push_back(p.scene());
      Trajectory t{.system = &scenes.back().contacts, .revolutions = 10 + i % 3};
      t.state = test::start_of(p.model(), scenes.back());
      trajectories.push_back(t);
    }
  }
};

std::vector<Trajectory> run(const Rotors& rotors, const BatchOptions& options) {
  std::vector<Trajectory> all = rotors.trajectories;
  integrate_batch(all, options);
  for (const Trajectory& t : all) EXPECT_EQ(t.outcome, Outcome::reached_end) << t.failure;
  return all;
}

TEST(InstructionSets, GiveTheSameMotions) {
  constexpr double rounding = 1e-10;  // 1e-15 a step, grown by chaos and by impacts that graze
  const Rotors rotors;
  const BatchOptions options{.tolerance = 1e-13, .measures = true};
  const std::string best = instruction_set();
  const std::vector<Trajectory> expected = run(rotors, options);
  std::set<std::string> seen;
  const int64_t supported = hwy::SupportedTargets();
  for (int64_t rest = supported; rest != 0; rest &= rest - 1) {
    const Only only(rest & -rest);
    if (!seen.insert(instruction_set()).second) continue;  // not compiled for it: the baseline
    const std::vector<Trajectory> all = run(rotors, options);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Trajectory &t = all[i], &e = expected[i];
      EXPECT_LT(distance(*t.system, t.state.y, e.state.y), rounding)
          << instruction_set() << " " << i;
      EXPECT_EQ(t.cost.events, e.cost.events) << instruction_set() << " " << i;
      EXPECT_NEAR(t.contacts[0].max_normal, e.contacts[0].max_normal,
                  rounding * e.contacts[0].max_normal);
    }
  }
  EXPECT_TRUE(seen.contains(best));
  // a build for this machine alone leaves out AVX2 where there is AVX-512 (WHIRL_INSTRUCTION_SETS)
  const bool has_avx2 = (supported & HWY_AVX2) != 0, has_avx512 = (supported & HWY_AVX3) != 0;
  const bool left_out = has_avx512 && !seen.contains("avx2");
  EXPECT_EQ(seen.contains("avx2"), has_avx2 && !left_out);
  EXPECT_EQ(seen.contains("avx512"), has_avx512);
  EXPECT_EQ(seen.size(), 1u + has_avx512 + (has_avx2 && !left_out));  // and what every one has
  EXPECT_EQ(instruction_set(), best);
}

// Tangents have their own packs and series.
TEST(InstructionSets, GiveTheSameExponents) {
  Rotors rotors;
  rotors.trajectories.resize(9);
  const BatchOptions options{.tolerance = 1e-10, .exponents = true};
  const std::vector<Trajectory> expected = run(rotors, options);
  for (int64_t rest = hwy::SupportedTargets(); rest != 0; rest &= rest - 1) {
    const Only only(rest & -rest);
    const std::vector<Trajectory> all = run(rotors, options);
    for (std::size_t i = 0; i < all.size(); ++i) {
      EXPECT_LT((all[i].exponents - expected[i].exponents).cwiseAbs().maxCoeff(), 1e-6)  // 1/s
          << instruction_set() << " " << i;
    }
  }
}

// Products are fused with sums on AVX2 and on AVX-512, every operation rounds as IEEE 754 says, and
// no lane mixes with another: the bits of motions and exponents are the same, so that a study may
// be computed on both.
TEST(InstructionSets, AreTheSameBitByBitWhereBothFuse) {
  const std::vector<std::string> sets = instruction_sets();
  EXPECT_EQ(sets.back(), baseline_set);
  EXPECT_EQ(sets.front(), instruction_set());
  std::vector<std::vector<Trajectory>> found;
  const Rotors rotors;
  for (const std::string& set : sets) {
    use_instruction_set(set);
    EXPECT_EQ(instruction_set(), set);
    found.push_back(run(rotors, {.tolerance = 1e-10, .measures = true, .exponents = true}));
  }
  use_instruction_set("");
  EXPECT_EQ(instruction_set(), sets.front());
  EXPECT_EQ(instruction_sets(), sets);
  for (std::size_t k = 0; k < sets.size(); ++k) {
    for (std::size_t i = 0; rounds_alike(sets[k], sets[0]) && i < found[k].size(); ++i) {
      EXPECT_EQ(found[k][i].state.y, found[0][i].state.y) << sets[k] << ' ' << i;
      EXPECT_EQ(found[k][i].exponents, found[0][i].exponents) << sets[k] << ' ' << i;
      EXPECT_EQ(found[k][i].contacts[0].max_normal, found[0][i].contacts[0].max_normal);
    }
  }
}

// Derivatives by the start, and small deviations, over some impacts: with deviations and without.
TEST(InstructionSets, GiveTheSameSlopes) {
  constexpr double rounding = 1e-9;  // of derivatives that impacts have made large
  const test::RotorStator p{.Omega = 136.0, .kC = 150e6, .mu = 0.1};
  const Scene scene = p.scene();
  const MotionState start = test::start_of(p.model(), scene);
  const double end = 3.0 * scene.contacts.period();
  const Mat deviations = Mat(scene.contacts.state_scale().asDiagonal()).leftCols(2);
  for (const Mat& carried : {Mat(), deviations}) {
    std::vector<MotionSlopes> found;
    for (const std::string& set : instruction_sets()) {
      use_instruction_set(set);
      found.push_back(motion_slopes(scene.contacts, start, {{end}}, {}, {.deviations = carried}));
      ASSERT_EQ(found.back().outcome, Outcome::reached_end) << set;
    }
    use_instruction_set("");
    EXPECT_FALSE(found[0].events.empty());
    for (const MotionSlopes& other : found) {
      const Mat &mine = found[0].by_start.back(), &its = other.by_start.back();
      EXPECT_LT((its - mine).norm(), rounding * mine.norm());
      EXPECT_LT((other.states - found[0].states).norm(), rounding * found[0].states.norm());
    }
  }
}

TEST(InstructionSets, RoundAlikeWhereBothFuse) {
  EXPECT_TRUE(rounds_alike("avx2", "avx512"));
  EXPECT_TRUE(rounds_alike("baseline", "baseline"));
  EXPECT_FALSE(rounds_alike("baseline", "avx2"));
  EXPECT_FALSE(rounds_alike("avx512", "neon"));
}

}  // namespace whirl::instruction_sets_test
