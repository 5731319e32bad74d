// whirl sensitivity: what it tells, where it refuses.

#include "tests/cli/program.hpp"

namespace whirl::test {
namespace sensitivity_test {

constexpr const char* levitated = R"(format = 1
[operation]
speed = "1000 rpm"
[[body]]
name = "rotor"
mass = "10 kg"
spins = true
[[magnetic_bearing]]
name = "magnet"
body = "rotor"
current_stiffness = "200 N/A"
negative_stiffness = "1 MN/m"
proportional = "10 A/mm"
derivative = "20 A.s/m"
)";

class Sensitivities : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("rotor.toml", levitated);
  }
};

// acceptance: proportional-derivative control has the largest sensitivity sqrt(2.5) at 316.23 rad/s
TEST_F(Sensitivities, TellsSizePlaceAndZone) {
  const json r = result({"sensitivity", "rotor.toml", "--frequencies", "10:100:1Hz"});
  ASSERT_EQ(r["loops"].size(), 2u);
  for (const json& loop : r["loops"]) {
    EXPECT_EQ(loop["bearing"], "magnet");
    EXPECT_NEAR(loop["largest"].get<double>(), std::sqrt(2.5), 1e-12);
    EXPECT_NEAR(loop["largest_at_rpm"].get<double>() * rpm, 316.22776601683796, 1e-4);
    EXPECT_EQ(loop["zone"], "A");
    EXPECT_EQ(loop["sensitivity"].size(), 91u);
  }
  const std::string out = whirl({"sensitivity", "rotor.toml", "--frequencies", "10:100:1Hz"}).out;
  EXPECT_TRUE(has(out, "3.98")) << out;
}

TEST_F(Sensitivities, TellStepResponses) {
  const json r = result({"sensitivity", "rotor.toml", "--frequencies", "10:100:1Hz", "--steps",
                         "50ms", "--out", "s.h5"});
  ASSERT_EQ(r["steps"].size(), 2u);
  EXPECT_EQ(r["times_s"].size(), 1001u);
  EXPECT_NEAR(r["steps"][0]["reference_end"].get<double>(), 2.0, 1e-12);
  EXPECT_NEAR(r["steps"][1]["force_end_m_n"].get<double>(), 1e-6, 1e-15);
  EXPECT_EQ(r["steps"][0]["reference"].size(), 1001u);
  const Outcome plotted = whirl({"plot", "s.h5", "step_response"});
  EXPECT_EQ(plotted.status, 0) << plotted.err;
  const Outcome wrong = whirl({"sensitivity", "rotor.toml", "--steps", "-1s"});
  EXPECT_NE(wrong.status, 0);
  EXPECT_TRUE(has(wrong.err, "above 0")) << wrong.err;
}

// A step of 100 N on 1 MN/m that begins after half a revolution: what comes before is rest, what
// comes in the end its deflection; a limited current leaves the magnet less.
TEST_F(Sensitivities, ForcesThatBeginAreSteps) {
  write("step.toml", std::string(levitated) +
                         "current_limit = \"5 A\"\n[[force]]\nbody = \"rotor\"\n"
                         "force = \"100 N\"\nbegins = \"0.5 rev\"\n"
                         "[reduction]\nmethod = \"none\"\n");
  const json r = result({"simulate", "step.toml", "--revolutions", "4", "--discard", "0"});
  EXPECT_NEAR(r["load_begins_s"][0].get<double>(), 0.03, 1e-12);
  const double largest = r["stations"][0]["max_radius_m"].get<double>();
  EXPECT_GT(largest, 1e-4);  // overshoots
  EXPECT_LT(largest, 1.5e-4);
}

TEST_F(Sensitivities, UnstableLoopsAreTold) {
  const json r = result({"sensitivity", "rotor.toml", "--frequencies", "10:100:1Hz", "--set",
                         "magnetic_bearing.magnet.derivative=-1"});
  EXPECT_TRUE(has(r["notes"].dump(), "unstable")) << r["notes"];
}

TEST_F(Sensitivities, NeedAControlLoop) {
  write("plain.toml", jeffcott);
  const Outcome refused = whirl({"sensitivity", "plain.toml", "--frequencies", "10:100:1Hz"});
  EXPECT_NE(refused.status, 0);
  EXPECT_TRUE(has(refused.err, "add a [[magnetic_bearing]]")) << refused.err;
}

}  // namespace sensitivity_test
}  // namespace whirl::test
