// Coexisting motions of a mass in a well whose two basins are known.

#include "libdyn/studies/basins.hpp"

#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace whirl::basins_test {

// Two orbits of period 2: sections in any order are the same motion, others are not.
TEST(Basins, KnowsAnOrbitByAnyOfItsSections) {
  const test::MassInRing p{.Omega = 100.0, .k = 1e4, .clearance = 1e-2};
  const Scene scene = p.scene();
  const std::vector<double> a{1e-3, 0, 0, 0, 2e-3, 0, 0, 0}, b{2e-3, 1e-9, 0, 0, 1e-3, 0, 0, 0},
      c{3e-3, 0, 0, 0, 1e-3, 0, 0, 0};
  const auto orbit = [](const std::vector<double>& s) {
    return Ending{.period = 2, .is_proven = true, .regimes = {Regime::none}, .sections = s};
  };
  Ending wild{.kind = MotionKind::chaotic, .regimes = {Regime::intermittent}, .sections = a};
  Ending wilder = wild;
  wilder.sections = c;
  Ending resting = wild;
  resting.regimes = {Regime::none};
  const std::vector<Ending> all{orbit(a), orbit(b), orbit(c), wild, wilder, resting, orbit(a)};
  AttractorNumbers numbers(scene.contacts);
  std::vector<int> found;
  for (const Ending& ending : all) found.push_back(numbers.number_of(ending));
  EXPECT_EQ(found, (std::vector<int>{0, 0, 1, 2, 2, 3, 0}));
}

TEST(Basins, StartsAreReproducible) {
  const test::MassInRing p{.Omega = 100.0, .k = 1e4, .clearance = 1e-2};
  const Scene scene = p.scene();
  const MotionState center = test::state_of({0.0, 0.0}, {0.0, 0.0});
  const auto start = [&](std::uint64_t seed, std::uint64_t number) {
    return random_start(scene.contacts, center, 0.5, seed, number).y;
  };
  EXPECT_EQ(start(1, 5), start(1, 5));
  EXPECT_NE(start(1, 5), start(1, 6));
  EXPECT_NE(start(2, 5), start(1, 5));
  for (std::uint64_t i = 0; i < 100; ++i) {
    EXPECT_LE(distance(scene.contacts, start(1, i), center.y), 0.5);
  }
}

}  // namespace whirl::basins_test
