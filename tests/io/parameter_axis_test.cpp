// Axes of studies: what --over says.

#include "libio/text/parameter_axis.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "libbase/error.hpp"

namespace whirl::parameter_axis_test {

TEST(ParameterAxis, TakesRangesAndLists) {
  const auto speeds = parse_axis("operation.speed=60:180:60rpm", 0);
  ASSERT_TRUE(speeds) << speeds.problem;
  EXPECT_EQ(speeds->path, "operation.speed");
  EXPECT_EQ(speeds->unit, "rad/s");
  ASSERT_EQ(speeds->values.size(), 3u);
  EXPECT_NEAR(speeds->values[2], 6.0 * std::numbers::pi, 1e-12);

  const auto counted = parse_axis("contact.ring.clearance=1:2mm", 5);
  ASSERT_TRUE(counted) << counted.problem;
  EXPECT_EQ(counted->unit, "m");
  ASSERT_EQ(counted->values.size(), 5u);
  EXPECT_DOUBLE_EQ(counted->values[1], 1.25e-3);

  const auto listed = parse_axis("contact.ring.friction=0,0.1,0.05", 0);
  ASSERT_TRUE(listed) << listed.problem;
  EXPECT_EQ(listed->unit, "");
  EXPECT_EQ(listed->values, (std::vector<double>{0.0, 0.1, 0.05}));
  EXPECT_EQ(parse_axis("a=1,2,3 mm", 0)->values, (std::vector<double>{1e-3, 2e-3, 3e-3}));
  EXPECT_EQ(parse_axis("a=4", 0)->values, (std::vector<double>{4.0}));
}

// The same value as in the file, to the last digit.
TEST(ParameterAxis, AssignsExactly) {
  const auto axis = parse_axis("contact.ring.friction=0:1:0.1", 0);
  ASSERT_TRUE(axis);
  using Texts = std::vector<std::string>;
  EXPECT_EQ(axis->assignments(3), (Texts{"contact.ring.friction=0.30000000000000004"}));
  EXPECT_EQ(parse_axis("a=1:3:1mm", 0)->assignments(1), (Texts{"a=0.002 m"}));
  EXPECT_EQ(parse_axis("a.1.b,a.2.b=1:3:1", 0)->assignments(2), (Texts{"a.1.b=3", "a.2.b=3"}));
}

TEST(ParameterAxis, SaysWhatIsWrong) {
  const auto problem = [](const char* text, int points = 0) {
    const auto axis = parse_axis(text, points);
    EXPECT_FALSE(axis) << text;
    return axis.problem;
  };
  EXPECT_NE(problem("operation.speed").find("PATH=first:last:step"), std::string::npos);
  EXPECT_NE(problem("=1:2:1").find("PATH=first:last:step"), std::string::npos);
  EXPECT_NE(problem("a=1:2").find("--points"), std::string::npos);
  EXPECT_NE(problem("a=1:2:0").find("positive"), std::string::npos);
  EXPECT_NE(problem("a=2:1:1").find("below the first"), std::string::npos);
  EXPECT_NE(problem("a=1:2:x").find("x"), std::string::npos);
  EXPECT_NE(problem("a=1,,2").find("number"), std::string::npos);
  EXPECT_NE(problem("a=1 kg,2 m").find("different dimensions"), std::string::npos);
  EXPECT_NE(problem("a=1kg:2m:1m").find("another dimension"), std::string::npos);
  EXPECT_NE(problem("a=1:2:1kg^7").find("in SI without a unit"), std::string::npos);
}

// K = [[k, q], [-q, k]] of one q
TEST(ParameterAxis, AMinusBeforeAPathTakesTheNegative) {
  const auto axis = parse_axis("seal.1.stiffness.xy,-seal.1.stiffness.yx=0:2:1N/m", 0);
  ASSERT_TRUE(axis);
  EXPECT_EQ(axis->paths(),
            (std::vector<std::string>{"seal.1.stiffness.xy", "seal.1.stiffness.yx"}));
  EXPECT_EQ(axis->assignments(2),
            (std::vector<std::string>{"seal.1.stiffness.xy=2 N/m", "seal.1.stiffness.yx=-2 N/m"}));
}

TEST(ParameterAxis, SeveralAreAsManyAsAreRight) {
  const std::vector<std::string> two{"gravity=9,9.81", "operation.speed=1:2:1rad/s"};
  EXPECT_EQ(parse_axes(two, 0, 2, 3).at(1).values, (std::vector<double>{1.0, 2.0}));
  const auto problem_of = [&](std::size_t least, std::size_t most) -> std::string {
    try {
      parse_axes(two, 0, least, most);
    } catch (const ModelError& error) {
      return error.problems().at(0).message;
    }
    return "";
  };
  EXPECT_TRUE(problem_of(1, 1).starts_with("found 2 of them, expected 1: "));
  EXPECT_TRUE(problem_of(3, 4).starts_with("found 2 of them, expected 3 to 4: "));
  EXPECT_THROW(parse_axes({"gravity=x"}, 0, 1, 1), ModelError);
}

}  // namespace whirl::parameter_axis_test
