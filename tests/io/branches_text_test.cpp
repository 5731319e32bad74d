// Branches for people: one paragraph each, with the bifurcations in a table.

#include "libio/texts/branches_text.hpp"

#include <gtest/gtest.h>

#include <regex>

#include "libbase/numerics/constants.hpp"
#include "libio/texts/torus_text.hpp"

namespace whirl::branches_text_test {

TEST(BranchesText, SaysWhereBranchesGoAndWhatHappensThere) {
  BranchResult result{.parameter = {"contact.ring.friction", ""}};
  result.branches = {{{}, 1, 1, 0}, {{}, 2, 2, 1}};
  result.branches[0].end = "the end of the range";
  for (const double value : {0.1, 0.2, 0.3}) {
    result.points.push_back({.value = value, .branch = 1, .stability = value < 0.25 ? 1 : 0});
  }
  result.points.push_back({.value = 0.25, .branch = 2, .revolutions = 2.0});
  result.bifurcations = {{0.25, BifurcationKind::period_doubling, 1, 1, "", 0.0, -1.0},
                         {0.28, BifurcationKind::grazing, 1, 1, "ring", 1.0, {}}};
  const std::string text = text_of(result);
  EXPECT_NE(text.find("branch 1: period 1, 3 points, 2 of them stable; from 0.1 to 0.3\n  it ends: "
                      "the end of the range\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("grazing of ring"), std::string::npos) << text;
  EXPECT_NE(text.find("+1 impacts"), std::string::npos) << text;
  EXPECT_NE(
      text.find("branch 2: period 2, 1 points, 0 of them stable; from 0.25 to 0.25; begins on "
                "branch 1\n  it ends: not yet\n"),
      std::string::npos)
      << text;
}

TEST(BranchesText, SaysWhereProbesReadMost) {
  BranchResult result{.parameter = {"operation.speed", "rad/s"}};
  result.branches = {{{}, 1, 1, 0}, {{}, 2, 2, 1}};
  Probe mil{.name = "1X", .angle = 45.0 * degree, .unit = "mil"}, old{.name = "1Y"};
  result.probes = ProbeLabels({mil, old});
  result.points = {{.value = 50.0, .branch = 1, .probe_peak_to_peak = {2.54e-5, nan}},
                   {.value = 60.0, .branch = 2, .probe_peak_to_peak = {5.08e-5, nan}},
                   {.value = 70.0, .branch = 2, .probe_peak_to_peak = {nan, nan}}};
  const std::string text = text_of(result);
  for (const char* row : {"1X +45 +2 mil +60 +2", "1Y +0 +- +- +-"}) {
    EXPECT_TRUE(std::regex_search(text, std::regex(row))) << text;
  }
}

TEST(BranchesText, SaysThatThereIsNoCurve) {
  EXPECT_EQ(text_of(CurveResult{}), "\n  no bifurcation to follow in the plane\n");
}

TEST(TorusText, HasEveryFewCirclesAndTheLastOne) {
  TorusResult result{.exponents = Vec::Constant(1, -0.1),
                     .parameter = {"operation.speed", "rad/s"}};
  for (int i = 0; i < 60; ++i) result.circles.push_back({{100.0 + i, 0.3, -0.1, 1e-9}});
  result.ends = {"it locks (rotation next to 1/3)"};
  const std::string text = text_of(result);
  EXPECT_NE(text.find("operation.speed [rad/s]"), std::string::npos) << text;
  EXPECT_NE(text.find(" 100  0.3"), std::string::npos) << text;
  EXPECT_EQ(text.find(" 101  0.3"), std::string::npos) << text;
  EXPECT_NE(text.find(" 159  0.3"), std::string::npos) << text;
  EXPECT_NE(text.find("it ends: it locks"), std::string::npos) << text;
  result.is_good = false;
  EXPECT_EQ(text_of(result), "");
}

}  // namespace whirl::branches_text_test
