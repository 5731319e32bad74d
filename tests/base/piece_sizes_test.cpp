// How points of a study are cut into pieces: threads busy, results soon, lanes full.

#include "libbase/piece_sizes.hpp"

#include <gtest/gtest.h>

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
