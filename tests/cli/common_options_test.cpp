// Options that all verbs have.

#include <cmath>

#include "tests/cli/linear.hpp"

namespace whirl::test {
namespace common_options_test {

TEST_F(Linear, SpeedIsShortForSettingIt) {
  const json set = result({"modes", "rotor.toml", "--set", "operation.speed=138.4 rad/s"});
  EXPECT_EQ(result({"modes", "rotor.toml", "--speed", "138.4 rad/s"}), set);
  EXPECT_EQ(result({"modes", "rotor.toml", "--speed=138.4rad/s"}), set);
  EXPECT_DOUBLE_EQ(set["speed_rpm"].get<double>(), 138.4 / rpm);
}

TEST_F(Linear, SettingsAddUpAndTheLastOneHolds) {
  const json r = result({"check", "rotor.toml", "--set", "body.rotor.mass=3 kg", "--set",
                         "operation.speed=1rpm", "--set", "body.1.mass=5 kg"});
  EXPECT_EQ(r["mass_kg"], 5.0);
  EXPECT_DOUBLE_EQ(r["speed_rpm"].get<double>(), 1.0);
}

TEST_F(Linear, FormsOfSpeeds) {
  const auto speeds = [&](const std::string& range) {
    return result({"unbalance", "rotor.toml", "--quiet", "--speeds", range})["speeds_rpm"]
        .get<std::vector<double>>();
  };
  const auto near = [](const std::vector<double>& found, const std::vector<double>& expected) {
    if (found.size() != expected.size()) return false;
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (std::abs(found[i] - expected[i]) > 1e-9) return false;
    }
    return true;
  };
  const std::vector<double> steps{0.0, 50.0, 100.0};
  EXPECT_TRUE(near(speeds("0:100:50rpm"), steps));
  EXPECT_TRUE(near(speeds("0rpm:100rpm:50rpm"), steps));
  EXPECT_TRUE(near(speeds("0 : 100 : 50 rpm"), steps));
  EXPECT_TRUE(near(speeds("0:110:50rpm"), steps));  // the last one is not met
  EXPECT_TRUE(near(speeds("60:180:60rpm"), {60.0, 120.0, 180.0}));
  EXPECT_TRUE(near(speeds("1:3:1Hz"), {60.0, 120.0, 180.0}));
  EXPECT_TRUE(near(speeds("0:2:1"), {0.0, 1.0 / rpm, 2.0 / rpm}));
  EXPECT_EQ(speeds("0:100rpm").size(), 101u);
  EXPECT_EQ(speeds("70:70:1rpm").size(), 1u);
}

TEST_F(Linear, JsonToStandardOutputIsAllThatIsPrinted) {
  for (const std::string& verb : model_verbs) {
    SCOPED_TRACE(verb);
    const Outcome outcome =
        whirl(briefly({verb, "rotor.toml", "--speed", "100rad/s", "--json", "-"}));
    EXPECT_EQ(outcome.status, 0);
    EXPECT_TRUE(json::accept(outcome.out)) << outcome.out;
    EXPECT_EQ(outcome.err, "");
  }
}

TEST_F(Linear, JsonToAFileLeavesTheTextAndQuietLeavesNothing) {
  for (const std::string& verb : model_verbs) {
    SCOPED_TRACE(verb);
    const Outcome text =
        whirl(briefly({verb, "rotor.toml", "--speed", "100rad/s", "--json", "r.json"}));
    EXPECT_EQ(text.status, 0);
    EXPECT_NE(text.out, "");
    const json from_file = json::parse(content(folder / "r.json"));
    EXPECT_EQ(from_file["model"], "rotor.toml");
    const Outcome quiet = whirl(briefly(
        {verb, "rotor.toml", "--speed", "100rad/s", "--quiet", "--threads", "1", "--out", "r.h5"}));
    EXPECT_EQ(quiet.status, 0);
    EXPECT_EQ(quiet.out, "");
    EXPECT_EQ(quiet.err, "");
    EXPECT_TRUE(std::filesystem::remove(folder / "r.h5"));
  }
}

}  // namespace common_options_test
}  // namespace whirl::test
