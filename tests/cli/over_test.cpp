// modes, critical and unbalance with --over: JSON, result files, tables, pictures, bad calls.

#include <cmath>

#include "libdyn/linear/critical_over.hpp"
#include "libdyn/linear/modes_over.hpp"
#include "libio/figures/figures.hpp"
#include "libio/results/columns.hpp"
#include "tests/cli/program.hpp"

namespace whirl::test {
namespace over_test {

constexpr double m = 2.0, k = 2e4, omega = 100.0;  // of `jeffcott`
constexpr double rounding = 1e-9;                  // relative, of solvers on two dofs

class Over : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("rotor.toml", jeffcott);
    write("coupled.toml", R"(format = 1
[operation]
speed = "60 rad/s"
[[body]]
name = "rotor"
mass = 2
spins = true
[[bearing]]
name = "left"
body = "rotor"
stiffness = "20 kN/m"
damping = 4
[[seal]]
name = "swirl"
body = "rotor"
stiffness = { xx = 0, yy = 0, xy = 0, yx = "-400 N/m" }
[[unbalance]]
body = "rotor"
offset = "0.1 mm"
)");
  }

  std::string problem(std::vector<std::string> arguments) const {
    const Outcome o = whirl(arguments);
    EXPECT_EQ(o.status, 2);
    EXPECT_TRUE(files() == before) << "a file was written";
    return o.err;
  }
  const std::vector<std::string> before{"coupled.toml", "rotor.toml"};

  std::vector<std::string> kinds(const std::string& file) const {
    std::vector<std::string> names;
    const json list = result({"plot", file});
    for (const json& kind : list["kinds"]) names.push_back(kind["kind"]);
    return names;
  }
};

// K = [[k, q], [-400, k]]: products of its off-diagonals decide, and sqrt(400 q) = c omega = 400
// N/m at q = 400 N/m is where the damping is used up.
TEST_F(Over, ModesFindTheThreshold) {
  const std::vector<std::string> call{
      "modes", "coupled.toml", "--modes", "2", "--over", "seal.swirl.stiffness.xy=0.1:0.8:0.1kN/m",
      "--out", "locus.h5"};
  const json r = result(call);
  EXPECT_EQ(r["parameter"], "seal.swirl.stiffness.xy");
  EXPECT_EQ(r["unit"], "N/m");
  ASSERT_EQ(r["values"].size(), 8u);
  EXPECT_NEAR(r["values"][3], 400.0, 1e-9);
  ASSERT_EQ(r["branches"].size(), 2u);
  EXPECT_EQ(r["branches"][0]["number"], 1);
  EXPECT_EQ(r["branches"][0]["frequency_rpm"].size(), 8u);
  EXPECT_EQ(r["branches"][0]["eigenvalue"][0].size(), 2u);
  ASSERT_EQ(r["thresholds"].size(), 1u);
  EXPECT_NEAR(r["thresholds"][0]["value"], 400.0, 1e-6 * 400.0);
  EXPECT_NEAR(r["thresholds"][0]["frequency_rpm"], omega / rpm, 1e-7 * omega / rpm);
  EXPECT_FALSE(r.contains("gaps"));
  EXPECT_FALSE(r.contains("modes"));

  const auto found = read_result<ModesOver>(ResultReader(folder / "locus.h5"));
  EXPECT_EQ(found.parameter.path, "seal.swirl.stiffness.xy");
  EXPECT_EQ(found.values.size(), 8u);
  ASSERT_EQ(found.branches.size(), 2u);
  EXPECT_EQ(found.branches[1].eigenvalue.size(), 8);
  const std::vector<std::string> shown = kinds("locus.h5");
  EXPECT_EQ(shown, (std::vector<std::string>{"modes_over", "root_locus"}));
  const std::string text = whirl(call).out;
  EXPECT_TRUE(has(text, "swirl.stiffness.xy [kN/m]") &&
              has(text, "threshold of instability: seal.swirl.stiffness.xy = 0.4 kN/m"))
      << text;
}

// One value is the model itself: the same numbers as without --over.
TEST_F(Over, OneValueIsTheModel) {
  const json modes = result({"modes", "rotor.toml", "--modes", "2"})["modes"];
  const json over =
      result({"modes", "rotor.toml", "--modes", "2", "--over", "bearing.shaft.damping=4"});
  ASSERT_EQ(over["branches"].size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(over["branches"][i]["frequency_rpm"][0], modes[i]["frequency_rpm"]);
    EXPECT_EQ(over["branches"][i]["log_decrement"][0], modes[i]["log_decrement"]);
    EXPECT_EQ(over["branches"][i]["eigenvalue"][0], modes[i]["eigenvalue"]);
  }
  const json critical = result({"critical", "rotor.toml"})["criticals"];
  const json criticals = result({"critical", "rotor.toml", "--over", "bearing.1.damping=4"});
  ASSERT_EQ(criticals["branches"].size(), critical.size());
  EXPECT_NEAR(criticals["branches"][0]["speed_rpm"][0], critical[0]["speed_rpm"],
              rounding * omega / rpm);
}

// sqrt(k / m)
TEST_F(Over, CriticalSpeedsFollowTheStiffness) {
  const json r = result({"critical", "rotor.toml", "--over", "bearing.shaft.stiffness=10:40:10kN/m",
                         "--out", "c.h5"});
  ASSERT_EQ(r["values"].size(), 4u);
  ASSERT_EQ(r["branches"].size(), 2u);
  for (const json& branch : r["branches"]) {
    for (std::size_t i = 0; i < 4; ++i) {
      const double exact = std::sqrt(1e4 * static_cast<double>(i + 1) / m) / rpm;
      EXPECT_NEAR(branch["speed_rpm"][i], exact, rounding * exact);
    }
  }
  EXPECT_EQ(kinds("c.h5"), (std::vector<std::string>{"critical_over"}));
}

// Over the speed of a further shaft, in place of the ratio that the model has: sqrt(k / m) by
// either shaft, in the plane of both.
TEST_F(Over, CriticalSpeedsOfTwoShaftsAreAMap) {
  write("spools.toml", std::string(jeffcott) + "[[rotor]]\nname = \"hp\"\nratio = 1.4\n");
  const json r = result(
      {"critical", "spools.toml", "--over", "rotor.hp.speed=500:1500:250rpm", "--out", "map.h5"});
  EXPECT_EQ(r["shaft"], "hp");
  ASSERT_EQ(r["branches"].size(), 2u);
  EXPECT_EQ(r["branches"][0]["shaft"], "shaft");
  ASSERT_EQ(r["own_branches"].size(), 2u);
  for (const json& branch : r["own_branches"]) {
    ASSERT_EQ(branch["speed_rpm"].size(), r["lead_speed_rpm"].size());
    for (const json& speed : branch["speed_rpm"]) {
      EXPECT_NEAR(speed, omega / rpm, rounding * omega / rpm);
    }
  }
  EXPECT_EQ(kinds("map.h5"), (std::vector<std::string>{"critical_over"}));
  const auto found = read_result<CriticalOver>(ResultReader(folder / "map.h5"));
  EXPECT_EQ(found.shaft, "hp");
  ASSERT_EQ(found.own_branches.size(), 2u);
  EXPECT_NEAR(found.own_branches[1].speed(0), omega, rounding * omega);
  EXPECT_EQ(found.branches.at(1).shaft, "shaft");

  const json both = result({"critical", "spools.toml"})["criticals"];
  ASSERT_EQ(both.size(), 4u);
  EXPECT_EQ(both[3]["shaft"], "hp");
  EXPECT_EQ(both[3]["excitation"], "1.4x");
  EXPECT_NEAR(both[3]["speed_rpm"], omega / 1.4 / rpm, rounding * omega / rpm);
  EXPECT_FALSE(
      result({"critical", "rotor.toml", "--over", "bearing.1.damping=4"}).contains("shaft"));
}

// At omega: e / (2 zeta), zeta = c / (2 sqrt(k m))
TEST_F(Over, UnbalanceFollowsTheDamping) {
  const json r =
      result({"unbalance", "rotor.toml", "--speed", "100rad/s", "--speeds", "0:200:200rad/s",
              "--over", "bearing.shaft.damping=4,8,16", "--out", "u.h5"});
  ASSERT_EQ(r["stations"].size(), 1u);
  EXPECT_EQ(r["stations"][0]["station"], "rotor");
  const std::vector<double> damping{4.0, 8.0, 16.0};
  for (std::size_t i = 0; i < 3; ++i) {
    const double size = 1e-4 * std::sqrt(k * m) / damping[i];
    EXPECT_NEAR(r["stations"][0]["at_operation_m"][i], size, rounding * size);
    EXPECT_GE(r["stations"][0]["largest_m"][i], size);
  }
  ASSERT_EQ(r["peaks"].size(), 3u);
  EXPECT_EQ(r["peaks"][2]["value"], 16.0);
  EXPECT_NEAR(r["peaks"][0]["amplification"], 50.0, 0.5);  // 1 / (2 zeta), lightly damped
  EXPECT_EQ(kinds("u.h5"), (std::vector<std::string>{"unbalance_over"}));
}

// At rest an oil film carries nothing: that value is left out, and told.
TEST_F(Over, ValuesThatCannotBeComputedAreTold) {
  const std::vector<std::string> call{"modes", WHIRL_SOURCE_DIR "/models/two_disk_oil_film.toml",
                                      "--over", "operation.speed=0,300rad/s"};
  const json r = result(call);
  ASSERT_EQ(r["gaps"].size(), 1u);
  EXPECT_EQ(r["gaps"][0]["value"], 0.0);
  EXPECT_TRUE(r["branches"][0]["frequency_rpm"][0].is_null());
  EXPECT_TRUE(r["branches"][0]["frequency_rpm"][1].is_number());
  EXPECT_TRUE(has(whirl(call).out, "not computed at operation.speed = 0 rad/s"));
}

TEST_F(Over, WrongCallsAreToldBeforeTheWork) {
  for (const std::string verb : {"modes", "critical", "unbalance"}) {
    SCOPED_TRACE(verb);
    EXPECT_TRUE(
        has(problem({verb, "rotor.toml", "--over", "bearing.shaft.damping", "--out", "x.h5"}),
            "expected PATH=first:last:step"));
    EXPECT_TRUE(
        has(problem({verb, "rotor.toml", "--over", "bearing.shaft.damping=1:5", "--out", "x.h5"}),
            "has no step"));
    EXPECT_TRUE(
        has(problem({verb, "rotor.toml", "--over", "bearing.shaft.dampin=1:5:1", "--out", "x.h5"}),
            "did you mean \"damping\"?"));
    EXPECT_TRUE(has(problem({verb, "rotor.toml", "--over", "bearing.shaft.damping=-1:5:1N.s/m",
                             "--out", "x.h5"}),
                    "bearing.shaft.damping"));
    EXPECT_TRUE(has(
        problem({verb, "rotor.toml", "--over", "bearing.shaft.damping=1:5:1mm", "--out", "x.h5"}),
        "N.s/m"));
    EXPECT_TRUE(has(problem({verb, "rotor.toml", "--over", "bearing.1.damping=1,2", "--over",
                             "bearing.1.stiffness=1,2", "--out", "x.h5"}),
                    "found 2 of them, expected 1"));
    EXPECT_TRUE(has(problem({verb, "rotor.toml", "--points", "5", "--out", "x.h5"}), "--over"));
  }
}

}  // namespace over_test
}  // namespace whirl::test
