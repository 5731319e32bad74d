// Motions that no machine makes are told as such, by every verb that computes them.

#include "tests/cli/program.hpp"

namespace whirl::cli_test {

/// A rotor of 32 kg whose friction of 0.3 whips it backward, far into its stator: dry whip.
constexpr const char* whip = R"(format = 1
[operation]
speed = "900 rad/s"
[[body]]
name = "disk"
mass = "32.1 kg"
spins = true
[[bearing]]
name = "shaft"
body = "disk"
stiffness = "25 MN/m"
damping = "2100 N.s/m"
[[unbalance]]
body = "disk"
offset = "0.05 mm"
[[contact]]
name = "stator"
body = "disk"
clearance = "0.1 mm"
stiffness = "36 MN/m"
friction = 0.3
radius = "100 mm"
[start]
displaced = [{ body = "disk", x = 0.0003, y = 0, vy = -0.6 }]
)";

class MotionNotes : public test::Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("whip.toml", whip);
  }
  /// All notes of a call, as one text.
  std::string notes(const std::vector<std::string>& words) { return result(words)["notes"].dump(); }
};

TEST_F(MotionNotes, TellDepthsInEveryVerb) {
  const std::vector<std::vector<std::string>> calls = {
      {"simulate", "whip.toml", "--revolutions", "50"},
      {"identify", "whip.toml", "--revolutions", "50"},
      {"classify", "whip.toml", "--revolutions", "200"},
      {"sweep", "whip.toml", "--over", "operation.speed=890:900:10rad/s", "--revolutions", "100"},
      {"map", "whip.toml", "--over", "operation.speed=890:900:10rad/s", "--over",
       "contact.stator.friction=0.29,0.3", "--revolutions", "100"},
      {"basins", "whip.toml", "--starts", "4", "--revolutions", "100"},
      {"orbit", "whip.toml", "--frame", "rotating"}};
  for (const auto& call : calls) {
    const std::string told = notes(call);
    EXPECT_TRUE(test::has(told, "deep in contact stator")) << call.front() << ": " << told;
    EXPECT_TRUE(test::has(told, "times its clearance")) << call.front() << ": " << told;
  }
}

// A record of the whip, in which the stiffness of its stator is looked for.
TEST_F(MotionNotes, TellDepthsOfWhatAFitFinds) {
  write("probes.toml",
        "[[probe]]\nname = \"x\"\nbody = \"disk\"\nangle = \"0 deg\"\n"
        "[[probe]]\nname = \"y\"\nbody = \"disk\"\nangle = \"90 deg\"\n");
  ASSERT_EQ(whirl({"simulate", "whip.toml", "--revolutions", "6", "--discard", "50", "--measure",
                   "probes.toml", "--measured-out", "whip.csv", "--quiet"})
                .status,
            0);
  const test::json found = whirl({"fit", "whip.toml", "--probes", "probes.toml", "--measured",
                                  "whip.csv", "--free", "contact.stator.stiffness", "--json", "-"})
                               .tree();
  EXPECT_TRUE(test::has(found["notes"].dump(), "deep in contact stator")) << found["notes"];
}

// The depth is what the recording says: distance less clearance, over the clearance.
TEST_F(MotionNotes, TellTheNumbersOfTheMotion) {
  const test::json r = result({"simulate", "whip.toml", "--revolutions", "50"});
  const double radius = r["stations"][0]["max_radius_m"];
  const std::string told = r["notes"].dump();
  const double times = (radius - 1e-4) / 1e-4;
  char expected[32];
  std::snprintf(expected, sizeof expected, "%.3g times its", times);
  EXPECT_TRUE(test::has(told, expected)) << told << " " << expected;
}

// The point with the largest force is named, with the values that it has.
TEST_F(MotionNotes, NameTheWorstPointOfAStudy) {
  const std::string told = notes({"sweep", "whip.toml", "--over", "operation.speed=890:900:10rad/s",
                                  "--revolutions", "100", "--fresh"});
  EXPECT_TRUE(test::has(told, "at operation.speed = 890 rad/s: the rotor lies") ||
              test::has(told, "at operation.speed = 900 rad/s: the rotor lies"))
      << told;
}

// A rotor with an inertia whose friction would stop it within a few turns.
TEST_F(MotionNotes, TellFrictionThatTakesTooMuch) {
  const std::vector<std::string> heavy = {"simulate",      "whip.toml",
                                          "--revolutions", "50",
                                          "--set",         "body.disk.tilts=true",
                                          "--set",         "body.disk.polar_inertia=0.1",
                                          "--set",         "body.disk.diametral_inertia=0.08",
                                          "--set",         "bearing.shaft.tilt_stiffness=1e5"};
  const std::string told = notes(heavy);
  EXPECT_TRUE(test::has(told, "friction at contact stator takes up to")) << told;
  EXPECT_TRUE(test::has(told, "the energy of the rotor's spin in")) << told;
}

TEST_F(MotionNotes, TellBearingsThatAreLeft) {
  const std::string told = notes(
      {"simulate", "whip.toml", "--revolutions", "50", "--set", "bearing.shaft.clearance=0.2mm"});
  EXPECT_TRUE(test::has(told, "from the middle of bearing shaft")) << told;
}

// An unstable rotor grows without end: told with its size, and why.
TEST_F(MotionNotes, TellWhatGrowsWithoutEnd) {
  write("unstable.toml", test::jeffcott);
  const std::string told = notes({"simulate", "unstable.toml", "--speed", "300rad/s", "--set",
                                  "bearing.shaft.stiffness={xx=2e4,yy=2e4,xy=1e4,yx=-1e4}",
                                  "--revolutions", "10", "--discard", "20"});
  EXPECT_TRUE(test::has(told, "m aside")) << told;
  EXPECT_TRUE(test::has(told, "the rotor is unstable at")) << told;
}

// Beyond all bounds the motion is given up, by every method, soon, and with the reason.
TEST_F(MotionNotes, GiveUpWhatIsBeyondAllBounds) {
  write("unstable.toml", test::jeffcott);
  for (const std::string method : {"", "taylor", "dop853", "cvode-adams", "cvode-bdf", "rk4"}) {
    std::vector<std::string> call = {
        "simulate",      "unstable.toml",
        "--speed",       "300rad/s",
        "--set",         "bearing.shaft.stiffness={xx=2e4,yy=2e4,xy=1e4,yx=-1e4}",
        "--revolutions", "50",
        "--discard",     "100000"};
    if (!method.empty()) call.insert(call.end(), {"--method", method});
    if (method.starts_with("cvode")) call.insert(call.end(), {"--tolerance", "1e-6"});
    const test::Outcome outcome = whirl(call);
    EXPECT_EQ(outcome.status, 3) << method;
    EXPECT_TRUE(test::has(outcome.err, "the motion grows without bound")) << method << outcome.err;
  }
}

// What machines do is not noted.
TEST_F(MotionNotes, LeaveGentleMotionsAlone) {
  write("rub.toml", test::rubbing);
  EXPECT_EQ(notes({"simulate", "rub.toml", "--revolutions", "50"}), "[]");
}

// A motion that begins where one of another model ended says so, and which values differ.
TEST_F(MotionNotes, TellAStartFromAnotherModel) {
  write("rub.toml", test::rubbing);
  result({"simulate", "rub.toml", "--revolutions", "5", "--out", "run.h5"});
  const std::vector<std::string> on = {"classify", "rub.toml",      "--from",
                                       "run.h5",   "--revolutions", "100"};
  EXPECT_EQ(notes(on), "[]");
  auto other = on;
  other.insert(other.end(), {"--set", "contact.ring.stiffness=30000"});
  const std::string told = notes(other);
  EXPECT_TRUE(test::has(told, "the start is a motion of a model with 1 other value")) << told;
  EXPECT_TRUE(test::has(told, "contact.ring.stiffness 20000.0 there, 30000 here") ||
              test::has(told, "contact.ring.stiffness 2e4 there, 30000 here"))
      << told;
}

}  // namespace whirl::cli_test
