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
            "bearing.csv:4:3: kxx: found \"4 N.s/m\", expected a stiffness (N/m)\n"
            "bearing.csv:5:2: found 1 columns, expected 2 as in the first line\n"
            "bearing.csv:6:3: kxx: \"x\" is not a number, expected a stiffness (N/m)\n");
}

TEST(BearingTable, ColumnsThatCannotBe) {
  EXPECT_EQ(problems("spead,kxx\n1,2\n"),
            "bearing.csv:1:1: spead: unknown column, did you mean \"speed\"?\n");
  EXPECT_EQ(problems("speed,eccentricity\n1,2\n"),
            "bearing.csv:1:1: a column of coefficients is missing, such as kxx [N/m] or cxx "
            "[N.s/m]\n");
  EXPECT_EQ(problems("kxx,kyy\n1,2\n"),
            "bearing.csv:1:1: a column of speeds or of whirl frequencies is missing: name it speed "
            "or whirl\n");
  EXPECT_EQ(problems("speed,kxx,kxx\n1,2,3\n"),
            "bearing.csv:1:11: kxx: this column is there already\n");
}

TEST(BearingTable, AWrongUnitIsSaidOnce) {
  EXPECT_EQ(
      problems("speed [rpm],kxx [Pa]\n1,2\n3,4\n5,6\n"),
      "bearing.csv:1:13: kxx: the unit [Pa] does not fit: found \"1 Pa\", expected a stiffness "
      "(N/m)\n");
}

// Speeds from the highest on are put in order; numbers of axes for letters, and units in brackets.
TEST(BearingTable, SpeedsMayDescendAndAxesHaveNumbers) {
  const CoefficientTable t =
      table("Drehzahl [U/min];K11 [N/mm];K12 [N/mm];C22 [N/(m/s)]\n9000;3;30;300\n3000;1;10;100\n");
  EXPECT_DOUBLE_EQ(t.speed[0], 3000.0 * rpm);
  EXPECT_DOUBLE_EQ(t.rows[0].K(0, 0), 1e3);
  EXPECT_DOUBLE_EQ(t.rows[0].K(0, 1), 10e3);
  EXPECT_DOUBLE_EQ(t.rows[1].C(1, 1), 300.0);
}

TEST(BearingTable, SpeedsMustAscend) {
  EXPECT_EQ(problems("speed,kxx\n1,1\n2,1\n2,1\n"),
            "bearing.csv:4:1: speed: speeds must ascend from line to line\n");
}

TEST(BearingTable, SpeedsAreZeroOrMore) {
  EXPECT_EQ(problems("speed [rpm],kxx\n-1000,1\n0,1\n1000,1\n"),
            "bearing.csv:2:1: speed: found \"-1000\", expected a speed (rad/s) of zero or more\n");
}

TEST(BearingTable, NumbersMustBeFinite) {
  EXPECT_NE(problems("speed,kxx\n1,nan\n").find("\"nan\" is not a number"), std::string::npos);
  EXPECT_NE(problems("speed,kxx\n1,1e999\n").find("beyond the range"), std::string::npos);
  EXPECT_EQ(problems("speed,kxx\n1,\n"),
            "bearing.csv:2:3: kxx: missing, expected a stiffness (N/m)\n");
}

TEST(BearingTable, ATableWithoutRowsIsNone) {
  for (const char* text : {"", "\n\n", "# nothing\n", "speed,kxx\n"}) {
    EXPECT_NE(problems(text).find("bearing.csv: the table has no rows"), std::string::npos) << text;
  }
}

// ---- mass, whirl frequencies ----

TEST(BearingTable, ReadsAddedMass) {
  const CoefficientTable t = table("speed,mxx,mxy,myx,myy [g]\n1,2,3,4,5\n");
  EXPECT_EQ(t.rows[0].M, (Mat2() << 2, 3, 4, 5e-3).finished());
}

TEST(BearingTable, ReadsWhirlFrequencies) {
  const CoefficientTable t = table("whirl [Hz],kxx\n0,1\n10,2\n");
  EXPECT_TRUE(t.speed.empty());
  EXPECT_DOUBLE_EQ(t.whirl[1], 20.0 * std::numbers::pi);
  EXPECT_EQ(problems("whirl,kxx\n5,1\n5,2\n"),
            "bearing.csv:3:1: whirl: whirl frequencies must ascend from line to line\n");
  EXPECT_EQ(problems("whirl,kxx\n-5,1\n"),
            "bearing.csv:2:1: whirl: found \"-5\", expected a speed (rad/s) of zero or more\n");
}

// Rows over both in any order: speeds one after another, or frequencies.
TEST(BearingTable, RowsOverBothMayComeInAnyOrder) {
  const CoefficientTable t = table("whirl,speed,kxx\n1,10,1\n1,20,3\n5,10,2\n5,20,4\n");
  EXPECT_EQ(t.speed, (std::vector<double>{10, 10, 20, 20}));
  EXPECT_EQ(t.whirl, (std::vector<double>{1, 5, 1, 5}));
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(t.rows[i].K(0, 0), static_cast<double>(i + 1));
  EXPECT_EQ(problems("speed,whirl,kxx\n1,1,5\n1,2,5\n1,1,5\n"),
            "bearing.csv:4:1: whirl: this speed and whirl frequency are in line 2 already\n");
}

// ---- what other programs write ----

constexpr double lbf = 4.4482216152605;  // [N]
constexpr double inch = 0.0254;          // [m]

/// A table of a bearing in US units, as many programs print it.
void expect_us(const CoefficientTable& t) {
  ASSERT_EQ(t.rows.size(), 2u);
  EXPECT_DOUBLE_EQ(t.speed[1], 6000.0 * rpm);
  EXPECT_NEAR(t.rows[0].K(0, 0), 1.5e5 * lbf / inch, 1e-6);
  EXPECT_NEAR(t.rows[0].K(0, 1), -2e4 * lbf / inch, 1e-6);
  EXPECT_NEAR(t.rows[1].C(1, 1), 250.0 * lbf / inch, 1e-9);
}

TEST(BearingTable, UsUnitsInEverySpelling) {
  const std::string rows = "5000,1.5e5,-2e4,200\n6000,1.4e5,-1e4,250\n";
  for (const char* header : {"Speed (rpm),Kxx (lb/in),Kxy (lbf/in),Cyy (lb-s/in)\n",
                             "RPM,KXX [lbf/in],K_xy [lb/in],C_yy [lbf.s/in]\n",
                             "N,K-xx (lbs/in),kxy lbf/in,Cyy (lb*sec/in)\n",
                             "Rotor speed [cpm],Kxx,Kxy,Cyy\nrpm,lb/in,lb/in,lb-s/in\n",
                             "Speed,Kxx,Kxy,Cyy\n(RPM),(lb/in),(lb/in),(lbf-sec/in)\n",
                             "speed rpm,\"Kxx, lb/in\",kxy_lb/in,Cyy lb-s/in\n"}) {
    SCOPED_TRACE(header);
    expect_us(table(header + rows));
  }
  const CoefficientTable t =
      table("Speed (rpm),Kxx (klb/in),Mxx (lb-s^2/in),Myy (lb),Ktxx (lb-in/rad)\n1000,2,3,4,5\n");
  EXPECT_NEAR(t.rows[0].K(0, 0), 2e3 * lbf / inch, 1e-6);
  EXPECT_NEAR(t.rows[0].M(0, 0), 3.0 * lbf / inch, 1e-9);
  EXPECT_NEAR(t.rows[0].M(1, 1), 4.0 * 0.45359237, 1e-12);
  EXPECT_NEAR(t.rows[0].Kt(0, 0), 5.0 * lbf * inch, 1e-12);
}

TEST(BearingTable, AnyDelimiterAndOrder) {
  for (const char* text :
       {"Kxx (lb/in)\tCyy (lb-s/in)\tSpeed (rpm)\tKxy (lb/in)\n1.5e5\t200\t5000\t-2e4\n1.4e5\t250\t"
        "6000\t-1e4\n",
        "Kxx (lb/in)   Cyy (lb-s/in)  Rotor speed (rpm)  Kxy (lb/in)\n  1.5e5 200 5000 -2e4\n  "
        "1.4E+5  "
        "250  6000   -1.D4\n",
        "Kxx;Cyy;Speed;Kxy\nlb/in;lb-s/in;rpm;lb/"
        "in\n150000,0;200,0;5000;-2e4\n1,4e5;250;6000;-10000,00;\n"}) {
    SCOPED_TRACE(text);
    expect_us(table(text));
  }
}

TEST(BearingTable, FrequenciesByTheirNames) {
  for (const char* name :
       {"Freq (Hz)", "Whirl [Hz]", "Excitation frequency (Hz)", "Frequency Hz", "Hz"}) {
    SCOPED_TRACE(name);
    const CoefficientTable t =
        table(std::string(name) + ",Speed (rpm),kxx\n10,1000,1\n20,1000,2\n");
    ASSERT_EQ(t.whirl.size(), 2u);
    EXPECT_DOUBLE_EQ(t.whirl[1], 40.0 * std::numbers::pi);
  }
  EXPECT_DOUBLE_EQ(table("CPM,kxx\n30,1\n60,2\n").whirl[1], 60.0 * rpm);
}

// Names of other programs without a unit do not mean SI.
TEST(BearingTable, WhatIsNotUnderstoodIsNamed) {
  EXPECT_EQ(
      problems("rotor speed,kxx\n1,2\n"),
      "bearing.csv:1:1: speed: its unit is missing; write it behind the name, such as [rpm] or "
      "[Hz], or in a line of units below\n");
  std::vector<Problem> wrong, told;
  const CoefficientTable read = parse_bearing_table(
      "Speed (rpm),Kxx (lb/in),Kyy (lb/in),Eccentricity\n1,2,2,3\n", "b.csv", wrong, &told);
  EXPECT_TRUE(wrong.empty());
  EXPECT_EQ(read.rows.size(), 1u);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(describe(told[0]).find("b.csv:1:37: Eccentricity: this column is not known and not "),
            0u);
  EXPECT_EQ(
      problems("Speed (rpm),Kxx (furlong)\n1,2\n"),
      "bearing.csv:1:13: kxx: the unit [furlong] does not fit: unknown unit \"furlong\" in \"1 "
      "furlong\", expected a stiffness (N/m)\n");
  EXPECT_EQ(
      problems("speed,kxx\nrpm,lb-s\n1,2\n"),
      "bearing.csv:2:5: kxx: the unit [lb-s] does not fit: cannot read the unit in \"1 lb-s\", "
      "expected a stiffness (N/m)\n");
  EXPECT_EQ(problems("speed kxx\n1 2\n2 1,500\n"),
            "bearing.csv:3:3: kxx: the comma in \"1,500\" may be that of thousands or of decimals, "
            "and no other number of this table shows which; write 1500 or 1.5\n");
}

// ---- numbers that may be read in two ways ----

// 410,000 lb/in are read as 410 lb/in where a comma is one of decimals: a factor of a thousand.
TEST(BearingTable, ACommaBeforeThreeDigitsIsDecimalOnlyWhereOthersShowIt) {
  const auto kxx = [](const std::string& rows) {
    return table("rpm;kxx\n" + rows).rows[0].K(0, 0);
  };
  EXPECT_EQ(kxx("1000;410,125\n2000;0,5\n"), 410.125);
  EXPECT_EQ(kxx("1000;410,125\n2000;12,25\n"), 410.125);
  EXPECT_EQ(kxx("1000;410,125\n2000;0,500\n"), 410.125);     // no thousand begins with 0
  EXPECT_EQ(kxx("1000;410,125\n2000;4100,000\n"), 410.125);  // nor has four digits before it
  EXPECT_EQ(kxx("1000;1,250E+6\n2000;2\n"), 1.25e6);         // nor an exponent
  EXPECT_EQ(kxx("1000;410.000\n2000;2\n"), 410.0);           // a point is that of whirl
  EXPECT_EQ(table("rpm\tkxx\n1000\t410,125\n2000\t0,5\n").rows[0].K(0, 0), 410.125);

  EXPECT_EQ(problems("rpm;kxx\n1000;410,000\n2000;0.5\n"),
            "bearing.csv:2:6: kxx: the comma in \"410,000\" may be that of thousands or of "
            "decimals, and other numbers of this table have decimal points; write 410000 or "
            "410.0\n");
  EXPECT_EQ(problems("rpm;kxx\n1000;-5,250 N/m\n2000;5\n"),
            "bearing.csv:2:6: kxx: the comma in \"-5,250 N/m\" may be that of thousands or of "
            "decimals, and no other number of this table shows which; write -5250 or -5.25\n");
  EXPECT_EQ(problems("rpm;kxx;cxx\n1000;410,000;0.5\n2000;5;0,5\n"),
            "bearing.csv:2:6: kxx: the comma in \"410,000\" may be that of thousands or of "
            "decimals, and other numbers of this table have decimal commas and points; write "
            "410000 or 410.0\n");
  EXPECT_EQ(problems("rpm;kxx\n1000;410.000\n2000;0,5\n"),
            "bearing.csv:2:6: kxx: the point in \"410.000\" may be that of thousands or of "
            "decimals, and other numbers of this table have decimal commas; write 410000 or "
            "410,0\n");
  EXPECT_NE(problems("rpm,kxx\n1000,\"410,000\"\n").find("write 410000 or 410.0"),
            std::string::npos);
}

// ---- what people write around a table ----

// A title above, remarks beside, a note below, as in the workbooks of vendors.
TEST(BearingTable, LeavesOutWhatPeopleWriteAroundIt) {
  const CoefficientTable plain = table("rpm,Kxx (N/m),Kyy (N/m)\n3000,1e7,2e7\n7000,3e7,4e7\n");
  for (const char* text :
       {"Bearing DE, cold oil\nrpm,Kxx (N/m),Kyy (N/m)\n3000,1e7,2e7\n7000,3e7,4e7\n",
        "Bearing DE, cold oil\n\nspeed,Kxx,Kyy\nrpm,N/m,N/m\n3000,1e7,2e7\n7000,3e7,4e7\n",
        "rpm,Kxx (N/m),Kyy (N/m)\n3000,1e7,2e7\n7000,3e7,4e7\n,,\ncalculated for ISO VG 32,,\n",
        "rpm,Kxx (N/m),Kyy (N/m)\n3000,1e7,2e7,cold\n7000,3e7,4e7,\n",
        "rpm,Kxx (N/m),Kyy (N/m),Remark\n3000,1e7,2e7,cold\n7000,3e7,4e7,\n",
        "Comment,rpm,Kxx (N/m),Kyy (N/m)\n,3000,1e7,2e7\nhot 2,7000,3e7,4e7\n"}) {
    const CoefficientTable found = table(text);
    ASSERT_EQ(found.rows.size(), 2u) << text;
    EXPECT_EQ(found.speed, plain.speed) << text;
    for (const std::size_t i : {0u, 1u}) EXPECT_EQ(found.rows[i].K, plain.rows[i].K) << text;
  }
  // nothing with a number in it is a note
  EXPECT_NE(problems("rpm,kxx\n1000,2\nx2000,3\n").find("bearing.csv:3:1"), std::string::npos);
  EXPECT_NE(problems("rpm,kxx\n1000,2\nword\n2000,3\n").find("bearing.csv:3"), std::string::npos);
}

// ---- one cause is told once, where it is ----

TEST(BearingTable, TitlesMayBeginWithADigitAndTotalsAreNoRows) {
  const CoefficientTable t = table(
      "5 pad bearing LBP\nDate: 3/4/2024\n2.5 in journal\nrpm, Kxx (lb/in), Kyy (lb/in)\n"
      "4000, 2500, 2500\n8000, 2000, 2000\ntotal weight, 3181,\n");
  ASSERT_EQ(t.rows.size(), 2u);
  EXPECT_NEAR(t.speed[1], 8000 * rpm, 1e-9);
}

TEST(BearingTable, DatesAboveAndStatisticsBelowAreNoRows) {
  for (const std::string date : {"2026-11-29,14:30", "29.11.2026 14:30", "11/29/2026", "1-2-26"}) {
    const CoefficientTable t = table(date + "\nrpm,kxx,kyy\n4000,2,3\n8000,4,5\n" +
                                     "Mean,3,4\nStd. deviation,1,1\nMax,4,5\n");
    ASSERT_EQ(t.rows.size(), 2u) << date;
    EXPECT_NEAR(t.speed[1], 8000 * rpm, 1e-9);
  }
  // numbers that are no dates
  EXPECT_NE(problems("1000.5,2,3\nrpm,kxx,kyy\n5000,1,2\n").find("found numbers"),
            std::string::npos);
}

TEST(BearingTable, OneCauseIsToldOnceWithItsRows) {
  EXPECT_EQ(
      problems("rpm;kxx\n4,000;1\n8,000;2\n12,000;3\n"),
      "bearing.csv:2:1: speed: the comma in \"4,000\" may be that of thousands or of "
      "decimals, and no other number of this table shows which; write 4000 or 4.0; and 2 more "
      "rows\n");
  EXPECT_EQ(
      problems("rpm,kxx,cxx\n1000,2,1,3,1\n2000,2,2,3,2\n"),
      "bearing.csv:2:10: found 5 columns, expected 3 as in the first line; numbers with commas "
      "need semicolons between them; and 1 more row\n");
  EXPECT_EQ(
      problems("4000;1;2\nrpm;kxx;kyy\n5000;1;2\n")
          .find("bearing.csv:1:1: found numbers, expected a line with the names of the columns "
                "first: speed, whirl, kxx"),
      0u);
}

TEST(BearingTable, NamesMayStandInACommentRightAboveTheNumbers) {
  const CoefficientTable t =
      table("% some maker\n# Speed (rpm); Kxx (N/m); Kyy (N/m)\n1000;2;3\n2000;4;5\n");
  EXPECT_DOUBLE_EQ(t.speed[1], 2000.0 * rpm);
  EXPECT_EQ(t.rows[1].K(1, 1), 5.0);
  EXPECT_EQ(problems("# Speed; Eccentricity\n1000;2\n").find("bearing.csv:2:1: found numbers"),
            0u);  // one name is none
  EXPECT_EQ(problems("# Speed (rpm); Kxx (Pa)\n1000;2\n").find("bearing.csv:1:16: kxx: the unit"),
            0u);
  // a comment above a line of names stays one
  EXPECT_DOUBLE_EQ(table("# speed, kxx\nrpm;kxx\n1000;2\n").speed[0], 1000.0 * rpm);
}

// A vendor's table without kyy is one of a bearing that holds nothing up.
TEST(BearingTable, AColumnThatMayBeForgottenIsDoubted) {
  const auto doubts = [](const std::string& text) {
    std::vector<Problem> wrong, found;
    parse_bearing_table(text, "bearing.csv", wrong, &found);
    EXPECT_TRUE(wrong.empty());
    std::string all;
    for (const Problem& p : found) all += describe(p) + "\n";
    return all;
  };
  EXPECT_EQ(
      doubts("rpm;kxx;kxy;kyx;cxx;cyy\n1;2;3;4;5;6\n"),
      "bearing.csv:1:5: kyy: this table has no such column beside kxx: it is taken as zero\n");
  EXPECT_EQ(
      doubts("rpm;kxx;kyx;kyy\n1;2;3;4\n"),
      "bearing.csv:1:9: kxy: this table has no such column beside kyx: it is taken as zero\n");
  EXPECT_EQ(doubts("rpm;kxx;kyy;cxx;cyy\n1;2;3;4;5\n"), "");
}

}  // namespace whirl::bearing_table_test
