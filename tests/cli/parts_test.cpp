// Studies in parts: joined, they are the study that was computed at once, bit by bit.

#include "tests/cli/studies.hpp"

namespace whirl::test {
namespace parts_test {

class Parts : public Studies {
 protected:
  std::vector<std::string> map{"map",           stator,
                               "--over",        "operation.speed=130:140:0.1rad/s",
                               "--over",        "contact.ring.friction=0.1,0.2",
                               "--discard",     "60",
                               "--revolutions", "20"};

  /// The words with more behind them.
  static std::vector<std::string> with(std::vector<std::string> words,
                                       const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  /// Computes the whole of a study and its parts, and joins these.
  void expect_joined(const std::vector<std::string>& study, const std::string& group, int status) {
    ASSERT_EQ(whirl(with(study, {"--out", "whole.h5"})).status, status);
    std::vector<std::string> merge{"merge", "joined.h5"};
    for (const char* part : {"2", "3", "1"}) {
      const Outcome outcome =
          whirl(with(study, {"--out", "joined.h5", "--part", part + std::string("/3")}));
      EXPECT_EQ(outcome.status, status) << outcome.err;
      merge.push_back("joined.part" + std::string(part) + "of3.h5");
    }
    const Outcome merged = whirl(merge);
    ASSERT_EQ(merged.status, status) << merged.err;
    expect_same("whole.h5", "joined.h5", group);
    for (const std::string& option : ResultReader(folder / "joined.h5").strings("/call/option")) {
      EXPECT_FALSE(option.starts_with("--part")) << option;
    }
  }
};

TEST_F(Parts, OfAMapAreTheMap) {
  expect_joined(map, "/map", 0);
}

TEST_F(Parts, OfBasinsAreTheBasins) {
  expect_joined({"basins", stator, "--set", "contact.ring.stiffness=50e6", "--starts", "50",
                 "--discard", "200", "--revolutions", "50"},
                "/basins", 0);
}

TEST_F(Parts, OfAFreshSweepAreTheSweep) {
  expect_joined({"sweep", stator, "--fresh", "--over", "operation.speed=130:140:1rad/s",
                 "--discard", "60", "--revolutions", "20"},
                "/sweep", 0);
}

TEST_F(Parts, ThatAreMissingAreNamed) {
  ASSERT_EQ(whirl(with(map, {"--out", "atlas.h5", "--part", "1/3"})).status, 0);
  const json part = result({"status", "atlas.part1of3.h5"})["studies"][0];
  EXPECT_EQ(part["points"], 68);
  EXPECT_TRUE(part["complete"].get<bool>());
  const Outcome merged = whirl({"merge", "atlas.h5", "atlas.part1of3.h5"});
  EXPECT_EQ(merged.status, 3);
  EXPECT_EQ(merged.err, "whirl: missing: part 2/3 (all)\nwhirl: missing: part 3/3 (all)\n");
  // what is there goes on, as a whole
  ASSERT_EQ(whirl(with(map, {"--out", "whole.h5"})).status, 0);
  const Outcome rest = whirl(with(map, {"--out", "atlas.h5"}));
  EXPECT_EQ(rest.status, 0) << rest.err;
  EXPECT_NE(rest.out.find("68 of 202 points were there"), std::string::npos) << rest.out;
  expect_same("whole.h5", "atlas.h5", "/map");
}

TEST_F(Parts, OfOtherStudiesAreRefused) {
  ASSERT_EQ(whirl(with(map, {"--out", "atlas.h5", "--part", "1/3"})).status, 0);
  auto other = map;
  other.back() = "21";
  ASSERT_EQ(whirl(with(other, {"--out", "other.h5", "--part", "2/3"})).status, 0);
  const Outcome merged = whirl({"merge", "atlas.h5", "atlas.part1of3.h5", "other.part2of3.h5"});
  EXPECT_EQ(merged.status, 2);
  EXPECT_NE(merged.err.find("other.part2of3.h5 holds another study"), std::string::npos);
  EXPECT_NE(merged.err.find("it is no part of this study"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "atlas.h5"));
}

// Where the name of the whole is forgotten, the first part stands in its place: no file is touched.
TEST_F(Parts, AForgottenNameOfTheWholeCostsNoPart) {
  for (const char* part : {"1/2", "2/2"}) {
    ASSERT_EQ(whirl(with(map, {"--out", "atlas.h5", "--part", part})).status, 0);
  }
  const std::string before = content(folder / "atlas.part1of2.h5");
  const Outcome forgotten = whirl({"merge", "atlas.part1of2.h5", "atlas.part2of2.h5", "--force"});
  EXPECT_EQ(forgotten.status, 2);
  EXPECT_NE(forgotten.err.find("name the file of the whole before it"), std::string::npos)
      << forgotten.err;
  EXPECT_EQ(content(folder / "atlas.part1of2.h5"), before);
  EXPECT_EQ(whirl({"merge", "atlas.part1of2.h5", "atlas.part1of2.h5"}).status, 2);
  // a file of another study in its place is kept, too
  ASSERT_EQ(whirl({"modes", stator, "--out", "modes.h5"}).status, 0);
  const std::string modes = content(folder / "modes.h5");
  EXPECT_EQ(whirl({"merge", "modes.h5", "atlas.part1of2.h5", "--force"}).status, 2);
  EXPECT_EQ(content(folder / "modes.h5"), modes);
}

// Options may stand before, between and behind the files.
TEST_F(Parts, AreJoinedWithOptionsAnywhere) {
  for (const char* part : {"1/2", "2/2"}) {
    ASSERT_EQ(whirl(with(map, {"--out", "atlas.h5", "--part", part})).status, 0);
  }
  const std::string one = "atlas.part1of2.h5", two = "atlas.part2of2.h5";
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"merge", "atlas.h5", one, two, "--quiet"},
        {"merge", "--quiet", "atlas.h5", one, two},
        {"merge", "atlas.h5", "--json", "a.json", one, "--quiet", two}}) {
    const Outcome merged = whirl(words);
    EXPECT_EQ(merged.status, 0) << merged.err;
    EXPECT_EQ(merged.out, "");
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "a.json"));
  const Outcome wrong = whirl({"merge", "atlas.h5", one, "--quite"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.err.find("did you mean \"--quiet\"?"), std::string::npos) << wrong.err;
}

TEST_F(Parts, AreAskedForRightly) {
  for (const auto& [part, problem] : std::vector<std::pair<std::string, std::string>>{
           {"4/3", "such as 3/40"}, {"0/3", "such as 3/40"}, {"3", "such as 3/40"}}) {
    const Outcome outcome = whirl(with(map, {"--out", "atlas.h5", "--part", part}));
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find(problem), std::string::npos) << outcome.err;
  }
  EXPECT_NE(whirl(with(map, {"--part", "1/3"})).err.find("needs --out"), std::string::npos);
  const Outcome carried = whirl({"sweep", stator, "--over", "operation.speed=130:140:1rad/s",
                                 "--out", "sweep.h5", "--part", "1/3"});
  EXPECT_EQ(carried.status, 2);
  EXPECT_NE(carried.err.find("--fresh has"), std::string::npos) << carried.err;
  EXPECT_EQ(whirl({"merge", "nothing.h5"}).status, 2);
  ASSERT_EQ(whirl({"modes", stator, "--out", "modes.h5"}).status, 0);
  EXPECT_NE(whirl({"merge", "all.h5", "modes.h5"}).err.find("is no study that has parts"),
            std::string::npos);
}

}  // namespace parts_test
}  // namespace whirl::test
