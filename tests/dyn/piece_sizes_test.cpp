// How points of a study are cut into pieces: threads busy, results soon, lanes full.

#include "libdyn/studies/piece_sizes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace whirl::piece_sizes_test {

constexpr std::size_t most = 256;
constexpr int threads = 4;
constexpr std::size_t lanes = 16;

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

/// How long a thread takes for a piece in lanes, each of which takes the next point as soon as it
/// is free: to the end of the last one, as a step of one lane takes as long as one of all.
double in_lanes(const std::vector<double>& costs) {
  std::vector<double> free(std::min(lanes, costs.size()), 0.0);
  for (const double cost : costs) *std::min_element(free.begin(), free.end()) += cost;
  return *std::max_element(free.begin(), free.end());
}

/// How long threads take for points, each of which takes the next piece as soon as it is free, of
/// the time that full lanes would take.
/// @param next   size of the next piece
/// @param learn  told the size of a piece and what it took
template <class Next, class Learn, class Cost>
double simulate(std::size_t points, std::size_t count, const Next& next, const Learn& learn,
                const Cost& cost) {
  std::vector<double> free(count, 0.0);  // since when each thread is
  double all = 0.0;
  for (std::size_t at = 0; at < points;) {
    double& thread = *std::min_element(free.begin(), free.end());
    std::vector<double> costs(next(points - at));
    for (double& c : costs) all += c = cost(at++);
    const double seconds = in_lanes(costs);
    learn(costs.size(), seconds);
    thread += seconds;
  }
  return *std::max_element(free.begin(), free.end()) * lanes * static_cast<double>(count) / all;
}

// Studies of 200 to 4000 points on two to eight threads, of which a quarter and at the end three
// quarters are chaotic and thirty times as dear: they take less time than with pieces of any one
// size, small ones, whose lanes stand empty, and large ones, whose last one is waited for.
TEST(PieceSizes, DearPointsAtTheEndKeepNoThreadWaiting) {
  const auto takes = [](const auto& next_of) {
    double sum = 0.0;
    for (std::size_t points = 200; points < 4000; points += 190) {
      for (const int count : {2, 4, 8}) {
        PieceSizes sizes(most, count, lanes);
        sum += simulate(
            points, static_cast<std::size_t>(count),
            [&](std::size_t left) { return next_of(sizes, left); },
            [&](std::size_t size, double seconds) { sizes.learn(size, seconds); },
            [points](std::size_t point) {
              return point % 40 < 10 + 20 * point / points ? 0.3 : 0.01;
            });
      }
    }
    return sum;
  };
  const double ours = takes([](PieceSizes& sizes, std::size_t left) { return sizes.next(left); });
  for (const std::size_t size : {8, 16, 32, 64, 128, 256}) {
    EXPECT_LT(ours, takes([size](PieceSizes&, std::size_t left) { return std::min(size, left); }))
        << size;
  }
}

// Pieces become smaller, down to those that fill lanes twice; the last ones are of one size.
TEST(PieceSizes, PiecesShrinkTowardsTheEnd) {
  PieceSizes sizes(most, threads);
  std::vector<std::size_t> given;
  for (std::size_t left = 1000; left > 0; left -= given.back()) given.push_back(sizes.next(left));
  const auto shrinking = given.begin() + threads;  // behind the first ones
  EXPECT_TRUE(std::is_sorted(shrinking, given.end(), std::greater<>()));
  EXPECT_EQ(given.end()[-2], given.end()[-3]);
  EXPECT_LE(given.end()[-2], 32u);
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
