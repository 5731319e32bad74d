// Linear verbs with oil films, bearing tables and seals.

#include <cmath>

#include "tests/cli/linear.hpp"

namespace whirl::test {
namespace linear_bearings_test {

constexpr double rounding = 1e-9;  // relative, of solvers on two dofs

/// A mass that an oil film carries.
constexpr const char* on_oil = R"(format = 1
gravity = 9.81
[operation]
speed = "3000 rpm"
[[body]]
name = "journal"
mass = 20
spins = true
[[oil_film]]
name = "left"
body = "journal"
radius = "25 mm"
length = "12 mm"
clearance = "0.11 mm"
viscosity = "18 mPa.s"
[[unbalance]]
body = "journal"
offset = "1 um"
)";

// Tables as spreadsheets save them: UTF-16 with its mark, and Windows-1252, were refused.
TEST_F(Linear, TablesMayBeInOtherEncodings) {
  write("table.toml",
        "format = 1\n[operation]\nspeed = \"3000 rpm\"\n[[body]]\nname = \"mass\"\nmass = 20\n"
        "spins = true\n[[bearing]]\nname = \"left\"\nbody = \"mass\"\ntable = \"table.csv\"\n");
  const std::string rows = "speed [rpm];kxx [N/m];kyy [N/m]\n1000;1e6;2e6\n5000;3e6;4e6\n";
  std::string wide = "\xFF\xFE";
  for (const char c : rows) wide += {c, '\0'};
  write("table.csv", rows);
  const json plain = result({"modes", "table.toml"})["modes"];
  for (const std::string& text : {wide, "# K\xFChlung aus\n" + rows}) {
    write("table.csv", text);
    EXPECT_EQ(result({"modes", "table.toml"})["modes"], plain);
  }
}

TEST_F(Linear, VerbsThatLeaveContactsAndOilFilmsOutSaySo) {
  write("oil.toml", on_oil);
  write("rubbing.toml", rubbing);
  for (const std::string verb : {"modes", "campbell", "unbalance", "resonances"}) {
    SCOPED_TRACE(verb);
    EXPECT_TRUE(
        has(result({verb, "oil.toml", "--set", "oil_film.left.linearize=false"})["notes"].at(0),
            "left out: oil film left"));
  }
  for (const std::string verb : {"static", "modes", "campbell", "critical", "unbalance"}) {
    SCOPED_TRACE(verb);
    EXPECT_TRUE(has(result({verb, "rubbing.toml"})["notes"].dump(), "left out: contact ring"));
    EXPECT_EQ(result({verb, "rotor.toml"})["notes"].size(), 0u);
  }
  const Outcome stored = whirl({"modes", "rubbing.toml", "--out", "r.h5"});
  EXPECT_EQ(stored.status, 0) << stored.err;
  EXPECT_TRUE(has(stored.out, "note: left out: contact ring")) << stored.out;
}

// Every linear verb has the film, where its journal runs at each speed, and says so.
TEST_F(Linear, VerbsLinearizeOilFilmsAndSaySo) {
  write("oil.toml", on_oil);
  for (const std::string verb : {"modes", "campbell", "critical", "unbalance", "resonances"}) {
    SCOPED_TRACE(verb);
    EXPECT_TRUE(has(result({verb, "oil.toml"})["notes"].at(0),
                    "linearized about the static equilibrium at each speed: oil film left"));
  }
  const json at_rest = result({"static", "oil.toml", "--out", "static.h5"});
  EXPECT_EQ(at_rest["notes"].size(), 0u);
  ASSERT_EQ(at_rest["films"].size(), 1u);
  const json& film = at_rest["films"][0];
  EXPECT_EQ(film["name"], "left");
  const double ratio = film["eccentricity"], Q = 1.0 - ratio * ratio, W = 20 * 9.81,
               pi = std::numbers::pi;
  EXPECT_NEAR(film["attitude_deg"], std::atan(pi * std::sqrt(Q) / (4.0 * ratio)) * 180.0 / pi,
              1e-6);
  EXPECT_NEAR(film["film_m"], (1.0 - ratio) * 1.1e-4, 1e-12);
  EXPECT_NEAR(film["fy_n"], -W, 1e-8 * W);
  EXPECT_NEAR(film["sommerfeld"], 0.018 * 50.0 * 0.05 * 0.012 / W * std::pow(0.025 / 1.1e-4, 2),
              1e-9);
  for (const char* part : {"xx", "xy", "yx", "yy"}) {
    EXPECT_TRUE(film["stiffness"][part].is_number()) << part;
    EXPECT_TRUE(film["damping"][part].is_number()) << part;
  }
  EXPECT_GT(film["power_loss_w"], 0.0);
  const Outcome text = whirl({"static", "oil.toml"});
  EXPECT_TRUE(has(text.out, "Journals on their oil films at 3000 rpm")) << text.out;
  // the threshold lies between the speeds where its branch loses its damping
  const std::string speeds = "5000:15000:1000rpm";
  const json diagram = result({"campbell", "oil.toml", "--speeds", speeds, "--out", "c.h5"});
  ASSERT_EQ(diagram["thresholds"].size(), 1u) << diagram["thresholds"];
  const json& threshold = diagram["thresholds"][0];
  const double speed = threshold["speed_rpm"], frequency = threshold["frequency_rpm"];
  EXPECT_GT(frequency, 0.0);
  EXPECT_LT(frequency, 0.5 * speed);
  const json& branch = diagram["branches"].at(threshold["mode"].get<std::size_t>() - 1);
  const auto below = static_cast<std::size_t>((speed - 5000.0) / 1000.0);
  EXPECT_GT(branch["log_decrement"].at(below), 0.0);
  EXPECT_LT(branch["log_decrement"].at(below + 1), 0.0);
  EXPECT_TRUE(
      has(whirl({"campbell", "oil.toml", "--speeds", speeds}).out, "threshold of instability: "));
  EXPECT_GE(result({"critical", "oil.toml"})["criticals"].size(), 1u);
  EXPECT_GT(result({"unbalance", "oil.toml"})["stations"][0]["major_m"].back(), 0.0);
}

TEST_F(Linear, OilFilmsWithoutSpeedCarryNothing) {
  write("oil.toml", on_oil);
  const Outcome modes = whirl({"modes", "oil.toml", "--speed", "0rpm"});
  EXPECT_EQ(modes.status, 3);
  EXPECT_TRUE(has(modes.err, "without speed a film carries nothing")) << modes.err;
  const json diagram = result({"campbell", "oil.toml", "--speeds", "0:3000:1000rpm"});
  ASSERT_EQ(diagram["gaps"].size(), 1u);
  EXPECT_EQ(diagram["gaps"][0]["speed_rpm"], 0.0);
}

TEST_F(Linear, BearingTablesHeldConstantBeyondTheirEndsAreTold) {
  write("k.csv", "speed [rpm],kxx,kyy,cxx,cyy\n500,2e4,2e4,4,4\n2000,4e4,4e4,4,4\n");
  write("table.toml", R"(format = 1
[operation]
speed = "1000 rpm"
[[body]]
name = "rotor"
mass = 2
spins = true
[[bearing]]
name = "seat"
body = "rotor"
table = "k.csv"
[[unbalance]]
body = "rotor"
offset = "0.1 mm"
)");
  const auto notes = [&](const std::vector<std::string>& words) { return result(words)["notes"]; };
  EXPECT_EQ(notes({"modes", "table.toml"}).size(), 0u);
  const json above_alone{
      "the table of bearing seat goes from 500 to 2000 rpm; its ends are held constant above "
      "(asked: 2500 rpm)"};
  EXPECT_EQ(notes({"modes", "table.toml", "--speed", "2500rpm"}), above_alone);
  const json both = notes({"campbell", "table.toml", "--speeds", "0:3000:100rpm"});
  ASSERT_EQ(both.size(), 1u);
  EXPECT_TRUE(has(both[0], "below (asked: 0 rpm) and above (asked: 3000 rpm)")) << both;
  EXPECT_EQ(notes({"unbalance", "table.toml", "--speeds", "600:1900:100rpm"}).size(), 0u);
  for (const char* verb : {"simulate", "classify", "orbit"}) {
    SCOPED_TRACE(verb);
    EXPECT_EQ(notes({verb, "table.toml", "--discard", "10"}).size(), 0u);
    EXPECT_EQ(notes({verb, "table.toml", "--discard", "10", "--speed", "2500rpm"}), above_alone);
  }
  const auto swept = [&](const char* range) {
    return notes({"sweep", "table.toml", "--over", range, "--revolutions", "4", "--discard", "4"});
  };
  EXPECT_EQ(swept("operation.speed=1000:2000:500rpm").size(), 0u);
  EXPECT_EQ(swept("operation.speed=1500:2500:500rpm"), above_alone);
}

/// A mass of 2 kg on a bearing, and a seal over the whirl frequency: k(w) = 1e4 + 50 w [rad/s].
constexpr const char* sealed = R"(format = 1
[operation]
speed = "600 rpm"
[[body]]
name = "mass"
mass = 2
spins = true
[[bearing]]
body = "mass"
stiffness = 2e4
[[seal]]
name = "eye"
body = "mass"
table = "seal.csv"
[start]
from = "rest"
)";

// 2 w^2 = 3e4 + 50 w; the result holds the table and can be opened when its file is gone.
TEST_F(Linear, ASealHasItsCoefficientsAtTheFrequencyOfEachMode) {
  write("sealed.toml", sealed);
  write("seal.csv", "whirl,kxx,kyy\n0,1e4,1e4\n1000,6e4,6e4\n");
  const json r = result({"modes", "sealed.toml", "--out", "modes.h5"});
  const double w = 12.5 + std::sqrt(12.5 * 12.5 + 1.5e4);
  ASSERT_EQ(r["modes"].size(), 2u);
  EXPECT_NEAR(r["modes"][0]["frequency_rpm"].get<double>(), w * 30.0 / pi, rounding * w);
  EXPECT_EQ(r["notes"].size(), 0u);
  // a motion has many frequencies: the coefficients are those at 600 rpm
  const json motion = result({"simulate", "sealed.toml", "--revolutions", "2"});
  ASSERT_EQ(motion["notes"].size(), 1u);
  EXPECT_EQ(motion["notes"][0],
            "coefficients of seal eye depend on the whirl frequency; the motion is computed with "
            "those at which it is the speed");
  // the static sag has none
  const json sag = result({"static", "sealed.toml", "--set", "gravity=10"});
  ASSERT_EQ(sag["bearings"].size(), 2u);
  EXPECT_EQ(sag["bearings"][1]["name"], "eye");
  EXPECT_NEAR(sag["bearings"][1]["fy_n"].get<double>(), -20.0 / 3.0, rounding);
}

TEST_F(Linear, SealsAreReportedAndSet) {
  write("sealed.toml", sealed);
  write("seal.csv", "whirl,kxx,kyy\n0,1e4,1e4\n1000,6e4,6e4\n");
  const Outcome check = whirl({"check", "sealed.toml"});
  EXPECT_NE(check.out.find("seals"), std::string::npos) << check.out;
  const json pchip = result({"modes", "sealed.toml", "--set", "seal.eye.interpolation=pchip"});
  EXPECT_EQ(pchip["modes"].size(), 2u);
}

}  // namespace linear_bearings_test
}  // namespace whirl::test
