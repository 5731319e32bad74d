// What many numbers are like.

#include "libbase/numerics/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace whirl::statistics_test {

TEST(Median, IsInTheMiddle) {
  EXPECT_EQ(median_of({3.0}), 3.0);
  EXPECT_EQ(median_of({9.0, 1.0, 4.0}), 4.0);
  EXPECT_EQ(median_of({9.0, 1.0, 4.0, 2.0}), 3.0);
}

TEST(StandardDeviation, IsTheRootOfTheMeanSquareFromTheMean) {
  EXPECT_EQ(standard_deviation(Vec{{7.0, 7.0, 7.0}}), 0.0);
  EXPECT_DOUBLE_EQ(standard_deviation(Vec{{1.0, 2.0, 3.0, 4.0}}), std::sqrt(1.25));
}

}  // namespace whirl::statistics_test
