#include "libio/model/matrix_market.hpp"

#include <gtest/gtest.h>

#include <string>

namespace whirl::matrix_market_test {

Mat read(const std::string& text) {
  std::vector<Problem> problems;
  const Sparse A = parse_matrix_market(text, "A.mtx", problems);
  EXPECT_TRUE(problems.empty()) << problems.front().message;
  return Mat(A);
}

TEST(MatrixMarket, HasCoordinatesAndArrays) {
  Mat expected(2, 2);
  expected << 1.0, -2.5, 0.0, 4.0;
  EXPECT_EQ(read("%%MatrixMarket matrix coordinate real general\n% a comment\n\n2 2 3\n"
                 "1 1 1.0\n1 2 -2.5e0\n2 2 +4\n"),
            expected);
  EXPECT_EQ(read("%%MatrixMarket matrix array real general\n2 2\n1\n0\n-2.5\n4\n"), expected);
  expected(1, 0) = -2.5;
  EXPECT_EQ(
      read("%%matrixmarket MATRIX coordinate integer symmetric\r\n2 2 3\r\n1 1 1\r\n2 1 -2\r\n"
           "2 2 4\r\n")(0, 1),
      -2.0);
  EXPECT_EQ(read("%%MatrixMarket matrix array real symmetric\n2 2\n1\n-2.5\n4\n"), expected);
}

TEST(MatrixMarket, IsWrittenWithAllDigits) {
  const Mat A = Mat::Random(3, 3) / 3.0;
  EXPECT_EQ(read(matrix_market_text(A, "a comment")), A);
}

TEST(MatrixMarket, WrongFilesAreToldWithTheirLine) {
  const auto problem = [](const std::string& text) {
    std::vector<Problem> problems;
    EXPECT_EQ(parse_matrix_market(text, "A.mtx", problems).rows(), 0);
    EXPECT_EQ(problems.size(), 1u);
    return problems.empty() ? Problem{} : problems.front();
  };
  const std::string head = "%%MatrixMarket matrix coordinate real general\n";
  EXPECT_EQ(problem("").where.file, "A.mtx");
  EXPECT_EQ(problem("%%MatrixMarket matrix coordinate complex general\n1 1 0\n").where.line, 1);
  EXPECT_EQ(problem(head + "2 3 1\n1 1 1\n").where.line, 2);
  EXPECT_EQ(problem(head + "2 2 2\n1 1 1\n3 1 1\n").where.line, 4);
  EXPECT_EQ(problem(head + "2 2 2\n1 1 1\n").where.line, 3);
  EXPECT_EQ(problem(head + "2 2 1\n1 1 nan\n").where.line, 3);
  EXPECT_EQ(problem(head + "2 2 1\n1 1 1\n2 2 1\n").where.line, 4);
  EXPECT_NE(problem(head + "99999999999 99999999999 1\n").message.find("rows"), std::string::npos);
  EXPECT_NE(problem("%%MatrixMarket matrix array real general\n99999 99999\n").message.find("4000"),
            std::string::npos);
}

}  // namespace whirl::matrix_market_test
