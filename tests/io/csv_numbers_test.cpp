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

}  // namespace whirl::csv_numbers_test
