// Ranges of the command line, first:last:step.

#include "libio/text/value_range.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace whirl::value_range_test {

constexpr double rpm = std::numbers::pi / 30.0;  // [rad/s]
constexpr double rounding = 1e-15;               // relative

TEST(ValueRange, UnitAtTheEndHoldsForAll) {
  const auto range = parse_range("0:8000:50rpm", "rad/s");
  ASSERT_TRUE(range) << range.problem;
  EXPECT_EQ(range->first, 0.0);
  EXPECT_NEAR(range->last, 8000.0 * rpm, rounding * 8000.0 * rpm);
  EXPECT_NEAR(range->step.value(), 50.0 * rpm, rounding * 50.0 * rpm);
}

TEST(ValueRange, PartsMayHaveTheirOwnUnits) {
  const auto range = parse_range("1 mm : 2 cm : 500 um", "m");
  ASSERT_TRUE(range) << range.problem;
  EXPECT_EQ(range->first, 1e-3);
  EXPECT_EQ(range->last, 2e-2);
  EXPECT_EQ(range->step, 5e-4);
  EXPECT_EQ(parse_range("1:1mm:1um", "m")->first, 1e-6);
}

TEST(ValueRange, BareNumbersAreSI) {
  const auto range = parse_range("1:2", "rad/s");
  ASSERT_TRUE(range) << range.problem;
  EXPECT_EQ(range->first, 1.0);
  EXPECT_EQ(range->last, 2.0);
  EXPECT_FALSE(range->step.has_value());
  EXPECT_EQ(parse_range("0:0.2:0.05", "")->step, 0.05);
  EXPECT_EQ(parse_range("-3:-1", "m")->first, -3.0);
}

TEST(ValueRange, ProblemsAreExplained) {
  const auto problem = [](std::string_view text, std::string_view unit) {
    const auto range = parse_range(text, unit);
    return range ? "none" : range.problem;
  };
  const std::string shape = ", expected first:last or first:last:step, such as 0:8000:50rpm";
  EXPECT_EQ(problem("", "m"), R"(found "")" + shape);
  EXPECT_EQ(problem("5", "m"), R"(found "5")" + shape);
  EXPECT_EQ(problem("1:2:3:4", "m"), R"(found "1:2:3:4")" + shape);
  EXPECT_EQ(problem("0:8:0", ""), R"("0:8:0": the step must be positive)");
  EXPECT_EQ(problem("0:8:-1", ""), R"("0:8:-1": the step must be positive)");
  EXPECT_EQ(problem("8:0:1", ""), R"("8:0:1": the last value is below the first)");
  EXPECT_EQ(problem("0:1:1e-7", ""), R"("0:1:1e-7": more than 1 million values)");
  EXPECT_EQ(problem("-1e308:1e308:1", ""), R"("-1e308:1e308:1": more than 1 million values)");
  EXPECT_EQ(
      problem("0rpm:8000rpm:50", "rad/s"),
      R"("0rpm:8000rpm:50": some parts have a unit and the last has none; write it at the end)");
  EXPECT_EQ(problem("0:8000:50mm", "rad/s"),
            R"(found "0 mm", expected a speed (rad/s), in the range "0:8000:50mm")");
  EXPECT_EQ(problem("0::50", "m"),
            R"("" is not a number, expected a length (m), in the range "0::50")");
  EXPECT_EQ(problem("0:nan:50", "m"),
            R"("nan" is not a number, expected a length (m), in the range "0:nan:50")");
}

TEST(ValueRange, LastValueIsIncludedIfItIsMet) {
  // 0.3 / 0.1 is 2.9999999999999996 in doubles
  EXPECT_EQ(values({.first = 0.0, .last = 0.3, .step = 0.1}),
            (std::vector<double>{0.0, 0.1, 0.2, 0.3}));
  EXPECT_EQ(values({.first = 0.0, .last = 0.29, .step = 0.1}),
            (std::vector<double>{0.0, 0.1, 0.2}));
  EXPECT_EQ(values({.first = 2.0, .last = 2.0, .step = 0.1}), (std::vector<double>{2.0}));
  const auto speeds = values(*parse_range("0:8000:50rpm", "rad/s"));
  ASSERT_EQ(speeds.size(), 161u);
  EXPECT_EQ(speeds.back(), *parse_as("8000 rpm", "rad/s"));
  EXPECT_NEAR(speeds[37], 1850.0 * rpm, rounding * 1850.0 * rpm);
}

TEST(ValueRange, NumberOfValuesInsteadOfAStep) {
  EXPECT_EQ(values({.first = 1.0, .last = 2.0}, 5),
            (std::vector<double>{1.0, 1.25, 1.5, 1.75, 2.0}));
  EXPECT_EQ(values({.first = 1.0, .last = 2.0}, 1), (std::vector<double>{1.0}));
}

TEST(ValueRange, GarbageDoesNotCrash) {
  std::mt19937 random(7);
  const std::string_view pieces[] = {"1", "0", ":", ":", "-", ".", "e3", "rpm", " ", "mm", "\xff"};
  std::uniform_int_distribution<std::size_t> piece(0, std::size(pieces) - 1), length(0, 10);
  int good = 0;
  for (int i = 0; i < 100'000; ++i) {
    std::string text;
    for (std::size_t n = length(random); n > 0; --n) text += pieces[piece(random)];
    const auto range = parse_range(text, "rad/s");
    if (!range) continue;
    ++good;
    EXPECT_LE(range->first, range->last);
    if (!range->step) continue;
    EXPECT_LE((range->last - range->first) / *range->step, 1e7);
  }
  EXPECT_GT(good, 100);
}

}  // namespace whirl::value_range_test
