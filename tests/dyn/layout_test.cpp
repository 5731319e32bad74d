// Where the parts of a state stand: each view sees its part, and writes into it.

#include "libdyn/system/layout.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace whirl::layout_test {

const StateLayout layout(3);

TEST(StateLayout, HasRatesBehindDisplacements) {
  EXPECT_EQ(layout.size(), 6);
  EXPECT_EQ(StateLayout::of(6).coordinates(), 3);
  const Vec y = Vec::LinSpaced(6, 0.0, 5.0);
  EXPECT_EQ(Vec(layout.eta(y)), Vec::LinSpaced(3, 0.0, 2.0));
  EXPECT_EQ(Vec(layout.rate(y)), Vec::LinSpaced(3, 3.0, 5.0));
  EXPECT_EQ(Vec(layout.eta(y.data())), Vec(layout.eta(y)));
  EXPECT_EQ(Vec(layout.rate(y.data())), Vec(layout.rate(y)));
  EXPECT_EQ(y(layout.place_of_rate(1)), 4.0);
  EXPECT_EQ(*layout.rates_at(y.data()), 3.0);
  EXPECT_EQ(layout.end(y.data()), y.data() + y.size());
}

TEST(StateLayout, GivesViewsThatAreWrittenTo) {
  Vec y = Vec::Zero(6);
  layout.eta(y) = Vec::Ones(3);
  layout.rate(y.data()) = Vec::Constant(3, 2.0);
  EXPECT_EQ(y, (Vec(6) << 1.0, 1.0, 1.0, 2.0, 2.0, 2.0).finished());
  Mat states = Mat::Zero(6, 2);
  layout.rate(states).col(1) = Vec::Ones(3);
  EXPECT_EQ(states.col(0), Vec::Zero(6));
  const Vec second = states.col(1);
  EXPECT_EQ(Vec(layout.rate(second)), Vec::Ones(3));
  Mat by_state = Mat::Zero(1, 6);
  layout.rate_columns(by_state).setOnes();
  EXPECT_EQ(Mat(layout.eta_columns(by_state)), Mat::Zero(1, 3));
}

// y' = A y of eta'' + D eta' + K eta = 0, number by number.
TEST(StateLayout, MakesOneFirstOrderSystem) {
  const Mat K = Mat::Random(3, 3), D = Mat::Random(3, 3);
  const Vec y = Vec::Random(6), dy = layout.first_order(K, D) * y;
  EXPECT_EQ(Vec(layout.eta(dy)), Vec(layout.rate(y)));
  const Vec a = -K * layout.eta(y) - D * layout.rate(y);
  EXPECT_LT((layout.rate(dy) - a).norm(), 1e-15);
}

TEST(StateLayout, DoesTheSameToBothParts) {
  const Mat m = Mat::Random(3, 3);
  const Vec y = Vec::Random(6), moved = layout.to_both(m) * y;
  EXPECT_LT((layout.eta(moved) - m * layout.eta(y)).norm(), 1e-15);
  EXPECT_LT((layout.rate(moved) - m * layout.rate(y)).norm(), 1e-15);
}

}  // namespace whirl::layout_test
