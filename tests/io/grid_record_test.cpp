// Points of a grid as arrays of JSON.

#include "libio/results/grid_record.hpp"

#include <gtest/gtest.h>

namespace whirl::grid_record_test {

struct Row {
  double x = 0.0;  // [m]

  static constexpr auto columns() { return ColumnList{column("x", &Row::x, "m", "place")}; }
};

// the last axis runs fastest, as in ParameterGrid
TEST(GridRecord, HasAnArrayForEveryAxis) {
  const ParameterGrid grid{.axes = {{1.0, 2.0}, {1.0, 2.0, 3.0}}};
  Record expected, first = Record::array(), second = Record::array(), both = Record::array();
  for (const double x : {0.0, 1.0, 2.0}) first.add(x), second.add(x + 3.0);
  both.add(first), both.add(second);
  expected.set("x_m", both);
  EXPECT_EQ(grid_record<Row>({{0.0}, {1.0}, {2.0}, {3.0}, {4.0}, {5.0}}, grid).json(),
            expected.json());
}

TEST(GridRecord, OfNoAxisIsOneValue) {
  Record expected;
  expected.set("x_m", 7.0);
  EXPECT_EQ(grid_record<Row>({{7.0}}, {}).json(), expected.json());
}

}  // namespace whirl::grid_record_test
