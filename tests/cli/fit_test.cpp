// Values of a model found in records: what the verb takes, says and refuses.

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <numbers>
#include <sstream>

#include "tests/cli/program.hpp"

namespace whirl::test {
namespace fit_verb_test {

/// A rig whose truth is known: the two-disk rotor with friction in its ring.
class FitVerb : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("probes.toml",
          "[[probe]]\nname = \"a\"\nnode = 4\nangle = \"45 deg\"\n"
          "[[probe]]\nname = \"b\"\nnode = 4\nangle = \"135 deg\"\n"
          "[[probe]]\nname = \"c\"\nnode = 7\nangle = \"0 deg\"\n"
          "[[probe]]\nname = \"d\"\nnode = 7\nangle = \"90 deg\"\n"
          "[keyphasor]\nchannel = \"key\"\n");
    record("run.csv", {});
  }
  void record(const std::string& file, const std::vector<std::string>& more) const {
    std::vector<std::string> all{"simulate",       model,         "--set",     truth,
                                 "--measure",      "probes.toml", "--noise",   "1%",
                                 "--measured-out", file,          "--discard", "100",
                                 "--revolutions",  "12",          "--quiet"};
    all.insert(all.end(), more.begin(), more.end());
    ASSERT_EQ(whirl(all).status, 0);
  }
  Outcome fit(const std::vector<std::string>& more) const {
    std::vector<std::string> all{"fit", model, "--probes", "probes.toml", "--revolutions", "8"};
    all.insert(all.end(), more.begin(), more.end());
    return whirl(all);
  }
  json found(std::vector<std::string> more) const {
    more.insert(more.end(), {"--json", "-"});
    return fit(more).tree();
  }
  /// That a value is within four of its standard deviations, of a few percent.
  static void expect_truth(const json& parameter, double truth) {
    const double value = parameter.at("value"), deviation = parameter.at("standard_deviation");
    EXPECT_NEAR(value, truth, 4.0 * deviation) << parameter;
    EXPECT_LT(deviation, 0.1 * truth) << parameter;
    EXPECT_GT(deviation, 0.0);
  }
  static bool has_note(const json& tree, const std::string& part) {
    for (const json& note : tree.at("notes")) {
      if (has(note.get<std::string>(), part)) return true;
    }
    return false;
  }

  const std::string model = WHIRL_SOURCE_DIR "/models/two_disk_mac.toml";
  const std::string truth = "contact.ring.friction=0.05";
};

// The start of friction is in the middle of its bounds, as the model has none; noise is what is
// left.
TEST_F(FitVerb, FindsWhatTheRecordWasMadeWith) {
  const json tree = found({"--measured", "run.csv", "--free",
                           "contact.ring.stiffness,contact.ring.friction=0:0.3", "--set",
                           "contact.ring.stiffness=5.5MN/m", "--out", "fit.h5"});
  ASSERT_TRUE(tree.at("converged").get<bool>());
  const json& parameters = tree.at("parameters");
  ASSERT_EQ(parameters.size(), 2u);
  EXPECT_EQ(parameters[0].at("path"), "contact.ring.stiffness");
  EXPECT_EQ(parameters[0].at("unit"), "N/m");
  EXPECT_EQ(parameters[0].at("start"), 5.5e6);
  EXPECT_EQ(parameters[1].at("start"), 0.15);
  expect_truth(parameters[0], 4e6);
  expect_truth(parameters[1], 0.05);
  EXPECT_EQ(tree.at("correlation").size(), 2u);
  EXPECT_NEAR(tree.at("correlation")[0][0].get<double>(), 1.0, 1e-12);
  EXPECT_NEAR(tree.at("residual").get<double>(), 1.0, 0.15);
  for (const json& probe : tree.at("fitted_probes")) {
    const double left = probe.at("residual_m"), floor = probe.at("noise_floor_m");
    EXPECT_NEAR(left, floor, 0.3 * floor);
  }
  const Outcome orbit = whirl({"plot", "fit.h5", "fit", "--out", "fit.svg"});
  EXPECT_EQ(orbit.status, 0) << orbit.err;
  EXPECT_EQ(whirl({"report", "fit.h5", "--out", "fit.html"}).status, 0);
}

TEST_F(FitVerb, PrintsLinesThatGoOnWithTheValues) {
  const Outcome ran = fit({"--measured", "run.csv", "--free", "contact.ring.friction=0:0.3"});
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_TRUE(has(ran.out, "--set contact.ring.friction=0.0"));
  EXPECT_TRUE(has(ran.out, "95 % interval"));
}

// Twice the true noise leaves too little, a tenth of it too much: that is no fit, and the status
// says so.
TEST_F(FitVerb, SaysWhenMoreIsLeftThanTheNoise) {
  const Outcome ran = fit({"--measured", "run.csv", "--free", "contact.ring.friction=0:0.3",
                           "--noise", "0.1%", "--json", "-"});
  EXPECT_EQ(ran.status, 3);
  EXPECT_TRUE(has(ran.err, "did not converge")) << ran.err;
  const json tree = json::parse(ran.out);
  EXPECT_FALSE(tree.at("converged").get<bool>());
  EXPECT_GT(tree.at("residual").get<double>(), 5.0);
  const json known =
      found({"--measured", "run.csv", "--free", "contact.ring.friction=0:0.3", "--noise", "1%"});
  EXPECT_TRUE(known.at("converged").get<bool>());
  EXPECT_TRUE(known.at("noise_known").get<bool>());
}

// The second record is at another speed and of another unbalance: both tell of one stiffness.
TEST_F(FitVerb, FitsSeveralRecordsAtOnce) {
  record("other.csv", {"--speed", "4300rpm", "--set", "disk.1.unbalance.offset=0.4mm"});
  write("records.toml",
        "[[record]]\nfile = \"run.csv\"\n"
        "[[record]]\nfile = \"other.csv\"\nset = [\"disk.1.unbalance.offset=0.4mm\"]\n");
  const std::vector<std::string> free{"--free",
                                      "contact.ring.stiffness,contact.ring.friction=0:0.3"};
  std::vector<std::string> one{"--measured", "run.csv"}, both{"--measured", "records.toml"};
  for (auto* words : {&one, &both}) words->insert(words->end(), free.begin(), free.end());
  both.insert(both.end(), {"--out", "both.h5"});
  const json alone = found(one), together = found(both);
  ASSERT_TRUE(together.at("converged").get<bool>()) << together.at("why_not");
  EXPECT_EQ(together.at("records").size(), 2u);
  EXPECT_NEAR(together.at("records")[1].at("speed_rpm").get<double>(), 4300.0, 0.1);
  expect_truth(together.at("parameters")[0], 4e6);
  expect_truth(together.at("parameters")[1], 0.05);
  EXPECT_LT(together.at("parameters")[1].at("standard_deviation").get<double>(),
            alone.at("parameters")[1].at("standard_deviation").get<double>());
  const Outcome drawn =
      whirl({"plot", "both.h5", "fit", "--which", "other.csv, readings", "--out", "r.svg"});
  EXPECT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_EQ(whirl({"plot", "both.h5", "fit", "--which", "readings", "--out", "s.svg"}).status, 0);
}

// A rotor that seems to whirl backward with its own speed: no motion of the model does, and what
// was found is not called a fit.
TEST_F(FitVerb, DoesNotCallAFitWhatExplainsLittle) {
  std::string text = "time [s],a [um],b [um],key\n";
  const int samples = 32;  // of a revolution
  for (int j = 0; j < 40 * samples; ++j) {
    const double turns = static_cast<double>(j) / samples, angle = 2.0 * std::numbers::pi * turns;
    text += fmt::format("{:.17g},{:.17g},{:.17g},{}\n", turns * 60.0 / 4430.0,
                        500.0 * std::cos(angle), -500.0 * std::sin(angle), j % samples < 2 ? 1 : 0);
  }
  write("backward.csv", text);
  write("two.toml",
        "[[probe]]\nname = \"a\"\nnode = 7\nangle = 0\n[[probe]]\nname = \"b\"\nnode = 7\n"
        "angle = \"90 deg\"\n[keyphasor]\nchannel = \"key\"\n");
  const Outcome ran =
      whirl({"fit", model, "--measured", "backward.csv", "--probes", "two.toml", "--free",
             "contact.ring.friction=0:0.3", "--revolutions", "2", "--json", "-"});
  EXPECT_EQ(ran.status, 3) << ran.err;
  const json tree = json::parse(ran.out);
  EXPECT_FALSE(tree.at("converged").get<bool>());
  EXPECT_LT(tree.at("explained").get<double>(), 0.5);
  EXPECT_TRUE(has_note(tree, "1X turns backward at a + b")) << tree.at("notes");
  EXPECT_TRUE(has_note(tree, "so little is explained: are probes swapped")) << tree.at("notes");
}

// A thirtieth of the samples is missing, a stretch of each channel: what stands there for spectra
// is no reading, and the values are those that the rest tells.
TEST_F(FitVerb, LeavesMissingSamplesOut) {
  std::istringstream whole(content(folder / "run.csv"));
  std::string text;
  int row = 0;
  for (std::string line; std::getline(whole, line); ++row) {
    const bool is_gap = row > 300 && row % 120 < 4;
    if (const auto last = line.rfind(','); is_gap) {  // key stays
      line = line.substr(0, line.find(',')) + ",,,," + line.substr(last);
    }
    text += line + "\n";
  }
  write("gaps.csv", text);
  const json tree = found({"--measured", "gaps.csv", "--free",
                           "contact.ring.stiffness,contact.ring.friction=0:0.3", "--set",
                           "contact.ring.stiffness=5.5MN/m"});
  ASSERT_TRUE(tree.at("converged").get<bool>());
  EXPECT_TRUE(has_note(tree, "missing samples are left out of the fit")) << tree.at("notes");
  EXPECT_NEAR(tree.at("residual").get<double>(), 1.0, 0.15);
  expect_truth(tree.at("parameters")[0], 4e6);
  expect_truth(tree.at("parameters")[1], 0.05);
}

// A probe reads its gap, a millimeter: no motion explains that, and the user is told where to look.
TEST_F(FitVerb, SaysThatItExplainsNothing) {
  std::istringstream whole(content(folder / "run.csv"));
  std::string text;
  for (std::string line; std::getline(whole, line);) {
    const auto first = line.find(','), second = line.find(',', first + 1);
    if (!line.empty() && std::isdigit(static_cast<unsigned char>(line.front()))) {
      const double reading = std::stod(line.substr(first + 1));
      line = line.substr(0, first + 1) + std::to_string(1000.0 + reading) + line.substr(second);
    }
    text += line + "\n";
  }
  write("gap.csv", text);
  const std::vector<std::string> words{"--measured", "gap.csv", "--free",
                                       "contact.ring.friction=0:0.3"};
  const json tree = json::parse([&] {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"--json", "-"});
    return fit(all).out;
  }());
  EXPECT_LT(tree.at("explained").get<double>(), 0.0);
  EXPECT_TRUE(has_note(tree, "so that offsets are to be found, too")) << tree.at("notes");
  std::vector<std::string> with_offsets = words;
  with_offsets.push_back("--offsets");
  const json right = found(with_offsets);
  EXPECT_FALSE(has_note(right, "offsets are to be found")) << right.at("notes");
  expect_truth(right.at("parameters")[0], 0.05);
}

// Friction alone cannot make up for a ring that is twice as stiff: the likelihood tells.
TEST_F(FitVerb, TellsModelsByTheirLikelihood) {
  const std::string text = content(model), stiffness = "\"4 MN/m\"";
  write("stiff.toml", std::string(text).replace(text.find(stiffness), stiffness.size(), "8e6"));
  const json tree = found({"--measured", "run.csv", "--free", "contact.ring.friction=0:0.3",
                           "--against", "stiff.toml"});
  const json& candidates = tree.at("candidates");
  ASSERT_EQ(candidates.size(), 2u);
  EXPECT_EQ(candidates[0].at("model"), model);
  EXPECT_GT(candidates[0].at("log_likelihood").get<double>(),
            candidates[1].at("log_likelihood").get<double>() + 10.0);
  EXPECT_NEAR(candidates[0].at("weight").get<double>(), 1.0, 1e-4);
}

TEST_F(FitVerb, SaysWhatIsWrong) {
  struct Case {
    std::vector<std::string> words;
    std::string says;
  };
  const std::string free = "contact.ring.friction=0:0.3";
  const Case cases[]{
      {{"--free", free}, "--measured"},
      {{"--measured", "run.csv"}, "--free"},
      {{"--measured", "run.csv", "--free", "contact.ring.fiction"}, "did you mean \"friction\""},
      {{"--measured", "run.csv", "--free", "contact.ring.friction"}, "needs bounds"},
      {{"--measured", "run.csv", "--free", "contact.ring.friction=0.3:0"}, "the lower one first"},
      {{"--measured", "run.csv", "--free", "contact.ring.friction=0.1"}, "expected bounds"},
      {{"--measured", "run.csv", "--free", free + "," + free}, "is there twice"},
      {{"--measured", "run.csv", "--free", "contact.ring.stiffness=1:9mm"}, "bounds are in m"},
      {{"--measured", "run.csv", "--free", "contact.ring.stiffness=5:9MN/m"}, "outside of"},
      {{"--measured", "run.csv", "--free", "contact.ring.name"}, "expected a number"},
      {{"--measured", "run.csv", "--free", "operation.speed"}, "changes the speed"},
      {{"--measured", "run.csv", "--free", free, "--noise", "-1um"}, "expected a length"},
      {{"--measured", "run.csv", "--free", free, "--revolutions", "many"}, "revolutions"},
      {{"--measured", "run.csv", "--free", free, "--from-revolution", "11"}, "expected 2"},
      {{"--measured", "none.csv", "--free", free}, "none.csv"}};
  for (const Case& c : cases) {
    const Outcome ran = fit(c.words);
    EXPECT_EQ(ran.status, 2) << ran.out << ran.err;
    EXPECT_TRUE(has(ran.err, c.says)) << ran.err;
  }
  write("set.toml", "[[record]]\nfile = \"run.csv\"\nset = [\"contact.ring.friction=0.1\"]\n");
  const Outcome both = fit({"--measured", "set.toml", "--free", free});
  EXPECT_EQ(both.status, 2) << both.out;
  EXPECT_TRUE(has(both.err, "run.csv: sets contact.ring.friction, which is to be found"))
      << both.err;
  write("set.toml", "[[record]]\nfile = \"run.csv\"\nset = [\"disk.nine.mass=1\"]\n");
  const Outcome unknown = fit({"--measured", "set.toml", "--free", free});
  EXPECT_EQ(unknown.status, 2) << unknown.out;
  EXPECT_TRUE(has(unknown.err, "set.toml:3:7: disk.nine.mass: there is no element")) << unknown.err;
  const Outcome blind = whirl({"fit", model, "--measured", "run.csv", "--free", free});
  EXPECT_EQ(blind.status, 2);
  EXPECT_TRUE(has(blind.err, "run.csv: no probes read it")) << blind.err;
  write("records.toml",
        "[[record]]\nfile = \"run.csv\"\nsets = []\n[[record]]\nspeed = \"1 mm\"\n");
  const Outcome ran = fit({"--measured", "records.toml", "--free", free});
  EXPECT_EQ(ran.status, 2);
  EXPECT_TRUE(has(ran.err, "record.1.sets")) << ran.err;
  EXPECT_TRUE(has(ran.err, "record.2.file")) << ran.err;
  EXPECT_TRUE(has(ran.err, "record.2.speed")) << ran.err;
}

}  // namespace fit_verb_test
}  // namespace whirl::test
