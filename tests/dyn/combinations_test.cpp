// Frequencies made of others: found where they were made, and not by chance.

#include "libdyn/motions/combinations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "libdyn/motions/identify.hpp"
#include "libfe/analyses/campbell.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::combinations_test {

constexpr double tolerance = 0.01;

/// Times of a frequency in a combination.
int times_of(const Combination& c, double frequency) {
  for (const Combination::Term& t : c.terms) {
    if (t.frequency == frequency) return t.times;
  }
  return 0;
}

TEST(CombinationOf, FindsTheSimplestOne) {
  const std::vector<double> others{443.0, 237.72, -150.13};
  struct Case {
    double f;
    int n[3];
  };
  for (const Case& made : {Case{2 * 237.72 - 443.0, {-1, 2, 0}}, Case{2 * 443.0, {2, 0, 0}},
                           Case{443.0 + 237.72, {1, 1, 0}}, Case{-3 * 237.72, {0, -3, 0}},
                           Case{443.0 - 237.72 - 150.13, {1, -1, 1}}}) {
    const auto found = combination_of(made.f + 0.5 * tolerance, others, tolerance);
    ASSERT_TRUE(found) << made.f;
    EXPECT_NEAR(found->frequency(), made.f, 1e-12 * 443.0);
    int order = 0;
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(times_of(*found, others[static_cast<std::size_t>(i)]), made.n[i]) << made.f;
      order += std::abs(made.n[i]);
    }
    EXPECT_EQ(found->order(), order);
    for (std::size_t i = 1; i < found->terms.size(); ++i) {
      EXPECT_GE(std::abs(found->terms[i - 1].times), std::abs(found->terms[i].times));
    }
  }
  EXPECT_FALSE(combination_of(443.0 + 1.0, others, tolerance));
  EXPECT_FALSE(combination_of(100.0, {}, tolerance));
}

// Random frequencies are hardly ever a combination, however coarse the resolution and however many
// others there are.
TEST(CombinationOf, IsRarelyFoundByChance) {
  constexpr int draws = 400;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> frequency(-500.0, 500.0);
  for (const double coarse : {0.01, 0.5, 10.0}) {
    for (const int count : {1, 2, 5, 9}) {
      int found = 0;
      for (int i = 0; i < draws; ++i) {
        std::vector<double> others;
        for (int k = 0; k < count; ++k) others.push_back(frequency(random));
        if (combination_of(frequency(random), others, coarse)) ++found;
      }
      // one of twenty; more where f is far below the reach of the others
      EXPECT_LT(found, draws / 8) << coarse << " " << count;
    }
  }
}

// A motion of the unbalance, a mode, and what a contact makes of both: the third has the shape of
// the mode, and is no mode.
TEST(Identify, NamesWhatIsMadeOfStrongerPeaks) {
  using test::rpm;
  const Model model = test::TwoDiskRub{.speed = 4430.0 * rpm, .modes = 0}.model();
  const Scene scene = make_scene(model);
  const Mode mode = complex_modes(scene.system, 2).oscillatory[1];
  const double Omega = model.speed, f = mode.frequency();
  Recording r{.samples = 32, .revolutions = 400, .clock = scene.contacts.clock()};
  r.eta.resize(scene.contacts.coordinates(), r.revolutions * r.samples);
  for (Eigen::Index j = 0; j < r.eta.cols(); ++j) {
    const double t = static_cast<double>(j) * r.spacing();
    const Complex turning = 1.0 * std::polar(1.0, Omega * t) + 0.6 * std::polar(1.0, f * t) +
                            0.2 * std::polar(1.0, (2.0 * f - Omega) * t);
    r.eta.col(j) = 1e-3 * (turning * mode.shape).real();
  }
  const Identification found = identify(model, scene, r, {});
  ASSERT_EQ(found.peaks.size(), 3u);
  EXPECT_EQ(found.peaks[0].forced, "1X");
  EXPECT_FALSE(found.peaks[0].combination);
  EXPECT_FALSE(found.peaks[1].combination);
  const auto& made = found.peaks[2].combination;
  ASSERT_TRUE(made);
  EXPECT_EQ(times_of(*made, found.peaks[1].frequency), 2);
  EXPECT_EQ(times_of(*made, Omega), -1);
}

}  // namespace whirl::combinations_test
