// whirl lateral: keys of its JSON, its table, and calls that mean nothing.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>

#include "libio/figures/figures.hpp"
#include "libio/text/table.hpp"
#include "tests/cli/program.hpp"

namespace whirl::test {
namespace lateral_test {

constexpr const char* machine = R"(format = 1
gravity = 9.81
[operation]
speed = "9000 rpm"
[material.steel]
density = 7800
youngs_modulus = "211 GPa"
poisson_ratio = 0.3
[[shaft]]
material = "steel"
length = "900 mm"
outer_diameter = "80 mm"
elements = 12
[[disk]]
name = "wheel"
node = 7
mass = "60 kg"
polar_inertia = 1.2
diametral_inertia = 0.7
[[bearing]]
name = "left"
node = 2
stiffness = "60 MN/m"
damping = "60 kN.s/m"
[[bearing]]
name = "right"
node = 12
stiffness = "60 MN/m"
damping = "60 kN.s/m"
[[contact]]
name = "labyrinth"
node = 6
clearance = "0.3 mm"
stiffness = 1e8
)";

class Lateral : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("machine.toml", machine);
  }
  /// What a wrong call says.
  std::string problem(std::vector<std::string> words) {
    words.insert(words.begin(), {"lateral", "machine.toml"});
    const Outcome outcome = whirl(words);
    EXPECT_EQ(outcome.status, 2);
    return outcome.err;
  }
};

TEST_F(Lateral, TellsEveryCheckBesideItsLimit) {
  const json r = result({"lateral", "machine.toml", "--minimum-speed", "8000rpm", "--maximum-speed",
                         "9500rpm", "--cross-coupling", "3MN/m"});
  EXPECT_NEAR(r["minimum_speed_rpm"], 8000.0, 1e-9);
  EXPECT_NEAR(r["maximum_speed_rpm"], 9500.0, 1e-9);
  EXPECT_NEAR(r["trip_speed_rpm"], 1.05 * 9500.0, 1e-9);
  EXPECT_NEAR(r["vibration_limit_m"], 25.4e-6, 1e-15);  // the cap: 9500 rpm are below 12 000
  ASSERT_EQ(r["journals"].size(), 2u);
  ASSERT_FALSE(r["cases"].empty());
  EXPECT_EQ(r["planes"][0]["station"], "7 wheel");
  EXPECT_NEAR(r["anticipated_n_m"], 3e6, 1e-6);
  EXPECT_GT(r["limit_n_m"], 0.0);
  EXPECT_FALSE(r["criticals"].empty());
  EXPECT_FALSE(r["campbell"]["branches"].empty());
  bool all = true;
  std::set<std::string> rules;
  for (const json& check : r["checks"]) {
    rules.insert(check["rule"]);
    if (check["verdict"] == "failed") all = false;
    if (check["verdict"] == "unknown") continue;
    const bool is_most = check["rule"] == "vibration" || check["rule"] == "running clearance";
    const double found = check["found"], limit = check["limit"];
    EXPECT_EQ(check["verdict"] == "passed", is_most ? found <= limit : found >= limit);
  }
  EXPECT_EQ(r["passed"], all);
  EXPECT_EQ(rules, (std::set<std::string>{"separation margin", "vibration", "running clearance",
                                          "log decrement", "cross-coupling", "stability region"}));
}

// What was not given is told, and nothing fails for it.
TEST_F(Lateral, SaysWhatWasNotChecked) {
  const json r = result({"lateral", "machine.toml"});
  std::map<std::string, std::string> missing;
  for (const json& check : r["checks"]) {
    if (check["missing"] == "") continue;
    missing[check["rule"]] = check["missing"];
    EXPECT_EQ(check["verdict"], "unknown");
  }
  EXPECT_EQ(missing, (std::map<std::string, std::string>{{"cross-coupling", "--cross-coupling"},
                                                         {"stability region", "--gas-density"}}));
  EXPECT_TRUE(r["region"].is_null());
  const std::string out = whirl({"lateral", "machine.toml"}).out;
  EXPECT_TRUE(has(out, "not checked: --cross-coupling not given")) << out;
  EXPECT_TRUE(has(out, "not checked: --gas-density not given"));
  EXPECT_TRUE(has(out, "2 unknown"));
  EXPECT_TRUE(has(out, "Critical speed ratio"));
}

// The region is that of the ratio of its speeds: 60 kg/m^3 take 2, more take nothing.
TEST_F(Lateral, TellsTheRegionOfTheGas) {
  const auto in_gas = [&](const char* density) {
    return result(
        {"lateral", "machine.toml", "--cross-coupling", "3MN/m", "--gas-density", density});
  };
  const json light = in_gas("2kg/m^3"), dense = in_gas("61kg/m^3");
  EXPECT_NEAR(light["gas_density_kg_m3"], 2.0, 1e-12);
  const double ratio = light["critical_speed_ratio"], rigid = light["rigid_critical_speed_rpm"];
  EXPECT_NEAR(ratio, 9000.0 / rigid, 1e-9);
  EXPECT_EQ(light["region"], ratio > 2.5 ? "B" : "A");
  EXPECT_EQ(dense["region"], "B");
  EXPECT_EQ(dense["checks"].back()["rule"], "stability region");
  EXPECT_EQ(dense["checks"].back()["limit"], 10.0);
  EXPECT_TRUE(has(problem({"--gas-density", "0kg/m^3"}), "expected a number above zero"));
  EXPECT_TRUE(has(problem({"--gas-density", "5 kg"}), "--gas-density"));
}

// [operation] says what the options would; the options win, and the trip speed does not count where
// it is below what they ask for.
TEST_F(Lateral, GoesByTheSpeedsOfTheModel) {
  std::string told = machine;
  const std::string speed = "speed = \"9000 rpm\"\n";
  told.replace(told.find(speed), speed.size(),
               speed +
                   "minimum_speed = \"8000 rpm\"\nmaximum_speed = \"9500 rpm\"\n"
                   "trip_speed = \"10500 rpm\"\n");
  write("told.toml", told);
  const json r = result({"lateral", "told.toml"});
  EXPECT_NEAR(r["minimum_speed_rpm"], 8000.0, 1e-9);
  EXPECT_NEAR(r["maximum_speed_rpm"], 9500.0, 1e-9);
  EXPECT_NEAR(r["trip_speed_rpm"], 10500.0, 1e-9);
  const json asked = result({"lateral", "machine.toml", "--minimum-speed", "8000rpm",
                             "--maximum-speed", "9500rpm", "--trip-speed", "10500rpm"});
  EXPECT_EQ(r["checks"], asked["checks"]);
  EXPECT_EQ(r["peaks"], asked["peaks"]);
  const json other =
      result({"lateral", "told.toml", "--minimum-speed", "7000rpm", "--maximum-speed", "11000rpm"});
  EXPECT_NEAR(other["minimum_speed_rpm"], 7000.0, 1e-9);
  EXPECT_NEAR(other["trip_speed_rpm"], 1.05 * 11000.0, 1e-9);
}

// In 80 columns the table is one piece: each verdict stands beside its rule.
TEST_F(Lateral, PrintsOneTableInANarrowTerminal) {
  ::setenv("COLUMNS", "80", 1);
  const std::string out =
      whirl({"lateral", "machine.toml", "--minimum-speed", "8000rpm", "--cross-coupling", "3MN/m"})
          .out;
  ::unsetenv("COLUMNS");
  std::istringstream lines(out);
  int verdicts = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("  vibration ") && line.ends_with("passed")) ++verdicts;
    EXPECT_LE(display_width(line), 80u) << line;
  }
  EXPECT_GE(verdicts, 1) << out;
}

// A seal's clearance is a running one, in check, unbalance and lateral; it moves nothing.
TEST_F(Lateral, KnowsTheClearanceOfASeal) {
  const std::string seal = "[[seal]]\nname = \"eye\"\nnode = 7\nstiffness = \"1 MN/m\"\n";
  write("without.toml", machine + seal);
  write("with.toml", machine + seal + "clearance = \"0.25 mm\"\n");
  const auto has_eye = [](const json& list) {
    return std::any_of(list.begin(), list.end(),
                       [](const json& c) { return c["name"] == "seal eye"; });
  };
  for (const char* verb : {"check", "unbalance", "lateral"}) {
    EXPECT_FALSE(has_eye(result({verb, "without.toml"})["clearances"])) << verb;
    EXPECT_TRUE(has_eye(result({verb, "with.toml"})["clearances"])) << verb;
  }
  EXPECT_EQ(result({"modes", "without.toml"})["modes"], result({"modes", "with.toml"})["modes"]);
  EXPECT_TRUE(has(whirl({"check", "with.toml"}).out, "seal eye"));
}

// T = P / Omega; 3 T / (D H) times the density ratio, summed.
TEST_F(Lateral, SumsTheCrossCouplingOfItsStages) {
  const json r =
      result({"lateral", "machine.toml", "--stages", "1MW:400mm:10mm:1.2,500kW:0.4m:10mm:1.2"});
  const double torque = 1e6 / (9000.0 * M_PI / 30.0);
  EXPECT_NEAR(r["anticipated_n_m"], 1.5 * 3.0 * torque / (0.4 * 0.01) * 1.2, 1e-3);
}

// An amplification of 4 asks for 10.2 % below 8000 rpm and for 20.2 % above 9500 rpm: the border of
// what is too near goes through both, and down to 2.5 at the speeds themselves, 10 % above the
// upper one.
TEST_F(Lateral, DrawsWhatIsTooNearAndEveryCheck) {
  const json r = result({"lateral", "machine.toml", "--minimum-speed", "8000rpm", "--maximum-speed",
                         "9500rpm", "--out", "l.h5"});
  const ResultView view(folder / "l.h5");
  const auto kind = std::find_if(figure_kinds().begin(), figure_kinds().end(),
                                 [](const FigureKind& k) { return k.name == "lateral"; });
  const std::vector<Figure> figures = figures_of(*kind, view);
  ASSERT_EQ(figures.size(), 1u);
  EXPECT_EQ(figures[0].table.rows.size(), r["checks"].size());
  const Curve& border = figures[0].panels.at(0).curves.at(0);
  const auto goes_through = [&](double rpm, double AF) {
    for (std::size_t i = 1; i < border.x.size(); ++i) {
      const double low = std::min(border.y[i - 1], border.y[i]);
      const double high = std::max(border.y[i - 1], border.y[i]);
      if (AF < low || AF > high || low == high) continue;
      const double share = (AF - border.y[i - 1]) / (border.y[i] - border.y[i - 1]);
      const double x = border.x[i - 1] + share * (border.x[i] - border.x[i - 1]);
      if (std::abs(x - rpm) < 5.0) return true;  // between points of a curve
    }
    return false;
  };
  EXPECT_TRUE(goes_through(8000.0 * (1.0 - 0.102), 4.0));
  EXPECT_TRUE(goes_through(9500.0 * (1.0 + 0.202), 4.0));
  EXPECT_TRUE(goes_through(8000.0, 2.5));
  EXPECT_TRUE(goes_through(9500.0 * 1.1, 2.5));
  EXPECT_FALSE(goes_through(8000.0, 4.0));
}

TEST_F(Lateral, PrintsItsTableWithTheRules) {
  const std::string out = whirl({"lateral", "machine.toml"}).out;
  EXPECT_TRUE(has(out, "Checks: ")) << out;
  EXPECT_TRUE(has(out, "[API 617]"));
  EXPECT_TRUE(has(out, "contact labyrinth"));
}

TEST_F(Lateral, SaysWhatIsWrongWithItsSpeeds) {
  EXPECT_TRUE(has(problem({"--minimum-speed", "9500rpm"}), "is above the maximum speed"));
  EXPECT_TRUE(has(problem({"--trip-speed", "8000rpm"}), "is below the maximum speed"));
  EXPECT_TRUE(has(problem({"--maximum-speed", "0rpm"}), "expected a number above zero"));
  EXPECT_TRUE(has(problem({"--maximum-speed", "5 kg"}), "--maximum-speed"));
  EXPECT_TRUE(
      has(whirl({"lateral", "machine.toml", "--minimum-speed", "800"}).err, "--minimum-speed"));
  write("no_speed.toml",
        std::string(machine).replace(std::string(machine).find("[operation]"), 30, ""));
  EXPECT_TRUE(has(whirl({"lateral", "no_speed.toml"}).err, "has no operating speed"));
}

TEST_F(Lateral, SaysWhatIsWrongWithItsStages) {
  EXPECT_TRUE(has(problem({"--stages", "1MW:400mm:10mm"}), "power, diameter, width and density"));
  EXPECT_TRUE(has(problem({"--stages", "1MW:400mm:10kg:1.2"}), "--stages"));
  EXPECT_TRUE(has(problem({"--stages", "1MW:400mm:0mm:1.2"}), "expected a number above zero"));
  EXPECT_TRUE(has(problem({"--cross-coupling", "-1MN/m"}), "expected a number above zero"));
  EXPECT_TRUE(has(problem({"--stages", "1MW:400mm:10mm:1.2", "--cross-coupling", "1MN/m"}),
                  "leave out --cross-coupling"));
}

TEST_F(Lateral, NeedsAShaftThatIsHeld) {
  write("rotor.toml", jeffcott);
  EXPECT_TRUE(has(whirl({"lateral", "rotor.toml", "--maximum-speed", "900rpm"}).err,
                  "a lateral analysis needs a shaft"));
}

// 25.4 sqrt(12 000 / 16 000) um are sqrt(3 / 4) mil; below 12 000 rpm 1 mil is allowed, and not
// more.
TEST_F(Lateral, VibrationIsToldInTheUnitOfTheProbes) {
  const auto with_probes = [&](const char* other) {
    write("machine.toml", std::string(machine) + R"([[probe]]
name = "1X"
node = 3
angle = 0
unit = "mil"
[[probe]]
name = "1Y"
node = 3
angle = "90 deg"
unit = ")" + other + "\"\n");
  };
  with_probes("mil");
  const std::string text =
      whirl({"lateral", "machine.toml", "--maximum-speed", "16000rpm", "--out", "l.h5"}).out;
  EXPECT_TRUE(has(text, "0.866 mil") && has(text, "peak to peak [mil]")) << text;
  EXPECT_NEAR(result({"lateral", "machine.toml"})["vibration_limit_m"].get<double>(), 25.4e-6,
              1e-15);
  const ResultView view(folder / "l.h5");
  for (const FigureKind& kind : figure_kinds()) {
    if (kind.name != "lateral_response") continue;
    const Figure f = figures_of(kind, view).at(0);
    EXPECT_EQ(f.panels.at(0).y.title, "peak to peak [mil]");
    EXPECT_TRUE(has(f.notes.back(), "0.866 mil")) << f.notes.back();
  }
  with_probes("um");  // of two units neither is that of the report
  EXPECT_TRUE(has(whirl({"lateral", "machine.toml"}).out, "25.4 um"));
}

}  // namespace lateral_test
}  // namespace whirl::test
