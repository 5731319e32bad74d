// Records of measurements: written by simulate, read back by identify.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tests/cli/program.hpp"

namespace whirl::test {
namespace measured_test {

class Measured : public Program {
 protected:
  /// Two probes at right angles at each of some nodes.
  static std::string probes_at(int first, int last) {
    std::string text;
    for (int node = first; node <= last; ++node) {
      for (const auto& [letter, angle] : {std::pair{'x', 0}, {'y', 90}}) {
        text += "[[probe]]\nname = \"" + std::to_string(node) + letter +
                "\"\nnode = " + std::to_string(node) + "\nangle = \"" + std::to_string(angle) +
                " deg\"\n";
      }
    }
    return text;
  }
  const std::string model = WHIRL_SOURCE_DIR "/models/two_disk_mac.toml";
  const std::vector<std::string> motion{"--revolutions", "60", "--discard", "20"};

  std::vector<std::string> words(std::vector<std::string> first) const {
    first.insert(first.end(), motion.begin(), motion.end());
    return first;
  }
  json found(const std::vector<std::string>& more) const {
    std::vector<std::string> all{"identify", model, "--json", "-"};
    all.insert(all.end(), more.begin(), more.end());
    return whirl(all).tree();
  }
  static bool has_note(const json& tree, const std::string& part) {
    for (const json& note : tree.at("notes")) {
      if (has(note.get<std::string>(), part)) return true;
    }
    return false;
  }
};

// The MAC of a motion is over x and y of every node: probes there read all that it takes.
TEST_F(Measured, GivesTheSameMacTableAsTheMotionItself) {
  write("probes.toml", probes_at(1, 13));
  const json motion_itself = found(words({}));
  ASSERT_GT(motion_itself.at("peaks").size(), 2u);
  for (const char* file : {"run.csv", "run.uff", "run.ufb"}) {
    SCOPED_TRACE(file);
    ASSERT_EQ(whirl(words({"simulate", model, "--measure", "probes.toml", "--measured-out", file}))
                  .status,
              0);
    const json measured =
        found({"--measured", file, "--probes", "probes.toml", "--speed", "4430rpm"});
    ASSERT_EQ(measured.at("peaks").size(), motion_itself.at("peaks").size());
    for (std::size_t i = 0; i < measured.at("peaks").size(); ++i) {
      const json &a = measured.at("peaks")[i], &b = motion_itself.at("peaks")[i];
      for (const char* key : {"frequency_rpm", "amplitude_m", "shift"}) {
        EXPECT_NEAR(a.at(key).get<double>(), b.at(key).get<double>(),
                    1e-9 * std::abs(b.at(key).get<double>()))
            << key;
      }
      EXPECT_EQ(a.at("mode"), b.at("mode"));
      for (std::size_t m = 0; m < b.at("mac").size(); ++m) {
        EXPECT_NEAR(a.at("mac")[m].get<double>(), b.at("mac")[m].get<double>(), 1e-9);
      }
    }
  }
}

// One probe at a station: a line has no sense of whirl, and its amplitude is that of what the probe
// reads, not the radius of one of the two circles that make it up.
TEST_F(Measured, TellsNoSenseOfMotionsAlongALine) {
  std::string text = "time [s],x [um]\n";
  const double rate = 4430.0 / 60.0 * 32.0;
  for (int j = 0; j < 32 * 64; ++j) {
    const double angle = 2.0 * std::numbers::pi * j / 32.0;
    text += fmt::format("{:.17g},{:.17g}\n", j / rate,
                        20.0 * std::cos(angle + 0.3) + 5.0 * std::cos(0.5 * angle));
  }
  write("line.csv", text);
  write("x.toml", "[[probe]]\nname = \"x\"\nnode = 4\nangle = 0\n");
  const std::vector<std::string> call{"--measured", "line.csv", "--probes", "x.toml"};
  const json tree = found(call);
  EXPECT_TRUE(tree.at("one_direction").get<bool>());
  ASSERT_EQ(tree.at("peaks").size(), 2u);
  EXPECT_NEAR(tree.at("peaks")[0].at("frequency_rpm").get<double>(), 4430.0, 0.1);
  EXPECT_NEAR(tree.at("peaks")[0].at("amplitude_m").get<double>(), 20e-6, 0.01e-6);
  EXPECT_EQ(tree.at("peaks")[0].at("forced"), "1X");
  EXPECT_NEAR(tree.at("peaks")[1].at("frequency_rpm").get<double>(), 2215.0, 0.1);
  EXPECT_NEAR(tree.at("peaks")[1].at("amplitude_m").get<double>(), 5e-6, 0.01e-6);
  EXPECT_TRUE(tree.at("resonance").is_null());
  EXPECT_TRUE(tree.at("peaks")[0].at("frequency_rotating_rpm").is_null());
  std::vector<std::string> words{"identify", model};
  words.insert(words.end(), call.begin(), call.end());
  EXPECT_FALSE(has(whirl(words).out, "from the rotor"));
}

// Probes of a machine in US units: tables and figures told micrometres, whatever the unit of the
// probes.
TEST_F(Measured, TellsReadingsInTheUnitOfTheProbes) {
  std::string text = "time [s],x [mil],y [mil],key [V]\n";
  const double rate = 4430.0 / 60.0 * 32.0;
  for (int j = 0; j < 32 * 64; ++j) {
    const double angle = 2.0 * std::numbers::pi * j / 32.0;
    text += fmt::format("{:.17g},{:.17g},{:.17g},{}\n", j / rate, 2.0 * std::cos(angle),
                        2.0 * std::sin(angle), j % 32 == 0 ? 5 : 0);
  }
  write("line.csv", text);
  std::string probes = "[keyphasor]\nchannel = \"key\"\n";
  for (const auto& [name, angle] : {std::pair{"x", 0}, {"y", 90}}) {
    probes += fmt::format(
        "[[probe]]\nname = \"{}\"\nnode = 4\nangle = \"{} deg\"\nunit = \"mil\"\n", name, angle);
  }
  write("mil.toml", probes);
  const Outcome told = whirl({"identify", model, "--measured", "line.csv", "--probes", "mil.toml",
                              "--orders", "1", "--out", "m.h5"});
  ASSERT_EQ(told.status, 0) << told.err;
  EXPECT_FALSE(has(told.out, "0 um")) << told.out;
  EXPECT_TRUE(has(told.out, "2 mil ")) << told.out;  // radius, and the deflection shape
  EXPECT_TRUE(has(told.out, "4 mil ")) << told.out;  // of the order, peak to peak
  for (const char* kind : {"measured_orbit", "measured_spectrum"}) {
    ASSERT_EQ(whirl({"plot", "m.h5", kind, "--out", "picture.svg"}).status, 0) << kind;
    EXPECT_TRUE(has(content(folder / "picture.svg"), "[mil]")) << kind;
  }
}

TEST_F(Measured, TakesSpeedFromTheKeyPhasor) {
  write("probes.toml", probes_at(4, 7) + "[keyphasor]\nchannel = \"key\"\nangle = \"30 deg\"\n");
  for (const std::string record : {"run.csv", "run.mat", "run.h5", "run.uff"}) {
    ASSERT_EQ(whirl(words({"simulate", model, "--measure", "probes.toml", "--noise", "1%",
                           "--measured-out", record}))
                  .status,
              0);
    const json measured = found({"--measured", record, "--probes", "probes.toml"});
    EXPECT_NEAR(measured.at("speed_rpm").get<double>(), 4430.0, 0.01) << record;
    EXPECT_EQ(measured.at("probes").size(), 8u);
    EXPECT_FALSE(has_note(measured, "key-phasor")) << record;
  }
  const json without =
      found({"--measured", "run.csv", "--probes", "probes.toml", "--speed", "4000rpm"});
  EXPECT_NEAR(without.at("speed_rpm").get<double>(), 4430.0, 0.01);
  EXPECT_TRUE(has_note(without, "--speed says 4000 rpm, the key-phasor"));
  write("no_key.toml", probes_at(4, 7));
  EXPECT_TRUE(has_note(found({"--measured", "run.csv", "--probes", "no_key.toml"}),
                       "no key-phasor and no --speed"));
}

// A curve per probe and order; what is missing for them is said.
TEST_F(Measured, TracksOrders) {
  write("probes.toml", probes_at(7, 7) + "[keyphasor]\nchannel = \"key\"\n");
  ASSERT_EQ(
      whirl(words({"simulate", model, "--measure", "probes.toml", "--measured-out", "run.csv"}))
          .status,
      0);
  const json measured = found({"--measured", "run.csv", "--probes", "probes.toml", "--orders",
                               "1,2.5", "--slow-roll", "4430rpm"});
  const json& curves = measured.at("orders").at("order_curves");
  ASSERT_EQ(curves.size(), 4u);
  EXPECT_EQ(curves[1].at("order"), 2.5);
  EXPECT_EQ(curves[0].at("response_m").size(), measured.at("orders").at("speed_rpm").size());
  EXPECT_NEAR(measured.at("orders").at("slow_roll_rpm").get<double>(), 4430.0, 1e-3);
  const json longer = found({"--measured", "run.csv", "--probes", "probes.toml", "--orders", "1",
                             "--order-revolutions", "16"});
  const std::size_t points = measured.at("orders").at("speed_rpm").size();
  EXPECT_NEAR(static_cast<double>(longer.at("orders").at("speed_rpm").size()),
              0.5 * static_cast<double>(points), 2.0);
  for (const auto& [value, says] : {std::pair{"1", "expected 2 or more"}, {"x", "revolutions"}}) {
    const Outcome few = whirl({"identify", model, "--measured", "run.csv", "--probes",
                               "probes.toml", "--orders", "1", "--order-revolutions", value});
    EXPECT_EQ(few.status, 2);
    EXPECT_TRUE(has(few.err, says)) << few.err;
  }
  EXPECT_TRUE(has(whirl({"identify", model, "--measured", "run.csv", "--probes", "probes.toml",
                         "--order-revolutions", "16"})
                      .err,
                  "--orders"));
  ASSERT_EQ(whirl({"identify", model, "--measured", "run.csv", "--probes", "probes.toml",
                   "--orders", "1", "--out", "measured.h5"})
                .status,
            0);
  EXPECT_EQ(whirl({"export", "measured.h5", "--format", "csv", "--out", "tables"}).err, "");
  write("no_key.toml", probes_at(7, 7));
  EXPECT_TRUE(has(whirl({"identify", model, "--measured", "run.csv", "--probes", "no_key.toml",
                         "--orders", "1"})
                      .err,
                  "[keyphasor]"));
  EXPECT_TRUE(has(whirl({"identify", model, "--measured", "run.csv", "--orders", "0"}).err,
                  "orders above zero"));
}

TEST_F(Measured, SaysWhatIsWrongInAFileOfProbes) {
  write("run.csv", "time [s],a [um]\n0,1\n0.1,2\n0.2,1\n");
  const auto problem = [&](const std::string& probes) {
    write("probes.toml", probes);
    return whirl({"identify", model, "--measured", "run.csv", "--probes", "probes.toml"}).err;
  };
  EXPECT_TRUE(has(problem("[[probe]]\nname = \"a\"\nnode = 40\nangle = 0\n"), "probes.toml:3:8:"));
  EXPECT_TRUE(has(problem("[[probe]]\nname = \"a\"\nnode = 4\nangel = 0\n"), "did you mean"));
  EXPECT_TRUE(has(problem("[[probe]]\nname = \"a\"\nnode = 4\nangle = 0\ngain = \"7 V\"\n"),
                  "probes.toml:5:8:"));
  EXPECT_TRUE(has(problem("[keyphasor]\nslope = \"up\"\n"), "falling"));
  EXPECT_TRUE(has(problem("[[probe]]\nname = \"b\"\nnode = 4\nangle = 0\n"),
                  "no channel \"b\"; it has a [m]"));
}

TEST_F(Measured, RefusesOptionsOfTheOtherSource) {
  write("run.csv", "time [s],a [um]\n0,1\n0.1,2\n0.2,1\n");
  EXPECT_TRUE(has(whirl({"identify", model, "--measured", "run.csv", "--discard", "3"}).err,
                  "is for simulations"));
  EXPECT_TRUE(has(whirl({"identify", model, "--rate", "300"}).err, "is for a record"));
  EXPECT_TRUE(has(whirl({"simulate", model, "--noise", "1%"}).err, "--measured-out"));
  EXPECT_TRUE(has(whirl({"simulate", model, "--measured-out", "run.xyz"}).err, ".csv"));
}

}  // namespace measured_test
}  // namespace whirl::test
