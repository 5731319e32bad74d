// Which motions a picture shows apart, as others are far away.

#include "libio/drawing/near_range.hpp"

#include <gtest/gtest.h>

namespace whirl::near_range_test {

/// Motions about zero, as far as these numbers.
std::vector<Extent> about_zero(const std::vector<double>& sizes) {
  std::vector<Extent> extents;
  for (const double s : sizes) extents.push_back({-s, s});
  return extents;
}

// A dry whip of 150 mm beside branches of 0.2 mm, though most motions are of the whip.
TEST(NearRange, IsThatOfTheSmallMotionsHoweverManyAreFar) {
  const auto near = near_range(about_zero({0.05, 0.1, 0.2, 114, 120, 130, 140, 145, 149, 150}));
  ASSERT_TRUE(near);
  EXPECT_EQ(near->low, -0.2);
  EXPECT_EQ(near->high, 0.2);
}

TEST(NearRange, IsOfTheOthersWhereOneIsFar) {
  std::vector<Extent> extents(40, {0.9, 1.1});
  extents.push_back({0.8, 1.2});
  extents.push_back({-50.0, 1.0});
  const auto near = near_range(extents);
  ASSERT_TRUE(near);
  EXPECT_EQ(near->low, 0.8);
  EXPECT_EQ(near->high, 1.2);
}

TEST(NearRange, IsNoneWhereSizesGrowWithoutAGapOrNotFar) {
  EXPECT_FALSE(near_range({}));
  EXPECT_FALSE(near_range({{0.0, 1.0}}));
  EXPECT_FALSE(near_range(about_zero({0, 0, 0, 0, 1})));           // a line, which needs no room
  EXPECT_FALSE(near_range(about_zero({1, 1, 1, 9})));              // below ten times
  EXPECT_FALSE(near_range(about_zero({1, 2, 4, 8, 16, 32, 64})));  // a resonance
  EXPECT_FALSE(near_range(about_zero({0.1, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5})));
  EXPECT_TRUE(near_range(about_zero({0.1, 5, 5, 5, 5, 5, 5, 5, 5, 5})));  // a tenth of all
}

}  // namespace whirl::near_range_test
