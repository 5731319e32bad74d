// The arithmetic of a study: what its file says, what is asked for, and what goes on from it.

#include "libbase/system/arithmetic.hpp"

#include <cstdlib>

#include "libdyn/taylor/batch.hpp"
#include "tests/cli/studies.hpp"

namespace whirl::test {

namespace arithmetic_test {

class Arithmetic : public Studies {
 protected:
  static std::vector<std::string> line(const std::string& out,
                                       const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"map",           stator,
                                   "--over",        "operation.speed=136:146:1rad/s",
                                   "--over",        "contact.ring.friction=0.1,0.2",
                                   "--discard",     "100",
                                   "--revolutions", "50",
                                   "--exponents",   "50"};
    words.insert(words.end(), more.begin(), more.end());
    words.insert(words.end(), {"--out", out});
    return words;
  }
  std::string attribute(const std::string& file, const std::string& name) const {
    return ResultReader(folder / file).string_attribute("/", name);
  }
  /// What is said to a line that does not go on from its file, which stays as it was.
  std::string refusal(const std::vector<std::string>& words) const {
    const std::string before = content(folder / words.back());
    const Outcome o = whirl(words);
    EXPECT_EQ(o.status, 2) << o.err;
    EXPECT_EQ(content(folder / words.back()), before);
    return o.err;
  }
};

TEST_F(Arithmetic, StandsInEveryResult) {
  ASSERT_EQ(whirl({"modes", "rub.toml", "--out", "modes.h5"}).status, 0);
  ASSERT_EQ(whirl(line("map.h5")).status, 0);
  for (const char* file : {"modes.h5", "map.h5"}) {
    EXPECT_EQ(attribute(file, "instruction_set"), instruction_set());
    EXPECT_EQ(attribute(file, "mathematics"), mathematics());
  }
}

// Each set that this program and processor have; those that round alike give the same bits.
TEST_F(Arithmetic, IsAskedFor) {
  const std::vector<std::string> sets = instruction_sets();
  for (const std::string& set : sets) {
    ASSERT_EQ(whirl(line(set + ".h5", {"--isa", set})).status, 0);
    EXPECT_EQ(attribute(set + ".h5", "instruction_set"), set);
    if (rounds_alike(set, sets[0])) {
      expect_same(sets[0] + ".h5", set + ".h5", "/map");
      EXPECT_EQ(attribute(set + ".h5", "mathematics"), mathematics());
    }
  }
  // the stored line has it
  ASSERT_EQ(whirl({"rerun", "baseline.h5", "--out", "again.h5"}).status, 0);
  EXPECT_EQ(attribute("again.h5", "instruction_set"), "baseline");
  EXPECT_EQ(attribute("again.h5", "mathematics"), attribute("baseline.h5", "mathematics"));
  expect_same("baseline.h5", "again.h5", "/map");
  const Outcome unknown = whirl(line("x.h5", {"--isa", "avx9"}));
  EXPECT_EQ(unknown.status, 2);
  EXPECT_TRUE(has(unknown.err, "--isa avx9: this program on this processor has ")) << unknown.err;
  EXPECT_TRUE(has(unknown.err, "baseline only")) << unknown.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "x.h5"));
}

// By every other set: what rounds alike goes on, and the file says then which it was last.
TEST_F(Arithmetic, OfAStudyIsThatOfItsBeginning) {
  const std::vector<std::string> sets = instruction_sets();
  for (const std::string& set : sets) {
    for (const std::string& other : sets) {
      ASSERT_EQ(whirl(line("map.h5", {"--isa", set, "--restart"})).status, 0);
      const std::vector<std::string> on = line("map.h5", {"--isa", other});
      if (rounds_alike(set, other)) {
        EXPECT_EQ(result(on)["resumed"], 22) << set << ' ' << other;
        EXPECT_EQ(attribute("map.h5", "instruction_set"), other);
      } else {
        const std::string said = refusal(on);
        EXPECT_TRUE(has(said, "was begun with the instruction set " + set + ", this is " + other))
            << said;
        EXPECT_TRUE(has(said, "--isa") && has(said, "--restart")) << said;
      }
    }
  }
}

// On a processor without fused products, as glibc can be told this is one, sin and its like round
// otherwise in one of some thousand cases.
TEST_F(Arithmetic, OfAnotherMathematicalLibraryIsRefused) {
  ::setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2,-FMA", 1);
  const int status = whirl(line("map.h5")).status;
  ::unsetenv("GLIBC_TUNABLES");
  ASSERT_EQ(status, 0);
  if (attribute("map.h5", "mathematics") == mathematics()) GTEST_SKIP() << "there is one only";
  const std::string said = refusal(line("map.h5"));
  EXPECT_TRUE(has(said, "was begun with other mathematical functions")) << said;
  // as every processor has it, it is the same
  ASSERT_EQ(whirl(line("baseline.h5", {"--isa", "baseline"})).status, 0);
  EXPECT_EQ(attribute("baseline.h5", "mathematics"), attribute("map.h5", "mathematics"));
}

}  // namespace arithmetic_test
}  // namespace whirl::test
