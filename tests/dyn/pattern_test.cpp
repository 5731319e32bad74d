// Which rows of K and D are made side by side.

#include "libdyn/taylor/pattern.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace whirl::pattern_test {

using Rows = Pattern::CoupledRows;

/// The rows of K with coefficients beside the diagonal where `has` says so.
template <class Has>
std::vector<Rows> rows(int n, const Has& has) {
  std::vector<Rows> all;
  for (int i = 0; i < n; ++i) {
    Rows row{.rows = {i}, .of_x = {}, .of_rate = {}};
    for (int j = 0; j < n; ++j) {
      if (i != j && has(i, j)) row.of_x.push_back(j);
    }
    all.push_back(row);
  }
  return all;
}

TEST(Pattern, MakesRowsOfAFullMatrixSideBySide) {
  const auto found = side_by_side(rows(9, [](int, int) { return true; }));
  ASSERT_EQ(found.size(), 3u);
  std::vector<int> every(9);
  std::iota(every.begin(), every.end(), 0);
  EXPECT_EQ(found[0].rows, (std::vector{0, 1, 2, 3}));
  EXPECT_EQ(found[0].of_x, every);
  EXPECT_EQ(found[0].coefficients(), 36);
  EXPECT_EQ(found[1].rows, (std::vector{4, 5, 6, 7}));
  EXPECT_EQ(found[2].rows, std::vector{8});
  EXPECT_EQ(found[2].coefficients(), 8);
}

// Four rows of pairs would have eight zeros for four coefficients.
TEST(Pattern, LeavesRowsOfAFewCoefficientsAlone) {
  const auto found = side_by_side(rows(8, [](int i, int j) { return i / 2 == j / 2; }));
  ASSERT_EQ(found.size(), 8u);
  for (const Rows& row : found) EXPECT_EQ(row.coefficients(), 1);
}

TEST(Pattern, LeavesRowsWithoutAnyOut) {
  EXPECT_TRUE(side_by_side(rows(8, [](int, int) { return false; })).empty());
  const auto found = side_by_side(rows(5, [](int i, int) { return i == 2; }));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].rows, std::vector{2});
}

}  // namespace whirl::pattern_test
