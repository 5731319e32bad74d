// Probes from a model file to JSON, tables, result files and pictures.

#include <algorithm>
#include <cmath>

#include "libdyn/motions/run_result.hpp"
#include "libdyn/motions/unbalance_study.hpp"
#include "libio/figures/figures.hpp"
#include "libio/results/columns.hpp"
#include "tests/cli/program.hpp"

namespace whirl::test {
namespace probes_test {

constexpr double e = 1e-4, omega = 100.0, zeta = 0.01;  // of `jeffcott`

class Probes : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("rotor.toml", jeffcott + std::string(R"([[probe]]
name = "1X"
body = "rotor"
angle = "45 deg"
unit = "mil"
[[probe]]
name = "1Y"
body = "rotor"
angle = "135 deg"
unit = "um"
)"));
  }

  std::vector<std::string> variants(const char* kind, const std::string& file) const {
    const ResultView view(folder / file);
    std::vector<std::string> names;
    for (const FigureKind& k : figure_kinds()) {
      if (k.name != kind) continue;
      for (const Figure& f : figures_of(k, view)) names.push_back(f.variant);
    }
    return names;
  }
};

// At omega the orbit is a circle of e / (2 zeta) that lags by 90 degrees: along a direction it is
// as large, later by the angle of that.
TEST_F(Probes, TellUnbalanceResponses) {
  const std::vector<std::string> call{"unbalance",     "rotor.toml", "--speeds",
                                      "0:200:20rad/s", "--out",      "r.h5"};
  const json r = result(call);
  ASSERT_EQ(r["probes"].size(), 2u);
  const json& one = r["probes"][0];
  EXPECT_EQ(one["name"], "1X");
  EXPECT_EQ(one["unit"], "mil");
  EXPECT_NEAR(one["angle_deg"], 45.0, 1e-12);
  ASSERT_EQ(one["peak_to_peak_m"].size(), 11u);
  const double size = e / zeta;
  EXPECT_NEAR(one["peak_to_peak_m"][5], size, 1e-9 * size);
  EXPECT_NEAR(one["phase_deg"][5], -90.0 - 45.0, 1e-7);
  ASSERT_EQ(one["peaks"].size(), 1u);
  // of a circle: that of the orbit itself, by samples
  constexpr double by_samples = 1e-3;
  const double factor = r["peaks"][0]["amplification"];
  EXPECT_NEAR(one["peaks"][0]["amplification"], factor, by_samples * factor);
  const std::string text = whirl(call).out;
  EXPECT_TRUE(has(text, "393.7 mil") && has(text, "1e+04 um")) << text;  // 10 mm

  const ResultReader file(folder / "r.h5");
  const auto study = read_result<UnbalanceStudy>(file);
  ASSERT_EQ(study.probes.size(), 2u);
  EXPECT_EQ(study.probes[0].name, "1X");
  EXPECT_NEAR(std::abs(study.probes[0].amplitude(5)), 0.5 * size, 1e-9 * size);
  EXPECT_EQ(variants("bode", "r.h5"),
            (std::vector<std::string>{"probes in mil", "probes in um", "x"}));
  EXPECT_EQ(variants("polar", "r.h5"), (std::vector<std::string>{"1X, 45°", "1Y, 135°", "rotor"}));
}

TEST_F(Probes, TellMotions) {
  const std::vector<std::string> call{"simulate",  "rotor.toml", "--speed",       "60rad/s",
                                      "--discard", "1000",       "--revolutions", "32",
                                      "--out",     "run.h5"};
  const json r = result(call);
  ASSERT_EQ(r["probes"].size(), 2u);
  EXPECT_NEAR(r["probes"][0]["mean_m"], -9.81 / (omega * omega) * std::sqrt(0.5), 1e-9);
  const double ratio = 0.6,
               radius = e * ratio * ratio / std::hypot(1.0 - ratio * ratio, 2.0 * zeta * ratio);
  constexpr double of_samples = 2e-3;  // 64 a revolution
  EXPECT_NEAR(r["probes"][1]["peak_to_peak_m"], 2.0 * radius, of_samples * radius);
  const auto record = read_result<MotionRecord>(ResultReader(folder / "run.h5"));
  ASSERT_EQ(record.probes.size(), 2u);
  EXPECT_EQ(record.probes[1].displacement.size(), 32 * 64);
  EXPECT_EQ(variants("time_history", "run.h5"), (std::vector<std::string>{"probes", "rotor"}));
  EXPECT_EQ(variants("spectrum", "run.h5"),
            (std::vector<std::string>{"probes in mil", "probes in um", "rotor"}));

  // the line of the speed is the reading, peak to peak in the unit of the probe
  const ResultView view(folder / "run.h5");
  for (const FigureKind& kind : figure_kinds()) {
    if (kind.name != "spectrum") continue;
    const Figure f = figures_of(kind, view).at(1);
    const Curve& c = f.panels.at(0).curves.at(0);
    constexpr double of_rest = 1e-2;  // what is left of the transient
    EXPECT_NEAR(*std::max_element(c.y.begin(), c.y.end()), 2e6 * radius, of_rest * 2e6 * radius);
  }
}

// 70 revolutions are no number of samples for the transform: it takes 64 of them, where the speed is
// a line of the spectrum and so the reading at its full size, 2 e r^2 / |1 - r^2 + 2 i zeta r|.
TEST_F(Probes, SpectraAreOfWholeRevolutions) {
  constexpr double ratio = 0.6, of_rest = 1e-2;  // what is left of the transient
  const double size = 2e6 * e * ratio * ratio / std::hypot(1.0 - ratio * ratio, 2.0 * zeta * ratio);
  result({"simulate", "rotor.toml", "--speed", "60rad/s", "--discard", "1000", "--revolutions",
          "70", "--out", "run.h5"});
  const ResultView view(folder / "run.h5");
  for (const FigureKind& kind : figure_kinds()) {
    if (kind.name != "spectrum") continue;
    const Curve& c = figures_of(kind, view).at(1).panels.at(0).curves.at(0);
    const auto top = std::max_element(c.y.begin(), c.y.end());
    EXPECT_NEAR(*top, size, of_rest * size);
    EXPECT_NEAR(c.x[static_cast<std::size_t>(top - c.y.begin())], ratio * omega / hertz, 1e-9);
  }
}

TEST_F(Probes, AreNotInAnswersOfModelsWithoutThem) {
  write("plain.toml", jeffcott);
  const json r = result({"unbalance", "plain.toml", "--speeds", "0:200:20rad/s", "--out", "r.h5"});
  EXPECT_FALSE(r.contains("probes"));
  EXPECT_FALSE(ResultReader(folder / "r.h5").has("/unbalance/probe_name"));
  EXPECT_FALSE(result({"simulate", "plain.toml", "--speed", "60rad/s", "--discard", "0",
                       "--revolutions", "4"})
                   .contains("probes"));
}

TEST_F(Probes, AreEndsOfFrequencyResponses) {
  const json r = result(
      {"frf", "rotor.toml", "--from", "rotor:x", "--to", "1X,1Y", "--frequencies", "0:50:50rad/s"});
  ASSERT_EQ(r["pairs"].size(), 2u);
  EXPECT_EQ(r["pairs"][1]["to"], "1Y");
  const double k = 2e4;
  EXPECT_NEAR(r["pairs"][1]["receptance"][0][0], -std::sqrt(0.5) / k, 1e-12 / k);
}

}  // namespace probes_test
}  // namespace whirl::test
