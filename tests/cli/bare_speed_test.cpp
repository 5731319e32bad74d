// Speeds without a unit: both readings are said, and how to write the other one.

#include "tests/cli/program.hpp"

namespace whirl::test {
namespace bare_speed_test {

class BareSpeed : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("rotor.toml", jeffcott);
  }
};

// 3000 rad/s = 3000 * 30 / pi rpm = 28 647.9 rpm
TEST_F(BareSpeed, TheAnswerBeginsWithBothReadings) {
  const Outcome o = whirl({"modes", "rotor.toml", "--speed", "3000"});
  EXPECT_EQ(o.status, 0);
  EXPECT_TRUE(
      o.out.starts_with("speed: 3000 rad/s = 28 648 rpm (no unit given; for revolutions "
                        "per minute write 3000rpm)\n\n"))
      << o.out;
  EXPECT_EQ(o.err,
            "whirl: warning: --speed 3000 has no unit and means 3000 rad/s = 28 648 rpm; for "
            "revolutions per minute write --speed 3000rpm\n");
  EXPECT_EQ(whirl({"modes", "rotor.toml", "--speed", "3000", "--quiet"}).err, "");
  const json r = json::parse(whirl({"modes", "rotor.toml", "--speed=3000", "--json", "-"}).out);
  ASSERT_EQ(r["notes"].size(), 1u);
  EXPECT_TRUE(has(r["notes"][0], "3000rpm"));
}

TEST_F(BareSpeed, EveryOptionThatTakesASpeedIsLookedAt) {
  const auto says = [&](const std::vector<std::string>& words, const std::string& what) {
    const Outcome o = whirl(words);
    EXPECT_TRUE(has(o.err, what)) << o.err;
  };
  says({"modes", "rotor.toml", "--set", "operation.speed=200"},
       "write --set operation.speed=200rpm");
  says({"campbell", "rotor.toml", "--speeds", "0:300:100"},
       "--speeds 0:300:100 has no unit and means 0 to 300 rad/s = 0 to 2865 rpm; for revolutions "
       "per minute write --speeds 0:300:100rpm");
  write("rub.toml", rubbing);
  says({"sweep", "rub.toml", "--over", "operation.speed=90,100", "--discard", "5", "--revolutions",
        "2"},
       "write --over operation.speed=90,100rpm");
  says(
      {"continue", "rub.toml", "--over", "operation.speed=90:91:1", "--at", "91", "--discard", "5"},
      "write --at 91rpm");
}

TEST_F(BareSpeed, UnitsZeroAndModelFilesAreNoMatter) {
  write("rub.toml", rubbing);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"modes", "rotor.toml", "--speed", "300rpm"},
        {"modes", "rotor.toml", "--speed", "0"},
        {"modes", "rotor.toml", "--set", "operation.speed=300 rpm"},
        {"campbell", "rotor.toml", "--speeds", "0:300:100rpm"},
        {"modes", "rub.toml", "--set", "body.rotor.mass=3"}}) {
    const Outcome o = whirl(words);
    EXPECT_EQ(o.status, 0);
    EXPECT_EQ(o.err, "");
    EXPECT_FALSE(has(o.out, "no unit given"));
  }
}

}  // namespace bare_speed_test
}  // namespace whirl::test
