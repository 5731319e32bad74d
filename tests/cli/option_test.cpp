// Options that are members of a struct: what the help says of them, and how they are read.

#include "libio/text/option.hpp"

#include <gtest/gtest.h>

#include <array>

#include "libio/text/option_values.hpp"

namespace whirl::test {
namespace option_test {

enum class Shape { round, flat };
constexpr auto choices(Shape) {
  return std::array{Choice<Shape>{"round", Shape::round}, Choice<Shape>{"flat", Shape::flat}};
}

struct MotionOptions {
  Option<long> discard{"discard", "N", "before", 500, Whole{0, 1000}};
  Option<double> tolerance{"tolerance", "T", "of a step", 1e-10, parse_tolerance};
  auto fields() { return std::tie(discard, tolerance); }
};

/// An option of every type; the help has them in another order than the struct.
struct EveryOption {
  Option<std::string> station{"station", "NAME", "which", "disk"};
  Option<int> modes{"modes", "N", "how many", 8, Whole{1, 10'000}};
  Option<double> size{"size", "R", "how far", 0.5};
  Option<Shape> shape{"shape", "F", "round or flat", Shape::flat};
  Option<std::vector<double>> speeds{"speeds", "A:B", "of the rotor", parse_speeds};
  Option<std::uint64_t> seed{"seed", "S", "left out: any", Whole{1, 20'000'000}};
  MotionOptions motion{.discard = {"discard", "N", "for the transient", 20, Whole{0, 1000}}};
  Flag fresh{"fresh", "anew"};
  ListOption over{"over", "PATH", "several times"};
  auto fields() { return std::tie(over, station, modes, size, shape, speeds, motion, seed, fresh); }
};

TEST(Options, AreToldInTheOrderOfTheirFieldsWithTheirDefaults) {
  std::vector<std::string> told;
  for (const OptionSpec& option : specs_of<EveryOption>()) {
    told.push_back(std::string(option.name) + " " + std::string(option.value) + ": " +
                   help_of(option));
    EXPECT_EQ(option.is_list, option.name == "over");
    EXPECT_EQ(option.is_flag(), option.name == "fresh");
  }
  EXPECT_EQ(told,
            (std::vector<std::string>{"over PATH: several times", "station NAME: which (disk)",
                                      "modes N: how many; 1 to 10 000 (8)", "size R: how far (0.5)",
                                      "shape F: round or flat (flat)", "speeds A:B: of the rotor",
                                      "discard N: for the transient; 0 to 1000 (20)",
                                      "tolerance T: of a step (1e-10)",
                                      "seed S: left out: any; 1 to 20 million", "fresh : anew"}));
}

TEST(Options, LeftOutHaveTheirDefaults) {
  const auto read = read_options<EveryOption>({{"of another struct", {"1"}}});
  EXPECT_EQ(*read.station, "disk");
  EXPECT_EQ(*read.modes, 8);
  EXPECT_EQ(*read.shape, Shape::flat);
  EXPECT_EQ(*read.motion.discard, 20);
  EXPECT_FALSE(read.modes.is_given);
  EXPECT_FALSE(read.speeds);
  EXPECT_EQ(read.seed.value_or(7), 7u);
  EXPECT_FALSE(read.fresh);
  EXPECT_TRUE(read.over.values.empty());
}

TEST(Options, AreReadAsTheirTypesAndFunctionsSay) {
  const auto read = read_options<EveryOption>({{"station", {""}},
                                               {"modes", {"12"}},
                                               {"size", {"2e-1"}},
                                               {"shape", {"round"}},
                                               {"speeds", {"1:3:1"}},
                                               {"seed", {"5"}},
                                               {"discard", {"0"}},
                                               {"tolerance", {"1e-8"}},
                                               {"fresh", {""}},
                                               {"over", {"a=1,2", "b=3,4"}}});
  EXPECT_EQ(*read.station, "");
  EXPECT_TRUE(read.station.is_given);
  EXPECT_EQ(*read.modes, 12);
  EXPECT_EQ(*read.size, 0.2);
  EXPECT_EQ(*read.shape, Shape::round);
  EXPECT_EQ(*read.speeds, (std::vector{1.0, 2.0, 3.0}));
  EXPECT_EQ(*read.seed, 5u);
  EXPECT_EQ(*read.motion.discard, 0);
  EXPECT_EQ(*read.motion.tolerance, 1e-8);
  EXPECT_TRUE(read.fresh);
  EXPECT_EQ(read.over.values, (std::vector<std::string>{"a=1,2", "b=3,4"}));
}

TEST(Options, AreRefusedWithTheirNamesAndWhatWouldBeRight) {
  const auto problem = [](const std::string& name, const std::string& value) -> std::string {
    try {
      read_options<EveryOption>({{name, {value}}});
    } catch (const ModelError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(problem("modes", "0"), "--modes 0: expected a whole number from 1 to 10 000");
  EXPECT_EQ(problem("modes", "2.5"), "--modes 2.5: expected a whole number from 1 to 10 000");
  EXPECT_EQ(problem("seed", "-1"), "--seed -1: expected a whole number from 1 to 20 million");
  EXPECT_EQ(problem("discard", "-1"), "--discard -1: expected a whole number from 0 to 1000");
  EXPECT_EQ(problem("tolerance", "5"), "--tolerance 5: expected a number from 1e-15 to 1e-2");
  EXPECT_EQ(problem("shape", "oval"), "--shape oval: expected round or flat");
  EXPECT_EQ(problem("size", "2 mm"), "--size 2 mm: " + parse_as("2 mm", "").problem);
  EXPECT_EQ(problem("speeds", "3:1:1"), "--speeds 3:1:1: " + parse_speeds("3:1:1").problem);
}

// One that can be read and means nothing is told as it was written.
TEST(Options, ThatDoNotGoTogetherAreToldAsTheyWereWritten) {
  const auto read = read_options<EveryOption>({{"size", {"1e0"}}});
  EXPECT_STREQ(read.size.wrong("goes with --fresh").what(), "--size 1e0: goes with --fresh");
}

}  // namespace option_test
}  // namespace whirl::test
