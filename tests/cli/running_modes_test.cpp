// Running modes of a record on the command line, beside the modes of the model that made it.

#include <fmt/format.h>

#include <fstream>

#include "libfe/analyses/modes.hpp"
#include "libio/model/model_file.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/random_response.hpp"

namespace whirl::test {
namespace running_modes_test {

/// An overhung rotor at 2196.34 rpm: 35.28 Hz backward and 42.30 Hz forward with damping ratios of
/// 3 %, and the speed between them, at 36.61 Hz.
class RunningModesVerb : public Program {
 protected:
  const std::string model = WHIRL_SOURCE_DIR "/models/overhung_face_rub.toml";

  /// Two probes at the disk, in noise, with 1X twice as large as all of that.
  void write_record() const {
    const Model rotor = read_model(model);
    const Assembler assembler(rotor.structure);
    const System system = assembler.at(rotor.speed);
    const Modes modes = complex_modes(system, 2);
    std::string probes;
    CVec eigenvalues(2);
    CMat shapes(2, 2);
    for (int row = 0; row < 2; ++row) {
      probes += fmt::format("[[probe]]\nname = \"disk {}\"\nnode = 2\nangle = \"{} deg\"\n",
                            row == 0 ? 'x' : 'y', 90 * row);
      for (int m = 0; m < 2; ++m) {
        const Mode& mode = modes.oscillatory.at(static_cast<std::size_t>(m));
        eigenvalues(m) = mode.lambda;
        shapes(row, m) = (system.dofs.T.cast<Complex>() * mode.shape)(4 + row);
      }
    }
    std::mt19937_64 random(11);
    const double rate = 250.0;
    const Mat motion =
        with_noise(modal_response(eigenvalues, shapes, 1.0 / rate, 60000, random), 0.05, random);
    const double size = 2.0 * motion.norm() / std::sqrt(static_cast<double>(motion.size()));
    std::string text = "time [s],disk x [um],disk y [um]\n";
    for (Eigen::Index t = 0; t < motion.rows(); ++t) {
      const double time = static_cast<double>(t) / rate, phase = rotor.speed * time;
      text += fmt::format("{:.4f},{:.6g},{:.6g}\n", time, motion(t, 0) + size * std::cos(phase),
                          motion(t, 1) + size * std::sin(phase));
    }
    write("run.csv", text);
    write("probes.toml", probes);
  }
  Outcome identify(const std::vector<std::string>& more) const {
    std::vector<std::string> words{"identify", model,      "--measured",
                                   "run.csv",  "--probes", "probes.toml"};
    words.insert(words.end(), more.begin(), more.end());
    return whirl(words);
  }
};

TEST_F(RunningModesVerb, FindsTheModesOfTheModelBesideTheSpeed) {
  write_record();
  for (const bool are_kept : {false, true}) {
    std::vector<std::string> words{"--running-modes", "--json", "-", "--out", "run.h5", "--force"};
    if (are_kept) words.push_back("--keep-harmonics");
    const Outcome outcome = identify(words);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const json found = outcome.tree();
    const json& running = found.at("running");
    EXPECT_EQ(running.at("harmonics_removed").get<bool>(), !are_kept);
    // a line that is left in asks for long lags, which cost accuracy
    const double error = are_kept ? 0.01 : 0.005, damping_error = are_kept ? 0.4 : 0.2;
    const json& modes = running.at("running_modes");
    ASSERT_EQ(modes.size(), 2u) << running.dump();
    for (std::size_t j = 0; j < 2; ++j) {
      const json& of_model = found.at("modes").at(j);
      const double frequency = of_model.at("frequency_rpm"), damping = of_model.at("damping_ratio");
      EXPECT_NEAR(modes[j].at("frequency_rpm").get<double>(), frequency, error * frequency);
      EXPECT_NEAR(modes[j].at("damping_ratio").get<double>(), damping, damping_error * damping);
      EXPECT_EQ(modes[j].at("whirl"), j == 0 ? "backward" : "forward");
      EXPECT_EQ(modes[j].at("model_mode").get<std::size_t>(), j + 1);
      EXPECT_GT(modes[j].at("mac").at(j).get<double>(), 0.95);
      EXPECT_NEAR(modes[j].at("shift").get<double>(), 0.0, error);
    }
  }
  EXPECT_EQ(whirl({"plot", "run.h5", "stabilization", "--out", "s.svg"}).status, 0);
  const std::string text = identify({"--running-modes"}).out;
  EXPECT_TRUE(has(text, "The modes of the model that probes see them most like")) << text;

  // of the backward mode alone the forward one is not a likeness, whatever is the nearest
  const Outcome few = identify({"--running-modes", "--modes", "1", "--json", "-"});
  const json modes = few.tree().at("running").at("running_modes");
  ASSERT_EQ(modes.size(), 2u);
  EXPECT_EQ(modes[0].at("model_mode"), 1);
  EXPECT_EQ(modes[1].at("model_mode"), 0);
  EXPECT_TRUE(modes[1].at("shift").is_null());
  EXPECT_TRUE(has(identify({"--running-modes", "--modes", "1"}).out, "--modes N compares more"));
}

TEST_F(RunningModesVerb, SaysWhatItsOptionsNeed) {
  write_record();
  EXPECT_TRUE(has(whirl({"identify", model, "--running-modes"}).err, "is for a record"));
  EXPECT_TRUE(has(identify({"--order", "40"}).err, "is for --running-modes"));
  EXPECT_TRUE(has(identify({"--running-modes", "--order", "400", "--block-rows", "50"}).err,
                  "50 block rows allow 98 at most"));
  EXPECT_TRUE(has(identify({"--running-modes", "--highest", "300 Hz"}).err,
                  "show those below 125 Hz only"));
}

}  // namespace running_modes_test
}  // namespace whirl::test
