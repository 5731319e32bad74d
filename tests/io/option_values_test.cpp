// Values of options as a command line gives them.

#include "libio/text/option_values.hpp"

#include <gtest/gtest.h>

#include "libbase/numerics/constants.hpp"
#include "libdyn/studies/found_orbit.hpp"

namespace whirl::option_values_test {

TEST(OptionValues, AWrongOneIsNamed) {
  const auto whole = [](const std::string& text) { return parse_whole(text, 4, 100'000); };
  EXPECT_EQ(parsed_option("samples", "64", whole), 64);
  try {
    parsed_option("samples", "3", whole);
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_STREQ(error.what(), "--samples 3: expected a whole number from 4 to 100 000");
  }
}

TEST(OptionValues, WholeNumbersHaveNothingBehindThem) {
  EXPECT_EQ(*parse_whole("-1", -1, 9), -1);
  EXPECT_EQ(*parse_whole("1000000000", 1, 1'000'000'000), 1'000'000'000);
  for (const char* text : {"", "1.5", "1e3", "7rpm", " 7", "+7", "1000000001", "0"}) {
    EXPECT_FALSE(parse_whole(text, 1, 1'000'000'000)) << text;
  }
}

TEST(OptionValues, TolerancesHaveLimits) {
  EXPECT_EQ(*parse_tolerance("1e-10"), 1e-10);
  for (const char* text : {"1e-16", "0.1", "-1e-10", "nan"}) {
    EXPECT_FALSE(parse_tolerance(text)) << text;
  }
}

TEST(OptionValues, MethodsAreOfAList) {
  EXPECT_EQ(*parse_method("rk4", {"dop853", "rk4"}), "rk4");
  EXPECT_EQ(*parse_method("cvode", {"rk4"}), "cvode");
  EXPECT_EQ(parse_method("euler", {"dop853", "rk4"}).problem,
            "unknown method, expected one of dop853, rk4");
}

TEST(OptionValues, InstructionSetsAreOfAList) {
  EXPECT_EQ(*parse_instruction_set("avx2", {"avx2", "baseline"}), "avx2");
  for (const char* other : {"avx512", "AVX2", ""}) {
    EXPECT_EQ(parse_instruction_set(other, {"avx2", "baseline"}).problem,
              "this program on this processor has avx2, baseline only");
  }
}

TEST(OptionValues, ChoicesAreNamesOfEnumerators) {
  EXPECT_EQ(*parse_choice<OrbitFrame>("rotating"), OrbitFrame::rotating);
  EXPECT_EQ(parse_choice<OrbitFrame>("inertial").problem, "expected stationary or rotating");
}

TEST(OptionValues, SpeedsOfARangeWithoutAStepAreAHundredAndOne) {
  EXPECT_EQ(parse_speeds("0:100:50rad/s")->size(), 3u);
  EXPECT_EQ(parse_speeds("0:100rpm")->size(), 101u);
  EXPECT_NEAR(parse_speeds("0:100rpm")->back(), 100.0 * rpm, 1e-12);
  EXPECT_EQ(parse_speeds("-1:100:50rad/s").problem, "expected speeds of zero or more");
  EXPECT_EQ(usual_speeds(200.0).back(), 300.0);
  EXPECT_NEAR(usual_speeds(0.0).back(), 10'000.0 * rpm, 1e-9);
}

TEST(OptionValues, SpeedsAreFoundAmongWhatVaries) {
  EXPECT_EQ(speeds_over({"contact.ring.friction=0:1"}, 7.0), std::vector<double>{7.0});
  EXPECT_EQ(speeds_over({"contact.ring.friction=0:1", "operation.speed=130:140rad/s"}, 7.0),
            (std::vector<double>{130.0, 140.0}));
}

}  // namespace whirl::option_values_test
