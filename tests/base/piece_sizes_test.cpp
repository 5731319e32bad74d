// How points of a study are cut into pieces: threads busy, results soon, lanes full.

#include "libbase/piece_sizes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace whirl::piece_sizes_test {

constexpr std::size_t most = 256;
constexpr int threads = 4;

// 100 points on 4 threads: no thread gets more than 25 of them, whatever a point costs.
TEST(PieceSizes, FewPointsGoToAllThreads) {
  for (const double cost : {1e-6, 1e-2, 10.0}) {
    PieceSizes sizes(most, threads);
    std::size_t pieces = 0, largest = 0;
    for (std::size_t left = 100; left > 0; ++pieces) {
      const std::size_t size = sizes.next(left);
      ASSERT_GT(size, 0u);
      ASSERT_LE(size, left);
      largest = std::max(largest, size);
      left -= size;
      sizes.learn(size, cost * static_cast<double>(size));
    }
    EXPECT_GE(pieces, static_cast<std::size_t>(threads)) << cost;
    EXPECT_LE(largest, 25u) << cost;
  }
}

/// How long threads take for points, each of which takes the next piece as soon as it is free, and how
/// long they work all together.
struct Taken {
  double longest = 0.0, all = 0.0;
};

template <class Next, class Cost>
Taken simulate(std::size_t points, std::size_t count, const Next& next, const Cost& cost) {
  std::vector<double> free(count, 0.0);  // since when each thread is
  Taken taken;
  for (std::size_t at = 0; at < points;) {
    double& thread = *std::min_element(free.begin(), free.end());
    const std::size_t size = next(points - at);
    double seconds = 0.0;
    for (std::size_t i = 0; i < size; ++i) seconds += cost(at++);
    thread += seconds;
    taken.all += seconds;
  }
  taken.longest = *std::max_element(free.begin(), free.end());
  return taken;
}

// 4000 points on 8 threads, of which a quarter and at the end three quarters are chaotic and thirty times
// as dear: threads wait for the last one for less than 2 % of the time; for longer with pieces of 64
// points throughout.
TEST(PieceSizes, DearPointsAtTheEndKeepNoThreadWaiting) {
  constexpr std::size_t points = 4000, eight = 8;
  const auto cost = [](std::size_t point) { return point % 40 < 10 + point / 200 ? 0.3 : 0.01; };
  PieceSizes sizes(most, eight);
  const auto idle = [&](const auto& next) {
    const Taken taken = simulate(points, eight, next, cost);
    return 1.0 - taken.all / (eight * taken.longest);
  };
  EXPECT_LT(idle([&](std::size_t left) { return sizes.next(left); }), 0.02);
  EXPECT_GT(idle([](std::size_t left) { return std::min<std::size_t>(64, left); }), 0.02);
}

// Points become known to be dear, and pieces smaller, down to those that step together; the last ones are
// of one size.
TEST(PieceSizes, PiecesShrinkTowardsTheEnd) {
  PieceSizes sizes(most, threads);
  std::vector<std::size_t> given;
  for (std::size_t left = 1000; left > 0; left -= given.back()) given.push_back(sizes.next(left));
  const auto shrinking = given.begin() + threads;  // behind the first ones
  EXPECT_TRUE(std::is_sorted(shrinking, given.end(), std::greater<>()));
  EXPECT_EQ(std::count(given.end() - 4, given.end() - 1, 8u), 3);
  EXPECT_LE(given.back(), 8u);
}

// One thread has nobody to end together with: its lanes stay full.
TEST(PieceSizes, DoNotShrinkForOneThread) {
  PieceSizes sizes(most, 1);
  EXPECT_EQ(sizes.next(56), 8u);
  sizes.learn(8, 0.32);
  EXPECT_EQ(sizes.next(48), 48u);
}

// Three points on four threads: one each.
TEST(PieceSizes, FewerPointsThanThreadsGoOneByOne) {
  PieceSizes sizes(most, threads);
  EXPECT_EQ(sizes.next(3), 1u);
}

// A point of one second: the first piece of a thread ends within ten seconds.
TEST(PieceSizes, TheFirstPieceEndsSoon) {
  PieceSizes sizes(most, threads);
  EXPECT_LE(static_cast<double>(sizes.next(100'000)) * 1.0, 10.0);
}

/// Sizes that every thread has got its first piece of.
PieceSizes after_first() {
  PieceSizes sizes(most, threads);
  for (int i = 0; i < threads; ++i) sizes.next(100'000);
  return sizes;
}

// Cheap points fill whole pieces as soon as they are known to be cheap, and never more.
TEST(PieceSizes, CheapPointsGoInLargePieces) {
  PieceSizes sizes = after_first();
  sizes.learn(8, 8e-3);
  EXPECT_EQ(sizes.next(100'000), most);
}

// Dear ones go in pieces that last some seconds, but never so few that lanes are empty.
TEST(PieceSizes, DearPointsStillFillLanes) {
  PieceSizes sizes = after_first();
  sizes.learn(8, 0.32);  // 40 ms each
  EXPECT_EQ(sizes.next(100'000), 100u);
  for (int i = 0; i < 10; ++i) sizes.learn(8, 80.0);
  EXPECT_EQ(sizes.next(100'000), 64u);
}

}  // namespace whirl::piece_sizes_test
