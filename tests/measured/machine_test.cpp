// A run-up of the bundled Jeffcott rotor by its closed form, through the program: peaks, orbits,
// centerline, cascade, the model beside it, trends, zones.

#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "tests/cli/program.hpp"

namespace whirl::test {
namespace machine_test {

class Machine : public Program {
 protected:
  const std::string model = WHIRL_SOURCE_DIR "/models/jeffcott.toml";

  /// 300 to 3000 rpm in 30 s through the critical speed: 110 um of eccentricity, 100 um in the
  /// model, runout, a gap.
  void SetUp() override {
    Program::SetUp();
    constexpr double rate = 1000.0, slow = 5.0, rise = 1.5;
    constexpr double critical = 21.6, zeta = 0.037;  // [1/s] of the model
    std::string text = "time [s],x [mil],y [mil],key [V]\n";
    for (int j = 0; j < 30 * static_cast<int>(rate); ++j) {
      const double t = j / rate, turns = slow * t + 0.5 * rise * t * t;
      const double r = (slow + rise * t) / critical;
      const std::complex<double> i(0.0, 1.0);
      const auto z = (110.0 * r * r / (1.0 - r * r + 2.0 * i * zeta * r) + 5.0 * i) *
                         std::polar(1.0, 2.0 * pi * turns) +
                     std::complex<double>(800.0, 600.0 + 2.0 * t);
      const double behind = turns + 0.5 - std::floor(turns + 0.5) - 0.5;
      const double key =
          std::clamp(0.5 + behind * 20.0, 0.0, 1.0) - std::clamp((behind - 0.1) * 20.0, 0.0, 1.0);
      text += fmt::format("{},{:.6f},{:.6f},{:.6f}\n", t, z.real() / 25.4, z.imag() / 25.4, key);
    }
    write("run_up.csv", text);
    std::string probes = "[keyphasor]\nchannel = \"key\"\n";
    for (const auto& [name, angle] : {std::pair{"x", 0}, {"y", 90}}) {
      probes += fmt::format(
          "[[probe]]\nname = \"{}\"\nat = \"250 mm\"\nangle = \"{} deg\"\nunit = \"mil\"\n", name,
          angle);
    }
    write("rig.toml", probes);
  }
  Outcome identify(const std::vector<std::string>& more) const {
    std::vector<std::string> words{"identify", model,      "--measured", "run_up.csv",
                                   "--probes", "rig.toml", "--force"};
    words.insert(words.end(), more.begin(), more.end());
    return whirl(words);
  }
};

// The closed form: peak at critical / sqrt(1 - 2 zeta^2), AF 13.4 of a record that is steady; the
// run-up of 1.5 Hz/s lowers it somewhat and shifts the peak upwards.
TEST_F(Machine, TellsPeaksAmplificationAndTheModelBesideThem) {
  const Outcome told = identify({"--orders", "1", "--slow-roll", "330rpm", "--model-curve", "fit",
                                 "--out", "m.h5", "--json", "-"});
  ASSERT_EQ(told.status, 0) << told.err;
  const json orders = told.tree().at("orders");
  ASSERT_EQ(orders.at("order_peaks").size(), 2u);
  const json& peak = orders.at("order_peaks")[0];
  EXPECT_NEAR(peak.at("speed_rpm").get<double>(), 1296.0, 15.0);
  EXPECT_NEAR(peak.at("amplification").get<double>(), 13.4, 1.0);
  EXPECT_NEAR(peak.at("peak_to_peak_m").get<double>(), 2.0 * 1.1 * 1352e-6, 100e-6);
  EXPECT_GT(orders.at("speed_rpm").size(), 500u);
  // the model's 200 g.mm turn with the disk and 17/35 of the shaft of 0.306 kg, which leaves less
  // than 100 um of eccentricity
  constexpr double mass = 2.0 + 17.0 / 35.0 * 0.306;
  EXPECT_NEAR(orders.at("model_factor").get<double>(), 110e-6 * mass / 200e-6, 0.03);
  EXPECT_NEAR(orders.at("model_turn_rad").get<double>(), 0.0, 0.1);
  ASSERT_EQ(orders.at("order_shapes").size(), 1u);
  EXPECT_GT(orders.at("order_shapes")[0].at("mac").get<double>(), 0.99);
  EXPECT_EQ(orders.at("order_shapes")[0].at("whirl"), "forward");
  for (const char* kind : {"order_bode", "order_polar", "measured_cascade", "orbits"}) {
    ASSERT_EQ(whirl({"plot", "m.h5", kind, "--out", "p.svg", "--force"}).status, 0) << kind;
    EXPECT_TRUE(has(content(folder / "p.svg"),
                    kind == std::string("measured_cascade") ? "speed [rpm]" : "[mil]"))
        << kind;
  }
  EXPECT_EQ(whirl({"plot", "m.h5", "order_bode", "--which", "y", "--out", "y.svg"}).status, 0);
  EXPECT_FALSE(has(content(folder / "y.svg"), "x, 0"));
  EXPECT_TRUE(has(identify({"--model-curve", "fit"}).err, "--orders"));
  EXPECT_TRUE(has(identify({"--orders", "2", "--model-curve", "fit"}).err, "order 1"));
}

TEST_F(Machine, DrawsOrbitsAtMomentsAndTheCenterline) {
  ASSERT_EQ(identify({"--out", "m.h5"}).status, 0);
  const auto plot = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"plot", "m.h5"});
    more.insert(more.end(), {"--out", "p.svg", "--force"});
    return whirl(more);
  };
  ASSERT_EQ(plot({"orbits", "--at", "900rpm,1300rpm", "--order", "1"}).status, 0);
  std::string picture = content(folder / "p.svg");
  EXPECT_TRUE(has(picture, "900 rpm, 1X"));
  EXPECT_TRUE(has(picture, "1300 rpm, 1X"));
  EXPECT_FALSE(has(picture, "NaN"));
  ASSERT_EQ(plot({"orbits", "--at", "20s", "--average", "--slow-roll", "330rpm"}).status, 0);
  ASSERT_EQ(plot({"orbits", "--at", "20s", "--band", "5:100Hz"}).status, 0);
  ASSERT_EQ(plot({"centerline", "--clearance", "4mil"}).status, 0);
  picture = content(folder / "p.svg");
  EXPECT_TRUE(has(picture, "clearance"));
  EXPECT_TRUE(has(picture, "[mil]"));
  EXPECT_TRUE(has(plot({"orbits", "--at", "1500"}).err, "with their units"));
  EXPECT_TRUE(has(plot({"orbits", "--at", "9000rpm"}).err, "never turns at 9000 rpm"));
  EXPECT_TRUE(has(plot({"orbits", "--at", "99s"}).err, "not within the motion"));
  EXPECT_TRUE(has(plot({"measured_spectrum", "--at", "2s"}).err, "is for figures orbits"));
  EXPECT_TRUE(has(plot({"orbits", "--clearance", "4mil"}).err, "is for figures centerline"));
  EXPECT_TRUE(has(plot({"orbits", "--band", "100:5Hz"}).err, "--band"));
}

TEST_F(Machine, FollowsTrendsAndJudgesZones) {
  const Outcome told = identify(
      {"--trend", "--alarm", "20mil", "--trip", "60mil", "--zones", "shaft", "--out", "t.h5"});
  ASSERT_EQ(told.status, 0) << told.err;
  EXPECT_TRUE(has(told.out, "alarm: x reads"));
  EXPECT_TRUE(has(told.out + told.err, "contract"));
  const json tree = identify({"--zones", "shaft", "--json", "-"}).tree();
  // at 3000 rpm 110 um / (1 - 1 / r^2), 0.27 mm peak to peak: beyond 0.241 mm, D
  EXPECT_EQ(tree.at("zones").at("zone"), "D");
  EXPECT_NEAR(tree.at("zones").at("zone_probes")[0].at("ab").get<double>(),
              4800e-6 / std::sqrt(2950.0), 2e-6);
  for (const char* which : {"over time", "over speed"}) {
    ASSERT_EQ(
        whirl({"plot", "t.h5", "trend", "--which", which, "--out", "t.svg", "--force"}).status, 0);
    EXPECT_TRUE(has(content(folder / "t.svg"), "C/D"));
  }
  write("two.toml", "[[record]]\nfile = \"run_up.csv\"\n[[record]]\nfile = \"run_up.csv\"\n");
  const Outcome both = whirl({"identify", model, "--measured", "two.toml", "--probes", "rig.toml",
                              "--trend", "--out", "two.h5", "--json", "-"});
  ASSERT_EQ(both.status, 0) << both.err;
  EXPECT_EQ(both.tree().at("trend").at("record").size(), 2u);
  EXPECT_EQ(whirl({"plot", "two.h5", "trend", "--out", "two.svg"}).status, 0);
  EXPECT_TRUE(has(whirl({"identify", model, "--measured", "two.toml", "--probes", "rig.toml"}).err,
                  "--trend"));
  EXPECT_TRUE(has(identify({"--alarm", "20mil"}).err, "--trend"));
  EXPECT_TRUE(has(identify({"--trend", "--alarm", "20mil", "--trip", "10mil"}).err, "--alarm"));
  EXPECT_TRUE(has(identify({"--zones", "pump"}).err, "housing-1-rigid"));
}

// A simulation answers the same questions: 1X of a rotor on springs at twice its critical speed is
// e r^2 / (r^2 - 1) = 4 / 3 e but for its damping of one per cent.
TEST_F(Machine, AnswersTheSameOfSimulations) {
  write("jeffcott.toml", jeffcott);
  const Outcome told =
      whirl({"identify", "jeffcott.toml", "--speed", "200rad/s", "--revolutions", "64", "--orders",
             "1", "--zones", "shaft", "--out", "s.h5", "--json", "-"});
  ASSERT_EQ(told.status, 0) << told.err;
  const json curves = told.tree().at("orders").at("order_curves");
  ASSERT_EQ(curves.size(), 2u);  // along x and y of the rotor
  EXPECT_NEAR(curves[0].at("peak_to_peak_m")[0].get<double>(), 2.0 * 4.0 / 3.0 * 1e-4, 1e-6);
  EXPECT_EQ(told.tree().at("zones").at("zone"), "C");
  for (const char* kind : {"orbits", "centerline", "order_bode", "trend"}) {
    EXPECT_EQ(whirl({"plot", "s.h5", kind, "--out", "s.svg", "--force"}).status, 0) << kind;
  }
  EXPECT_TRUE(has(whirl({"plot", "s.h5", "orbits", "--at", "900rpm"}).err, "never turns"));
  EXPECT_EQ(
      whirl({"plot", "s.h5", "orbits", "--at", "1910rpm", "--out", "s.svg", "--force"}).status, 0);
}

}  // namespace machine_test
}  // namespace whirl::test
