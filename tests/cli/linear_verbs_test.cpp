// check, static, modes, campbell, critical, unbalance: JSON keys, and values in closed form.

#include <cmath>
#include <complex>
#include <numbers>

#include "tests/cli/linear.hpp"

namespace whirl::test {
namespace linear_verbs_test {

constexpr double m = 2.0, k = 2e4, c = 4.0, e = 1e-4, g = 9.81;  // of `jeffcott`
constexpr double omega = 100.0, zeta = 0.01;
constexpr double rounding = 1e-9;  // relative, of solvers on two dofs

TEST_F(Linear, EveryVerbSaysModelVersionAndSpeed) {
  for (const std::string& verb : model_verbs) {
    SCOPED_TRACE(verb);
    const json r = result(briefly({verb, "rotor.toml", "--speed", "300rpm"}));
    EXPECT_EQ(r["model"], "rotor.toml");
    EXPECT_TRUE(r["version"].is_string());
    EXPECT_DOUBLE_EQ(r["speed_rpm"].get<double>(), 300.0);
  }
}

// A mass whose bearing feeds its forward whirl, Q = 3 MN/m against c omega = 0.5 MN/m, is unstable
// at every speed. It has a response to unbalance and a receptance all the same, a margin that is
// kept, and no threshold: each verb says in a note that it is unstable. Of the stable rotor none
// does.
TEST_F(Linear, SaysOfAnUnstableRotorThatItIs) {
  const std::string text = R"(format = 1
[operation]
speed = "6000 rpm"
[[body]]
name = "disk"
mass = 40
spins = true
[[unbalance]]
body = "disk"
moment = 1e-4
[[bearing]]
body = "disk"
damping = 1000
)";
  write("stable.toml", text + "stiffness = 1e7\n");
  write("unstable.toml", text + "stiffness = { xx = 1e7, yy = 1e7, xy = 3e6, yx = -3e6 }\n");
  const std::vector<std::vector<std::string>> calls{
      {"unbalance", "--speeds", "0:6000:500rpm"},
      {"frf", "--from", "disk:x", "--to", "disk:x", "--frequencies", "10:100:10Hz"},
      {"unbalance", "--speeds", "0:6000:500rpm", "--over", "bearing.1.damping=900:1000:100"},
      {"campbell", "--speeds", "0:6000:500rpm"}};
  for (std::vector<std::string> call : calls) {
    SCOPED_TRACE(call.front());
    const auto notes_of = [&](const char* model) {
      std::vector<std::string> line = call;
      line.insert(line.begin() + 1, model);
      return result(line)["notes"].dump();
    };
    const std::string unstable = notes_of("unstable.toml"), stable = notes_of("stable.toml");
    EXPECT_TRUE(has(unstable, "the rotor is unstable")) << unstable;
    EXPECT_FALSE(has(stable, "unstable")) << stable;
  }
}

// Cylinder of 600 mm x 20 mm and a disk of 5 kg, 0.06 kg.m^2 at 150 mm:
//   m_s = rho pi d^2 L / 4,  Ip = m_s d^2 / 8 + 0.06
TEST_F(Linear, Check) {
  write("shaft.toml", R"(format = 1
[material.steel]
density = 7800
youngs_modulus = "211 GPa"
poisson_ratio = 0.3
[[shaft]]
material = "steel"
length = "600 mm"
outer_diameter = "20 mm"
elements = 12
[[disk]]
node = 4
mass = 5
diametral_inertia = 0.03
polar_inertia = 0.06
[[bearing]]
node = 1
rigid = true
[[bearing]]
node = 13
stiffness = 1e6
[[contact]]
node = 7
clearance = 1e-3
stiffness = 1e6
)");
  const double shaft = 7800.0 * pi * 0.02 * 0.02 / 4.0 * 0.6;
  json r = result({"check", "shaft.toml"});
  EXPECT_NEAR(r["mass_kg"], shaft + 5.0, 1e-12);
  EXPECT_NEAR(r["length_m"], 0.6, 1e-15);
  EXPECT_EQ(r["nodes"], 13);
  EXPECT_EQ(r["dofs"], 50);  // two are pinned
  EXPECT_EQ(r["condensed_dofs"], 0);
  EXPECT_EQ(r["contacts"], 1);
  EXPECT_NEAR(r["center_of_mass_m"], (shaft * 0.3 + 5.0 * 0.15) / (shaft + 5.0), 1e-12);
  EXPECT_NEAR(r["polar_inertia_kg_m2"], shaft * 0.02 * 0.02 / 8.0 + 0.06, 1e-12);
  // of the shaft m (3 r^2 + L^2) / 12 about its middle, and what is off the center by Steiner
  const double center = r["center_of_mass_m"];
  const double transverse = shaft * (0.75 * 0.02 * 0.02 + 0.6 * 0.6) / 12.0 +
                            shaft * std::pow(0.3 - center, 2) + 0.03 +
                            5.0 * std::pow(0.15 - center, 2);
  EXPECT_NEAR(r["transverse_inertia_kg_m2"], transverse, 1e-12);
  // no gravity: nothing is carried, and the ring is 1 mm away
  ASSERT_EQ(r["bearing_loads"].size(), 2u);
  EXPECT_EQ(r["bearing_loads"][1]["name"], "bearing 2");
  EXPECT_EQ(r["bearing_loads"][1]["fy_n"], 0.0);
  ASSERT_EQ(r["clearances"].size(), 1u);
  EXPECT_EQ(r["clearances"][0]["name"], "contact 1");
  EXPECT_EQ(r["clearances"][0]["left_m"], 1e-3);

  // the levers of the weights share the load; the ring is nearer by the sag there
  r = result({"check", "shaft.toml", "--set", "gravity=10"});
  const double right = 10.0 * (shaft * 0.3 + 5.0 * 0.15) / 0.6;
  EXPECT_NEAR(r["bearing_loads"][1]["fy_n"], -right, 1e-9);
  EXPECT_NEAR(r["bearing_loads"][0]["fy_n"], right - 10.0 * (shaft + 5.0), 1e-9);
  const json sag = result({"static", "shaft.toml", "--set", "gravity=10"});
  const double y = sag["stations"][6]["y_m"];
  EXPECT_NEAR(r["clearances"][0]["distance_m"], -y, 1e-15);
  EXPECT_NEAR(r["clearances"][0]["left_m"], 1e-3 + y, 1e-15);

  // a rotor that nothing holds has no rest
  r = result(
      {"check", "shaft.toml", "--set", "bearing.1.rigid=false", "--set", "bearing.1.damping=1e3"});
  EXPECT_TRUE(r["bearing_loads"].empty());
  EXPECT_TRUE(r["clearances"].empty());

  // without mass only the disk's dofs are left
  r = result({"check", "shaft.toml", "--set", "material.steel.density=0"});
  EXPECT_NEAR(r["mass_kg"], 5.0, 1e-12);
  EXPECT_EQ(r["dofs"], 50);
  EXPECT_EQ(r["condensed_dofs"], 46);

  const std::string text = whirl({"check", "shaft.toml"}).out;
  EXPECT_TRUE(has(text, "disk 1 (150 mm)")) << text;
  EXPECT_TRUE(has(text, "The model is in order."));
  EXPECT_TRUE(r["warnings"].empty());

  // lengths that were meant in millimeters
  const std::vector<std::string> long_one{"check", "shaft.toml", "--set", "shaft.1.length=300"};
  const std::string warned = whirl(long_one).out;
  EXPECT_FALSE(has(warned, "The model is in order.")) << warned;
  EXPECT_TRUE(has(warned, "The model can be read, but there is a warning:")) << warned;
  EXPECT_TRUE(has(warned, "did you mean 300 mm, or in?")) << warned;
  const auto warnings = result(long_one)["warnings"];
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0]["key"], "shaft");
  EXPECT_EQ(warnings[0]["file"], "shaft.toml");

  r = result({"check", "rotor.toml"});
  EXPECT_EQ(r["mass_kg"], m);
  EXPECT_EQ(r["nodes"], 0);
  EXPECT_TRUE(r["center_of_mass_m"].is_null());
}

// y = -m g / k; the bearing carries the weight
TEST_F(Linear, StaticOfAMassOnASpring) {
  const json r = result({"static", "rotor.toml"});
  ASSERT_EQ(r["stations"].size(), 1u);
  const json& s = r["stations"][0];
  EXPECT_TRUE(s["node"].is_null());
  EXPECT_EQ(s["name"], "rotor");
  EXPECT_NEAR(s["x_m"], 0.0, 1e-18);
  EXPECT_NEAR(s["y_m"], -m * g / k, rounding * m * g / k);
  ASSERT_EQ(r["bearings"].size(), 1u);
  EXPECT_EQ(r["bearings"][0]["name"], "shaft");
  EXPECT_NEAR(r["bearings"][0]["fx_n"], 0.0, 1e-12);
  EXPECT_NEAR(r["bearings"][0]["fy_n"], -m * g, rounding * m * g);
}

// Mass at the middle of a massless slender shaft on pins: y = -m g L^3 / (48 E I)
TEST_F(Linear, StaticOfADiskOnAShaft) {
  write("shaft.toml", R"(format = 1
gravity = "9.81 m/s^2"
[material.wire]
density = 0
youngs_modulus = "200 GPa"
poisson_ratio = 0.3
[[shaft]]
material = "wire"
length = 1
outer_diameter = "20 mm"
theory = "euler-bernoulli"
[[disk]]
name = "wheel"
at = "500 mm"
mass = 10
diametral_inertia = 0.1
[[bearing]]
name = "left"
at = 0
rigid = true
[[bearing]]
name = "right"
at = 1
rigid = true
)");
  const double I = pi / 64.0 * std::pow(0.02, 4), sag = 10.0 * g / (48.0 * 200e9 * I);
  const json r = result({"static", "shaft.toml"});
  bool found = false;
  for (const json& s : r["stations"]) {
    EXPECT_TRUE(s["node"].is_number_integer());
    if (s["name"] != "wheel") continue;
    found = true;
    EXPECT_NEAR(s["y_m"], -sag, rounding * sag);
  }
  EXPECT_TRUE(found);
  for (const json& b : r["bearings"]) EXPECT_NEAR(b["fy_n"], -5.0 * g, 1e-7);
}

// lambda = -zeta omega +- i omega sqrt(1 - zeta^2)
TEST_F(Linear, Modes) {
  const json r = result({"modes", "rotor.toml", "--modes", "2"});
  ASSERT_EQ(r["modes"].size(), 2u);
  const double frequency = omega * std::sqrt(1.0 - zeta * zeta);
  int number = 0;
  for (const json& mode : r["modes"]) {
    EXPECT_EQ(mode["number"], ++number);
    EXPECT_NEAR(mode["frequency_rpm"], frequency / rpm, rounding * frequency / rpm);
    EXPECT_NEAR(mode["damping_ratio"], zeta, rounding);
    EXPECT_NEAR(mode["log_decrement"], 2.0 * pi * zeta / std::sqrt(1.0 - zeta * zeta), rounding);
    EXPECT_NEAR(mode["eigenvalue"][0], -zeta * omega, rounding * omega);
    EXPECT_NEAR(mode["eigenvalue"][1], frequency, rounding * omega);
    EXPECT_EQ(mode["whirl"], "planar");
    EXPECT_TRUE(mode["kappa"].is_number());
  }
  EXPECT_TRUE(r["real_roots"].is_array());
  // 99.995 rad/s for people: 954.88 rpm, 15.915 Hz
  const std::string text = whirl({"modes", "rotor.toml", "--modes", "2"}).out;
  EXPECT_TRUE(has(text, "954.9") && has(text, "15.91")) << text;
}

// Of a large rotor the first modes that are found, without the proof that none is missed, which the
// answer says. A small rotor has all its modes at once.
TEST_F(Linear, ModesWithoutProof) {
  const std::string shaft = WHIRL_SOURCE_DIR "/bench/instructions/shaft.toml";
  const json proven = result({"modes", shaft}), found = result({"modes", shaft, "--unproven"});
  EXPECT_EQ(proven["proven"], true);
  EXPECT_EQ(found["proven"], false);
  ASSERT_EQ(found["modes"].size(), proven["modes"].size());
  for (std::size_t i = 0; i < found["modes"].size(); ++i) {
    const double expected = proven["modes"][i]["frequency_rpm"];
    EXPECT_NEAR(found["modes"][i]["frequency_rpm"], expected, 1e-8 * expected);
  }
  EXPECT_TRUE(has(whirl({"modes", shaft, "--unproven"}).out, "a mode may be missing"));
  EXPECT_EQ(result({"modes", "rotor.toml", "--unproven"})["proven"], true);
  EXPECT_TRUE(
      has(whirl({"modes", shaft, "--unproven", "--over", "operation.speed=1000,2000rpm"}).err,
          "--unproven: does not go with --over"));
}

// c = 4 sqrt(k m): lambda = -omega (2 +- sqrt(3)), both real, in x and in y
TEST_F(Linear, ModesThatDoNotOscillateAreRealRoots) {
  const json r = result({"modes", "rotor.toml", "--set", "bearing.shaft.damping=800"});
  EXPECT_EQ(r["modes"].size(), 0u);
  std::vector<double> roots = r["real_roots"];
  ASSERT_EQ(roots.size(), 4u);
  std::sort(roots.begin(), roots.end());
  EXPECT_NEAR(roots[0], -omega * (2.0 + std::sqrt(3.0)), 1e-6);
  EXPECT_NEAR(roots[3], -omega * (2.0 - std::sqrt(3.0)), 1e-6);
}

TEST_F(Linear, ModesAscendAndNameTheirWhirl) {
  const json r = result({"modes", WHIRL_SOURCE_DIR "/models/two_disk_mac.toml"});
  ASSERT_EQ(r["modes"].size(), 8u);
  double last = 0.0;
  for (const json& mode : r["modes"]) {
    EXPECT_GT(mode["frequency_rpm"].get<double>(), last);
    last = mode["frequency_rpm"];
    const double kappa = mode["kappa"];
    EXPECT_EQ(mode["whirl"], kappa > 0.0 ? "forward" : "backward");
  }
}

TEST_F(Linear, Campbell) {
  const json r = result({"campbell", "rotor.toml", "--speeds", "0:1500:100rpm", "--modes", "2"});
  ASSERT_EQ(r["speeds_rpm"].size(), 16u);
  EXPECT_NEAR(r["speeds_rpm"][15], 1500.0, 1e-9);
  ASSERT_EQ(r["branches"].size(), 2u);
  const double frequency = omega * std::sqrt(1.0 - zeta * zeta) / rpm;
  int number = 0;
  for (const json& branch : r["branches"]) {
    EXPECT_EQ(branch["number"], ++number);
    EXPECT_TRUE(branch["whirl"].is_string());
    ASSERT_EQ(branch["frequency_rpm"].size(), 16u);
    ASSERT_EQ(branch["log_decrement"].size(), 16u);
    for (const double value : branch["frequency_rpm"]) EXPECT_NEAR(value, frequency, 1e-6);
  }
  ASSERT_EQ(r["criticals_rpm"].size(), 2u);
  for (const double value : r["criticals_rpm"]) EXPECT_NEAR(value, frequency, 1e-5);
}

// order Omega = omega
TEST_F(Linear, Critical) {
  for (const double order : {1.0, 2.0, 0.5}) {
    const json r = result({"critical", "rotor.toml", "--order", std::to_string(order)});
    ASSERT_EQ(r["criticals"].size(), 2u);
    for (const json& critical : r["criticals"]) {
      EXPECT_NEAR(critical["speed_rpm"], omega / order / rpm, 1e-6);
      EXPECT_TRUE(critical["whirl"].is_string());
    }
  }
  EXPECT_EQ(result({"critical", "rotor.toml"})["criticals"][0]["excitation"], "1x");
  EXPECT_EQ(result({"critical", "rotor.toml", "--order", "2"})["criticals"][0]["excitation"], "2x");
}

// x = e Omega^2 / (omega^2 - Omega^2 + 2 i zeta omega Omega),  y = -i x
TEST_F(Linear, Unbalance) {
  const json r = result({"unbalance", "rotor.toml", "--speeds", "0:200:20rad/s"});
  ASSERT_EQ(r["speeds_rpm"].size(), 11u);
  ASSERT_EQ(r["stations"].size(), 1u);
  const json& s = r["stations"][0];
  EXPECT_EQ(s["name"], "rotor");
  EXPECT_TRUE(s["node"].is_null());
  for (std::size_t i = 0; i < 11; ++i) {
    const double Omega = 20.0 * static_cast<double>(i);
    EXPECT_NEAR(r["speeds_rpm"][i], Omega / rpm, 1e-9);
    const std::complex<double> stiffness(omega * omega - Omega * Omega, 2.0 * zeta * omega * Omega);
    const std::complex<double> x = e * Omega * Omega / stiffness;
    const double small = rounding * std::abs(x);
    EXPECT_NEAR(s["major_m"][i], std::abs(x), small);
    EXPECT_NEAR(s["minor_m"][i], std::abs(x), small);
    EXPECT_NEAR(s["x_m"][i][0], x.real(), small);
    EXPECT_NEAR(s["x_m"][i][1], x.imag(), small);
    EXPECT_NEAR(s["y_m"][i][0], x.imag(), small);
    EXPECT_NEAR(s["y_m"][i][1], -x.real(), small);
  }
}

// One peak at omega / (1 - 2 zeta^2)^(1/2) with an amplification factor of 1 / (2 zeta) = 50; API
// 617 asks for 17 (1 - 1 / 48.5) % > 16 % below the operating speed.
TEST_F(Linear, UnbalanceTellsAmplificationAndMargins) {
  const auto peaks = [&](const std::string& speed, const std::string& speeds) {
    return result({"unbalance", "rotor.toml", "--speed", speed, "--speeds", speeds})["peaks"];
  };
  const json found = peaks("125rad/s", "0:150:0.02rad/s");
  ASSERT_EQ(found.size(), 1u);
  const json& peak = found[0];
  EXPECT_NEAR(peak["speed_rpm"], omega / std::sqrt(1.0 - 2.0 * zeta * zeta) / rpm, 0.01);
  EXPECT_NEAR(peak["amplitude_m"], 0.5 * e / zeta, 1e-3 * e / zeta);
  EXPECT_NEAR(peak["amplification"], 50.0, 0.1);
  EXPECT_NEAR(peak["margin"], 0.2, 1e-3);
  EXPECT_EQ(peak["side"], "below");
  EXPECT_NEAR(peak["required_margin"], 0.16, 1e-12);
  EXPECT_EQ(peak["is_kept"], true);
  EXPECT_EQ(peaks("115rad/s", "0:150:0.02rad/s")[0]["is_kept"], false);
  EXPECT_EQ(peaks("80rad/s", "0:150:0.02rad/s")[0]["side"], "above");
  EXPECT_TRUE(peaks("125rad/s", "0:100.5:0.02rad/s")[0]["amplification"].is_null());
  EXPECT_EQ(peaks("125rad/s", "0:90:1rad/s").size(), 0u);
  const std::string text =
      whirl({"unbalance", "rotor.toml", "--speed", "115rad/s", "--speeds", "0:150:0.02rad/s"}).out;
  EXPECT_TRUE(has(text, "13.0 % below") && has(text, "16.0 %, NOT KEPT")) << text;
  // at the highest speed: e (W / omega)^2 / |1 - (W / omega)^2 + 2 i zeta W / omega| = 179.9 um
  EXPECT_TRUE(has(text, "179.9")) << text;
}

// zeta = 1 / 350: highest at omega / (1 - 2 zeta^2)^(1/2) with e / (2 zeta (1 - zeta^2)^(1/2)), an
// amplification of 175, whatever the speeds that were asked for, and without any.
TEST_F(Linear, UnbalanceFindsSharpPeaksWhateverTheSteps) {
  constexpr double sharp = 1.0 / 350.0, refined = 1e-6;  // relative, as documented
  const std::string damping = "bearing.shaft.damping=" + std::to_string(2.0 * sharp * m * omega);
  const double root = std::sqrt(1.0 - sharp * sharp), middle = 1.0 - 2.0 * sharp * sharp;
  const double factor =
      1.0 / std::sqrt(middle) /
      (1.0 / std::sqrt(middle - 2.0 * sharp * root) - 1.0 / std::sqrt(middle + 2.0 * sharp * root));
  EXPECT_NEAR(factor, 175.0, 0.01);
  std::vector<std::vector<std::string>> calls{
      {}, {"--speeds", "0:1500:20rpm"}, {"--speeds", "0:1500:1rpm"}, {"--speeds", "0:1500rpm"}};
  for (const std::vector<std::string>& speeds : calls) {
    std::vector<std::string> words{"unbalance", "rotor.toml", "--set", damping};
    words.insert(words.end(), speeds.begin(), speeds.end());
    const json r = result(words);
    ASSERT_EQ(r["peaks"].size(), 1u);
    const json& peak = r["peaks"][0];
    EXPECT_NEAR(peak["speed_rpm"], omega / std::sqrt(middle) / rpm, refined * omega / rpm);
    EXPECT_NEAR(peak["amplitude_m"], 0.5 * e / (sharp * root), refined * 0.5 * e / sharp);
    EXPECT_NEAR(peak["amplification"], factor, refined * factor);
  }
  // the rows are those that were asked for
  EXPECT_EQ(result({"unbalance", "rotor.toml", "--speeds", "0:1500:20rpm"})["speeds_rpm"].size(),
            76u);
}

// r = e w^2 / ((1 - w^2)^2 + (2 zeta w)^2)^(1/2) is the clearance c where, with s = w^2,
//   ((e / c)^2 - 1) s^2 + (2 - 4 zeta^2) s - 1 = 0
TEST_F(Linear, UnbalanceBeyondAClearanceSaysWhereAndByHowMuch) {
  write("rubbing.toml", rubbing);
  const double z = 0.5, offset = 1e-3, clearance = 5e-4, ends = 1e-6;  // ends: relative
  const json r = result({"unbalance", "rubbing.toml", "--speeds", "0:3000:100rpm"});
  ASSERT_EQ(r["clearances"].size(), 1u);
  const json& use = r["clearances"][0];
  EXPECT_EQ(use["name"], "contact ring");
  EXPECT_NEAR(use["clearance_m"], clearance, 1e-15);
  EXPECT_NEAR(use["largest_m"], offset / (2.0 * z * std::sqrt(1.0 - z * z)), 1e-9);
  const double a = offset * offset / (clearance * clearance) - 1.0, b = 2.0 - 4.0 * z * z;
  const double first = omega * std::sqrt((-b + std::sqrt(b * b + 4.0 * a)) / (2.0 * a));
  ASSERT_EQ(use["beyond_rpm"].size(), 1u);
  EXPECT_NEAR(use["beyond_rpm"][0][0], first / rpm, ends * first / rpm);
  EXPECT_NEAR(use["beyond_rpm"][0][1], 3000.0, 1e-9);
  const std::string text = whirl({"unbalance", "rubbing.toml", "--speeds", "0:3000:100rpm"}).out;
  EXPECT_TRUE(has(text, "note: the response goes beyond the clearance of contact ring")) << text;
  EXPECT_TRUE(has(text, "note: left out: contact ring")) << text;
  // within it there is nothing to say
  const json small = result({"unbalance", "rubbing.toml", "--set", "unbalance.1.offset=0.1mm"});
  EXPECT_EQ(small["clearances"][0]["beyond_rpm"].size(), 0u);
}

// zeta = 0.6: above 0.5 a mode of the bearings
TEST_F(Linear, HeavilyDampedModesAreMarked) {
  const std::string heavy = "bearing.shaft.damping=240", light = "bearing.shaft.damping=160";
  for (const auto& [verb, list] : {std::pair{"modes", "modes"}, {"critical", "criticals"}}) {
    SCOPED_TRACE(verb);
    const json marked = result({verb, "rotor.toml", "--set", heavy})[list];
    ASSERT_EQ(marked.size(), 2u);
    EXPECT_EQ(marked[0]["heavily_damped"], true);
    EXPECT_NEAR(marked[0]["damping_ratio"], 0.6, 1e-6);
    EXPECT_EQ(result({verb, "rotor.toml", "--set", light})[list][0]["heavily_damped"], false);
  }
  for (const std::string verb : {"modes", "critical", "campbell"}) {
    SCOPED_TRACE(verb);
    EXPECT_TRUE(has(whirl({verb, "rotor.toml", "--set", heavy}).out, "*: heavily damped"));
    EXPECT_FALSE(has(whirl({verb, "rotor.toml", "--set", light}).out, "*: heavily damped"));
  }
}

TEST_F(Linear, CampbellSaysWhichSpeedsItShowsAndTheDecrements) {
  const std::string text = whirl({"campbell", "rotor.toml", "--speeds", "0:1000rpm"}).out;
  EXPECT_TRUE(has(text, "every 5th of 101 speeds and the last")) << text;
  EXPECT_TRUE(has(text, "Logarithmic decrements")) << text;
  EXPECT_TRUE(has(text, "0.0628")) << text;  // 2 pi zeta / (1 - zeta^2)^(1/2)
  EXPECT_TRUE(has(text, "1000.0")) << text;
  EXPECT_TRUE(
      has(whirl({"campbell", "rotor.toml", "--speeds", "0:1000:100rpm"}).out, "(all speeds)"));
}

TEST_F(Linear, UnbalanceAtChosenStations) {
  const std::string model = WHIRL_SOURCE_DIR "/models/two_disk_mac.toml";
  const auto names = [&](const std::string& list) {
    const json r = result({"unbalance", model, "--speeds", "0:100:100rad/s", "--stations", list});
    std::vector<std::string> all;
    for (const json& s : r["stations"]) all.push_back(s["name"]);
    return all;
  };
  EXPECT_EQ(names("ring,2"), (std::vector<std::string>{"ring", ""}));
  EXPECT_EQ(names("all").size(), 13u);
}

}  // namespace linear_verbs_test
}  // namespace whirl::test
