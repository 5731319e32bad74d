// Orbits near random starts, and the same orbit by two methods.

#include "libdyn/studies/orbit_search.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>

#include "libdyn/motions/start.hpp"
#include "libdyn/studies/found_orbit.hpp"
#include "libdyn/studies/orbit_travel.hpp"
#include "libdyn/taylor/batch.hpp"
#include "tests/support/post.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::orbit_search_test {

// At 138.4 rad/s, 64 MN/m and friction 0.11 orbits of one revolution coexist, all of them unstable.
TEST(OrbitSearch, FindsUnstableOrbitsOnce) {
  const test::RotorStator rotor{.Omega = 138.4, .kC = 64e6, .mu = 0.11};
  const Scene scene = rotor.scene();
  const MotionState around = start_state(rotor.model(), scene, nullptr);
  const OrbitSearchOptions options{.starts = 40, .size = 1.0};
  const OrbitSearch all = search_orbits(scene, around, options, {});
  EXPECT_EQ(all.done, 40);
  EXPECT_GE(all.orbits.size(), 3u);
  long starts = all.failed;
  for (const SearchedOrbit& s : all.orbits) {
    EXPECT_FALSE(s.orbit.is_stable());
    EXPECT_EQ(s.shortest_period, 1);
    starts += s.starts;
    for (const SearchedOrbit& other : all.orbits) {
      if (&other == &s) continue;
      EXPECT_GT((other.orbit.states[0] - s.orbit.states[0]).norm(), 1e-6);
    }
  }
  EXPECT_EQ(starts, all.done);
  for (std::size_t i = 1; i < all.orbits.size(); ++i) {
    EXPECT_LE(all.orbits[i].starts, all.orbits[i - 1].starts);
  }
}

/// Two searches found the same, bit by bit.
void expect_same_orbits(const OrbitSearch& a, const OrbitSearch& b) {
  EXPECT_EQ(a.done, b.done);
  EXPECT_EQ(a.failed, b.failed);
  ASSERT_EQ(a.orbits.size(), b.orbits.size());
  for (std::size_t i = 0; i < a.orbits.size(); ++i) {
    EXPECT_EQ(a.orbits[i].starts, b.orbits[i].starts);
    EXPECT_EQ(a.orbits[i].shortest_period, b.orbits[i].shortest_period);
    EXPECT_EQ(packed(a.orbits[i].orbit), packed(b.orbits[i].orbit));
  }
}

// Threads and processes find the same, and not the leader alone.
TEST(OrbitSearch, IsTheSameInThreadsAndRanks) {
  const test::RotorStator rotor{.Omega = 138.4, .kC = 64e6, .mu = 0.11};
  const Scene scene = rotor.scene();
  const MotionState around = start_state(rotor.model(), scene, nullptr);
  OrbitSearchOptions options{.starts = 24, .size = 1.0};
  const OrbitSearch alone = search_orbits(scene, around, options, {});
  for (const auto& [count, threads] : {std::pair{1, 2}, {2, 1}, {3, 2}}) {
    options.threads = threads;
    std::atomic<int> sent = 0;
    expect_same_orbits(test::in_ranks(count,
                                      [&](Ranks ranks) {
                                        ranks.send = [&, send = ranks.send](Letter letter) {
                                          sent += letter.kind == LetterKind::rows;
                                          send(std::move(letter));
                                        };
                                        return search_orbits(scene, around, options,
                                                             {.ranks = &ranks});
                                      }),
                       alone);
    EXPECT_EQ(sent > 0, count > 1);
  }
}

// A search that is stopped has what so many starts lead to, whatever later ones have found
// meanwhile.
TEST(OrbitSearch, StoppedItHasWhatItsFirstStartsLedTo) {
  const test::RotorStator rotor{.Omega = 138.4, .kC = 64e6, .mu = 0.11};
  const Scene scene = rotor.scene();
  const MotionState around = start_state(rotor.model(), scene, nullptr);
  OrbitSearchOptions options{.starts = 400, .size = 1.0, .threads = 2};
  std::atomic<bool> is_stopped = false;
  const OrbitSearch part =
      search_orbits(scene, around, options,
                    {.progress = [&](long done, long) { is_stopped = done >= 40; },
                     .is_stopped = [&] { return is_stopped.load(); }});
  EXPECT_GE(part.done, 1);  // of 40, unless the first one waits for a processor all the time
  EXPECT_LT(part.done, 400);
  options.starts = part.done;
  expect_same_orbits(search_orbits(scene, around, options, {}), part);
}

// A start that would take days on its way, or minutes in Newton's method, is left when it is asked
// to stop; the start does not count, neither as one with an orbit nor as one without.
TEST(OrbitSearch, StopsWithinAStart) {
  const test::RotorStator rotor{.Omega = 138.4, .kC = 64e6, .mu = 0.11};
  const Scene scene = rotor.scene();
  const MotionState around = start_state(rotor.model(), scene, nullptr);
  for (const auto& [discard, period] : {std::pair{1'000'000'000L, 1}, {0L, 20'000}}) {
    const auto begin = std::chrono::steady_clock::now();
    const OrbitSearch none = search_orbits(
        scene, around, {.period = period, .starts = 40, .discard = discard, .size = 1.0},
        {.is_stopped = [begin] {
          return std::chrono::steady_clock::now() - begin > std::chrono::milliseconds(50);
        }});
    EXPECT_EQ(none.done, 0) << discard;
    EXPECT_EQ(none.failed, 0) << discard;
    EXPECT_TRUE(none.orbits.empty()) << discard;
  }
}

// In permanent contact the forces are smooth: both methods find one orbit, with its multipliers.
TEST(FoundOrbit, IsTheSameByBothMethods) {
  const Scene scene = test::P3.scene();
  Trajectory motion{.system = &scene.contacts,
                    .state = start_state(test::P3.model(), scene, nullptr),
                    .revolutions = 300};
  integrate_single(motion, {});
  const FoundOrbit shot = find_orbit_near(scene, motion.state.y, {});
  ASSERT_TRUE(shot.is_good()) << shot.failure;
  EXPECT_FALSE(shot.series);
  const FoundOrbit series = find_orbit_near(
      scene, motion.state.y, {.method = OrbitMethod::harmonic_balance, .is_verified = true});
  ASSERT_TRUE(series.is_good()) << series.failure;
  ASSERT_TRUE(series.series && series.series->gap);
  EXPECT_EQ(series.is_stable, shot.is_stable);
  const ShootingGap& gap = *series.series->gap;
  EXPECT_FALSE(gap.failure) << gap.failure;
  constexpr double truncated = 1e-5;  // tolerance of the series [length scales]
  EXPECT_LT(gap.displacement.value(), truncated);
  EXPECT_LT(gap.multiplier.value(), 1e-3);
  EXPECT_LT((series.states[0] - shot.states[0])
                .cwiseQuotient(scene.contacts.state_scale())
                .head(scene.contacts.coordinates())
                .lpNorm<Eigen::Infinity>(),
            truncated);
  // the amplitude of all points at order 1 is that of the states' displacements but for sag and
  // rest
  EXPECT_EQ(series.series->orders(1), 1.0);
  EXPECT_EQ(series.series->amplitudes.rows(), scene.displacement_map().rows());
}

}  // namespace whirl::orbit_search_test
