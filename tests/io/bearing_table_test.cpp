// Bearing coefficients over speed, from CSV.

#include "libio/model/bearing_table.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace whirl::bearing_table_test {

constexpr double rpm = std::numbers::pi / 30.0;

/// A table that must be in order.
CoefficientTable table(const std::string& text) {
  std::vector<Problem> problems;
  const CoefficientTable result = parse_bearing_table(text, "bearing.csv", problems);
  for (const Problem& p : problems) ADD_FAILURE() << describe(p);
  return result;
}

/// What is wrong with a table, a line each.
std::string problems(const std::string& text) {
  std::vector<Problem> found;
  parse_bearing_table(text, "bearing.csv", found);
  std::string all;
  for (const Problem& p : found) all += describe(p) + "\n";
  return all;
}

TEST(BearingTable, ReadsEveryColumnInSi) {
  const CoefficientTable t = table(
      "speed,kxx,kxy,kyx,kyy,cxx,cxy,cyx,cyy,"
      "ktxx,ktxy,ktyx,ktyy,ctxx,ctxy,ctyx,ctyy\n"
      "10,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16\n"
      "20,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0\n");
  EXPECT_EQ(t.speed, (std::vector<double>{10.0, 20.0}));
  ASSERT_EQ(t.rows.size(), 2u);
  EXPECT_EQ(t.rows[0].K, (Mat2() << 1, 2, 3, 4).finished());
  EXPECT_EQ(t.rows[0].C, (Mat2() << 5, 6, 7, 8).finished());
  EXPECT_EQ(t.rows[0].Kt, (Mat2() << 9, 10, 11, 12).finished());
  EXPECT_EQ(t.rows[0].Ct, (Mat2() << 13, 14, 15, 16).finished());
}

TEST(BearingTable, UnitsStandInBracketsOrWithTheValue) {
  const CoefficientTable t = table(
      "speed [rpm], kxx [MN/m], cxx [N.s/mm], ktxx, kyy\n"
      "1000, 4, 5, 2 kN.m/rad, 7 N/mm\n");
  EXPECT_DOUBLE_EQ(t.speed[0], 1000.0 * rpm);
  EXPECT_DOUBLE_EQ(t.rows[0].K(0, 0), 4e6);
  EXPECT_DOUBLE_EQ(t.rows[0].C(0, 0), 5e3);
  EXPECT_DOUBLE_EQ(t.rows[0].Kt(0, 0), 2e3);
  EXPECT_DOUBLE_EQ(t.rows[0].K(1, 1), 7e3);
}

TEST(BearingTable, WhatIsAbsentIsZero) {
  const CoefficientTable t = table("speed,kxx\n1,5\n");
  EXPECT_EQ(t.rows[0].K(1, 1), 0.0);
  EXPECT_EQ(t.rows[0].C, Mat2::Zero());
}

TEST(BearingTable, CommentsBlanksQuotesAndSemicolonsAreFine) {
  const CoefficientTable t = table(
      "\xEF\xBB\xBF# from a seal code\r\n"
      "\r\n"
      "\"speed [rad/s]\" ; \"kxx\" ; \"kyy\"\r\n"
      "# the first\r\n"
      "  1 ; 2 ; 3  \r\n"
      "\r\n"
      "4;5;6");
  EXPECT_EQ(t.speed, (std::vector<double>{1.0, 4.0}));
  EXPECT_EQ(t.rows[1].K(1, 1), 6.0);
}

TEST(BearingTable, ProblemsNameTheirLines) {
  EXPECT_EQ(problems("speed,kxx\n1,2\n# comment\n3,4 N.s/m\n5\n5,x\n"),
            "bearing.csv:4:1: kxx: found \"4 N.s/m\", expected a stiffness (N/m)\n"
            "bearing.csv:5:1: found 1 columns, expected 2 as in the first line\n"
            "bearing.csv:6:1: kxx: \"x\" is not a number, expected a stiffness (N/m)\n");
}

TEST(BearingTable, ColumnsThatCannotBe) {
  EXPECT_EQ(problems("spead,kxx\n1,2\n"),
            "bearing.csv:1:1: spead: unknown column, did you mean \"speed\"?\n"
            "bearing.csv:1:1: the first column must be speed\n");
  EXPECT_NE(problems("speed,damping\n1,2\n").find("unknown column, known are speed, kxx"),
            std::string::npos);
  EXPECT_EQ(problems("kxx,speed\n1,2\n"), "bearing.csv:1:1: the first column must be speed\n");
  EXPECT_EQ(problems("speed,kxx,kxx\n1,2,3\n"),
            "bearing.csv:1:1: kxx: this column is there already\n");
}

TEST(BearingTable, AWrongUnitIsSaidOnce) {
  EXPECT_EQ(
      problems("speed [rpm],kxx [Pa]\n1,2\n3,4\n5,6\n"),
      "bearing.csv:1:1: kxx: the unit [Pa] does not fit: found \"1 Pa\", expected a stiffness "
      "(N/m)\n");
}

TEST(BearingTable, SpeedsMustAscend) {
  EXPECT_EQ(problems("speed,kxx\n1,1\n2,1\n2,1\n"),
            "bearing.csv:4:1: speed: speeds must ascend from line to line\n");
}

TEST(BearingTable, NumbersMustBeFinite) {
  EXPECT_NE(problems("speed,kxx\n1,nan\n").find("\"nan\" is not a number"), std::string::npos);
  EXPECT_NE(problems("speed,kxx\n1,1e999\n").find("beyond the range"), std::string::npos);
  EXPECT_NE(problems("speed,kxx\n1,\n").find("is not a number"), std::string::npos);
}

TEST(BearingTable, ATableWithoutRowsIsNone) {
  for (const char* text : {"", "\n\n", "# nothing\n", "speed,kxx\n"}) {
    EXPECT_NE(problems(text).find("bearing.csv: the table has no rows"), std::string::npos) << text;
  }
}

}  // namespace whirl::bearing_table_test
