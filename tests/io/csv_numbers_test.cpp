// Numbers in tables of CSV: rows without an axis count from 1, what is no number is an empty cell.

#include <limits>

#include "libio/results/csv_tables.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::csv_numbers_test {

class CsvNumbers : public test::InResultFolder {};

TEST_F(CsvNumbers, WithoutAnAxisAreCountedFromOne) {
  constexpr int rows = 20;  // more than are spread over columns
  std::vector<double> length;
  for (int i = 0; i < rows; ++i) length.push_back(0.5 * i);
  length[1] = std::numeric_limits<double>::quiet_NaN();
  length[2] = std::numeric_limits<double>::infinity();
  {
    ResultWriter out(path, Replaces::anything);
    out.dataset("/shaft/length", length, {"m", "length", {""}});
    out.commit();
  }
  const auto files = write_csv_tables(ResultReader(path), folder / "t");
  ASSERT_EQ(files.size(), 1u);
  const std::string text = test::content(files[0]);
  EXPECT_EQ(text.substr(0, text.find("4,")), "number,length [m]\n1,0\n2,\n3,\n");
  EXPECT_TRUE(text.ends_with("\n20,9.5\n")) << text;
}

TEST_F(CsvNumbers, OfAnEmptyTableAreItsFirstLine) {
  {
    ResultWriter out(path, Replaces::anything);
    out.dataset("/a/x", std::vector<double>{1.0, 2.0}, {"m", "x", {""}});
    out.dataset("/a/none", std::vector<double>{}, {"s", "none", {""}});
    out.dataset("/a/z", std::vector<double>{}, {2, 0}, {"", "z", {"/a/x", "/a/none"}});
    out.commit();
  }
  const auto files = write_csv_tables(ResultReader(path), folder / "t");
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(test::content(files[0]), "x [m],none [s],z\n");
}

// A table is read in blocks: rows along two axes, some of whose numbers are of several columns and
// one along the second axis first, are in their places across the blocks' borders.
TEST_F(CsvNumbers, OfLongTablesAreInTheirPlaces) {
  constexpr int rows = 70'001, wide = 2;  // more than 2^16
  std::vector<double> axis(rows), pair(rows * wide), turned(wide * rows);
  for (int i = 0; i < rows; ++i) {
    const auto k = static_cast<std::size_t>(i);
    axis[k] = i;
    for (std::size_t j = 0; j < 2; ++j) {
      pair[2 * k + j] = 10.0 * i + static_cast<double>(j);
      turned[j * rows + k] = -pair[2 * k + j];
    }
  }
  {
    ResultWriter out(path, Replaces::anything);
    out.dataset("/a/x", axis, {"m", "x", {""}});
    out.dataset("/a/name", std::vector<std::string>{"left", "right"}, {"", "name", {""}});
    out.dataset("/a/pair", pair, {rows, wide}, {"", "pair", {"/a/x", "/a/name"}});
    out.dataset("/a/turned", turned, {wide, rows}, {"", "turned", {"/a/name", "/a/x"}});
    out.dataset("/b/y", std::vector<double>{0.25, 0.5}, {"", "y", {""}});
    out.dataset("/b/plane", turned, {wide, rows}, {"", "plane", {"/b/y", "/a/x"}});
    out.commit();
  }
  const auto files = write_csv_tables(ResultReader(path), folder / "t");
  ASSERT_EQ(files.size(), 2u);
  std::ifstream a(files[0]), b(files[1]);
  std::string line;
  std::getline(a, line);
  EXPECT_EQ(line, "x [m],pair left,pair right,turned left,turned right");
  for (int i = 0; i < rows; ++i) {
    std::getline(a, line);
    const std::string expected = std::to_string(i) + ',' + std::to_string(10 * i) + ',' +
                                 std::to_string(10 * i + 1) + ",-" + std::to_string(10 * i) + ",-" +
                                 std::to_string(10 * i + 1);
    ASSERT_EQ(line, expected);
  }
  EXPECT_FALSE(std::getline(a, line));
  std::getline(b, line);
  EXPECT_EQ(line, "y,x [m],plane");
  for (int j = 0; j < wide; ++j) {
    for (int i = 0; i < rows; ++i) {
      std::getline(b, line);
      const std::string number = std::to_string(10 * i + j);
      ASSERT_EQ(line, (j == 0 ? "0.25," : "0.5,") + std::to_string(i) + ",-" + number);
    }
  }
  EXPECT_FALSE(std::getline(b, line));
}

}  // namespace whirl::csv_numbers_test
