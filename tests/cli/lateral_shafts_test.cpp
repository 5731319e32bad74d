// whirl lateral of a geared pair: keys of its JSON, its table, its page, and its options.

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "libio/figures/figures.hpp"
#include "tests/cli/program.hpp"

namespace whirl::test {
namespace lateral_shafts_test {

constexpr const char* geared = R"(format = 1
gravity = 9.81
[operation]
speed = "6000 rpm"
[material.steel]
density = 7800
youngs_modulus = "211 GPa"
poisson_ratio = 0.3
[[rotor]]
name = "pinion"
ratio = -2.5
[[shaft]]
material = "steel"
length = "900 mm"
outer_diameter = "120 mm"
elements = 6
[[shaft]]
rotor = "pinion"
material = "steel"
length = "900 mm"
outer_diameter = "70 mm"
elements = 6
[[disk]]
name = "bull gear"
at = "450 mm"
mass = "120 kg"
polar_inertia = 4
diametral_inertia = 2.2
[[disk]]
name = "impeller"
rotor = "pinion"
at = "900 mm"
mass = "12 kg"
polar_inertia = 0.08
diametral_inertia = 0.05
[[bearing]]
name = "bull left"
at = 0
stiffness = "100 MN/m"
damping = "100 kN.s/m"
[[bearing]]
name = "bull right"
at = "900 mm"
stiffness = "100 MN/m"
damping = "100 kN.s/m"
[[bearing]]
name = "pinion left"
rotor = "pinion"
at = "150 mm"
stiffness = "60 MN/m"
damping = "60 kN.s/m"
[[bearing]]
name = "pinion right"
rotor = "pinion"
at = "750 mm"
stiffness = "60 MN/m"
damping = "60 kN.s/m"
[[gear]]
name = "mesh"
driving = { at = "450 mm" }
driven = { at = "450 mm", rotor = "pinion" }
stiffness = "200 MN/m"
driving_radius = "250 mm"
driven_radius = "100 mm"
)";

class LateralShafts : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("geared.toml", geared);
  }
};

TEST_F(LateralShafts, NamesTheShaftOfEachRow) {
  const json r = result({"lateral", "geared.toml", "--out", "l.h5"});
  const std::set<std::string> both{"shaft", "pinion"};
  for (const char* list :
       {"journals", "probes", "cases", "planes", "peaks", "forces", "level_one"}) {
    std::set<std::string> named;
    for (const json& row : r[list]) named.insert(row["shaft"]);
    EXPECT_EQ(named, both) << list;
  }
  for (const json& c : r["checks"]) EXPECT_TRUE(both.contains(c["shaft"])) << c;
  for (const json& c : r["cases"]) EXPECT_EQ(c["order"], c["shaft"] == "pinion" ? 2.5 : 1.0);
  ASSERT_EQ(r["shafts"].size(), 2u);
  const json& pinion = r["shafts"][1];
  EXPECT_EQ(pinion["name"], "pinion");
  EXPECT_NEAR(pinion["maximum_speed_rpm"], 15000.0, 1e-9);
  EXPECT_NEAR(pinion["vibration_limit_m"], 25.4e-6 * std::sqrt(12000.0 / 15000.0), 1e-15);
  for (const json& c : r["checks"]) {
    if (c["rule"] != "vibration") continue;
    const json& of = r["cases"][c["case"].get<std::size_t>() - 1];
    const json& probe = r["probes"][of["vibration_probe"].get<std::size_t>() - 1];
    const double speed = probe["shaft"] == "pinion" ? 15000.0 : 6000.0;
    EXPECT_NEAR(c["limit"], 25.4e-6 * std::min(1.0, std::sqrt(12000.0 / speed)), 1e-15);
  }
  const std::string out = whirl({"lateral", "geared.toml"}).out;
  EXPECT_TRUE(has(out, "Shafts by their own speeds")) << out;
  EXPECT_TRUE(has(out, "pinion: ")) << out;
  EXPECT_TRUE(has(out, "first shaft: ")) << out;
  const ResultView view(folder / "l.h5");
  for (const FigureKind& kind : figure_kinds()) {
    if (kind.name != "lateral_response") continue;
    EXPECT_EQ(figures_of(kind, view).size(), r["cases"].size());
    EXPECT_TRUE(has(figures_of(kind, view).back().subtitle, " of pinion"));
  }
  const std::string page = (folder / "page.html").string();
  EXPECT_EQ(whirl({"report", "l.h5", "--out", page}).status, 0);
  EXPECT_TRUE(has(content(page), "Shafts by their own speeds"));
}

// The gas is in one of them: Q_A follows from the torque at its own speed.
TEST_F(LateralShafts, TakeCrossCouplingOnOneOfThem) {
  const json r = result({"lateral", "geared.toml", "--coupled-shaft", "pinion", "--stages",
                         "1MW:300mm:10mm:1.2", "--gas-density", "20kg/m^3"});
  const double torque = 1e6 / (15000.0 * rpm);
  EXPECT_NEAR(r["anticipated_n_m"], 3.0 * torque / (0.3 * 0.01) * 1.2, 1e-3);
  for (const json& c : r["checks"]) {
    if (c["rule"] == "cross-coupling" || c["rule"] == "stability region") {
      EXPECT_EQ(c["shaft"], "pinion");
    }
  }
  EXPECT_NEAR(r["critical_speed_ratio"].get<double>(),
              15000.0 / r["shafts"][1]["rigid_critical_speed_rpm"].get<double>(), 1e-9);
  EXPECT_TRUE(has(whirl({"lateral", "geared.toml", "--coupled-shaft", "gear"}).err,
                  "is no [[rotor]] of the model"));
}

TEST_F(LateralShafts, RefuseSpeedsOfTheirOwn) {
  std::string own = geared;
  own.replace(own.find("ratio = -2.5"), 12, "speed = \"9000 rpm\"");
  own.resize(own.find("[[gear]]"));
  write("own.toml", own);
  const Outcome refused = whirl({"lateral", "own.toml"});
  EXPECT_NE(refused.status, 0);
  EXPECT_TRUE(has(refused.err, "it has a speed of its own")) << refused.err;
}

}  // namespace lateral_shafts_test
}  // namespace whirl::test
