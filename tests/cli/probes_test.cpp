// Probes from a model file to JSON, tables, result files and pictures.

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <tuple>

#include "libdyn/linear/unbalance_study.hpp"
#include "libdyn/motions/run_result.hpp"
#include "libio/figures/figures.hpp"
#include "libio/model/file_text.hpp"
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

  static std::vector<Figure> figures(const char* kind, const ResultView& view) {
    for (const FigureKind& k : figure_kinds()) {
      if (k.name == kind) return figures_of(k, view);
    }
    return {};
  }
  std::vector<std::string> variants(const char* kind, const std::string& file) const {
    const ResultView view(folder / file);
    std::vector<std::string> names;
    for (const Figure& f : figures(kind, view)) names.push_back(f.variant);
    return names;
  }

  /// A motion of the rotor at 60 rad/s, whose transient is over.
  void simulate(const char* revolutions) const {
    result({"simulate", "rotor.toml", "--speed", "60rad/s", "--discard", "1000", "--revolutions",
            revolutions, "--out", "run.h5"});
  }
  /// r = Omega / omega; x + i y = e r^2 / (1 - r^2 + 2 i zeta r) e^(i Omega t).
  static std::complex<double> circle(double Omega) {
    const double r = Omega / omega;
    return e * r * r / std::complex<double>(1.0 - r * r, 2.0 * zeta * r);
  }
  /// What a probe reads at phase 0, beside the sag.
  static double reading(double angle, double Omega) {
    return (circle(Omega) * std::polar(1.0, -angle)).real() -
           9.81 / (omega * omega) * std::sin(angle);
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

// The orbit is a circle: the high spot at phase 0 is where the shaft is, whatever probe reads it,
// and a probe further along the rotation by an angle reads it later by that.
TEST_F(Probes, AreDrawnAsInstrumentsShowThem) {
  result({"unbalance", "rotor.toml", "--speeds", "20:200:20rad/s", "--out", "r.h5"});
  const ResultView view(folder / "r.h5");
  const std::vector<Figure> polar = figures("polar", view), bode = figures("bode", view);
  constexpr double mil = 25.4e-6, um = 1e-6, rounding = 1e-9 * e / zeta;
  for (const auto& [number, unit, degrees] : {std::tuple{0u, mil, 45.0}, {1u, um, 135.0}}) {
    SCOPED_TRACE(degrees);
    const std::vector<Curve>& curves = polar.at(number).panels.at(0).curves;
    const auto loop = std::find_if(curves.begin(), curves.end(),
                                   [](const Curve& c) { return c.along_title == "speed"; });
    ASSERT_NE(loop, curves.end());
    for (std::size_t k = 0; k < loop->x.size(); ++k) {
      const auto expected = 2.0 * circle(loop->along[k] * pi / 30.0);
      EXPECT_NEAR(loop->x[k] * unit, expected.real(), rounding);
      EXPECT_NEAR(loop->y[k] * unit, expected.imag(), rounding);
    }
    const auto probe = std::find_if(curves.begin(), curves.end(),
                                    [](const Curve& c) { return c.name == "probe"; });
    ASSERT_NE(probe, curves.end());
    EXPECT_NEAR(std::atan2(probe->y[0], probe->x[0]) * 180.0 / pi, degrees, 1e-9);

    const Panel& phase = bode.at(number).panels.at(1);
    EXPECT_EQ(phase.y.title, "phase lag [deg]");
    const Curve& lag = phase.curves.at(0);
    for (std::size_t k = 0; k < lag.x.size(); ++k) {
      if (!std::isfinite(lag.y[k]) || std::abs(lag.y[k]) == 180.0) continue;  // at the edges
      const double late = degrees - std::arg(circle(lag.x[k] * pi / 30.0)) * 180.0 / pi;
      EXPECT_NEAR(std::remainder(lag.y[k] - late, 360.0), 0.0, 1e-6);
      EXPECT_LE(std::abs(lag.y[k]), 180.0);
    }
  }
  // beyond omega the lag of the second probe passes 180 degrees: the line leaves and comes back
  const std::vector<double>& y = bode.at(1).panels.at(1).curves.at(0).y;
  const auto gap = std::find_if(y.begin(), y.end(), [](double v) { return std::isnan(v); });
  ASSERT_NE(gap, y.end());
  EXPECT_EQ(*(gap - 1), 180.0);
  EXPECT_EQ(*(gap + 1), -180.0);
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

// 70 revolutions are no number of samples for the transform: it takes 64 of them, where the speed
// is a line of the spectrum and so the reading at its full size, 2 e r^2 / |1 - r^2 + 2 i zeta r|.
TEST_F(Probes, SpectraAreOfWholeRevolutions) {
  constexpr double ratio = 0.6, of_rest = 1e-2;  // what is left of the transient
  const double size = 2e6 * e * ratio * ratio / std::hypot(1.0 - ratio * ratio, 2.0 * zeta * ratio);
  result({"simulate", "rotor.toml", "--speed", "60rad/s", "--discard", "1000", "--revolutions",
          "70", "--out", "run.h5"});
  const ResultView view(folder / "run.h5");
  for (const FigureKind& kind : figure_kinds()) {
    if (kind.name != "spectrum") continue;
    const Figure f = figures_of(kind, view).at(1);
    const Curve& c = f.panels.at(0).curves.at(0);
    const auto top = std::max_element(c.y.begin(), c.y.end());
    EXPECT_NEAR(*top, size, of_rest * size);
    EXPECT_NEAR(c.x[static_cast<std::size_t>(top - c.y.begin())], ratio * omega / hertz, 1e-9);
  }
}

// A circle, by both methods: peak to peak twice its radius.
TEST_F(Probes, TellOrbits) {
  constexpr double of_instants = 5e-3;  // ten a step, which is a fraction of a revolution
  const double size = 2.0 * std::abs(circle(60.0));
  for (const char* method : {"shooting", "harmonic-balance"}) {
    const std::vector<std::string> call{"orbit",    "rotor.toml", "--speed",   "60rad/s",
                                        "--method", method,       "--discard", "10"};
    const json r = result(call);
    ASSERT_EQ(r["probes"].size(), 2u) << method;
    EXPECT_EQ(r["probes"][0]["unit"], "mil");
    EXPECT_EQ(r["probes"][1]["name"], "1Y");
    for (const json& probe : r["probes"]) {
      EXPECT_NEAR(probe["peak_to_peak_m"], size, of_instants * size);
    }
    EXPECT_TRUE(has(whirl(call).out, "peak to peak")) << method;
  }
  write("plain.toml", jeffcott);
  EXPECT_FALSE(result({"orbit", "plain.toml", "--speed", "60rad/s"}).contains("probes"));
}

TEST_F(Probes, TellEveryOrbitOfASearch) {
  constexpr double of_instants = 5e-3;  // as above
  const double size = 2.0 * std::abs(circle(60.0));
  const std::vector<std::string> call{"orbit", "rotor.toml", "--speed", "60rad/s", "--starts", "3"};
  const json r = result(call);
  ASSERT_EQ(r["orbits"].size(), 1u);
  const json& probes = r["orbits"][0]["probes"];
  ASSERT_EQ(probes.size(), 2u);
  EXPECT_EQ(probes[1]["name"], "1Y");
  for (const json& probe : probes) EXPECT_NEAR(probe["peak_to_peak_m"], size, of_instants * size);
  EXPECT_TRUE(has(whirl(call).out, "Along the probes, peak to peak"));
  write("plain.toml", jeffcott);
  EXPECT_FALSE(
      result({"orbit", "plain.toml", "--speed", "60rad/s", "--starts", "1"})["orbits"][0].contains(
          "probes"));
}

// Bouncing repeats as seen from the rotor and never from outside: in time every probe at a station
// reads as much, which is what a long simulation finds.
TEST_F(Probes, TellOrbitsThatRepeatSeenFromTheRotor) {
  write("two.toml", content(WHIRL_SOURCE_DIR "/models/two_disk_mac.toml") +
                        "\n[[probe]]\nname = \"a\"\nnode = 4\nangle = \"20 deg\"\n"
                        "[[probe]]\nname = \"b\"\nnode = 4\nangle = \"110 deg\"\n");
  const std::vector<std::string> call{"orbit", "two.toml", "--frame", "rotating", "--out", "o.h5"};
  const json orbit = result(call);
  const json run =
      result({"simulate", "two.toml", "--from", "o.h5", "--discard", "0", "--revolutions", "300"});
  ASSERT_EQ(orbit["probes"].size(), 2u);
  constexpr double of_crests = 1e-2;  // that samples and 300 revolutions miss
  for (const int i : {0, 1}) {
    const double size = orbit["probes"][i]["peak_to_peak_m"];
    EXPECT_NEAR(run["probes"][i]["peak_to_peak_m"], size, of_crests * size);
    EXPECT_DOUBLE_EQ(size, orbit["probes"][0]["peak_to_peak_m"]);
  }
  EXPECT_TRUE(has(whirl(call).out, "peak to peak"));
  const json branch = result({"continue", "two.toml", "--frame", "rotating", "--over",
                              "operation.speed=4420:4430:10rpm", "--at", "4430rpm"});
  const json& sizes = branch["points"][0]["probe_peak_to_peak_m"];
  EXPECT_NEAR(sizes[0], orbit["probes"][0]["peak_to_peak_m"], 1e-6 * sizes[0].get<double>());
}

// Orbits of the rotor along its speed: circles, peak to peak twice their radius.
TEST_F(Probes, TellBranches) {
  const json r = result(
      {"continue", "rotor.toml", "--over", "operation.speed=50:70:5rad/s", "--out", "branch.h5"});
  ASSERT_EQ(r["probes"].size(), 2u);
  EXPECT_EQ(r["probes"][1]["name"], "1Y");
  EXPECT_EQ(r["probes"][0]["unit"], "mil");
  ASSERT_GE(r["points"].size(), 5u);
  constexpr double of_instants = 5e-3;  // ten a step, which is a fraction of a revolution
  for (const json& p : r["points"]) {
    const double size = 2.0 * std::abs(circle(p["value"]));
    for (const int i : {0, 1}) {
      EXPECT_NEAR(p["probe_peak_to_peak_m"][i], size, of_instants * size);
    }
  }
  EXPECT_EQ(variants("branches", "branch.h5"),
            (std::vector<std::string>{"1X, 45°", "1Y, 135°", "rotor"}));
  const ResultView view(folder / "branch.h5");
  const Panel sizes = figures("branches", view).at(1).panels.at(0);
  EXPECT_EQ(sizes.y.title, "peak to peak [um]");
  const double first = r["points"][0]["probe_peak_to_peak_m"][1];
  EXPECT_NEAR(sizes.curves.at(0).y.at(1), 1e6 * first, 1e-6 * 1e6 * first);
}

// The sag -g / omega^2 along y, seen from 45 and 135 degrees.
TEST_F(Probes, TellTheSag) {
  const json r = result({"static", "rotor.toml"});
  ASSERT_EQ(r["probes"].size(), 2u);
  const double sag = 9.81 / (omega * omega);
  for (const json& probe : r["probes"]) {
    EXPECT_NEAR(probe["mean_m"].get<double>(), -sag * std::sqrt(0.5), 1e-12);
  }
  EXPECT_TRUE(has(whirl({"static", "rotor.toml"}).out, "-27.31 mil"));
  write("plain.toml", jeffcott);
  EXPECT_FALSE(result({"static", "plain.toml"}).contains("probes"));
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

constexpr double of_samples = 1.3e-3;  // the largest of 64 a revolution, of a circle
constexpr double quarter = std::numbers::pi / 4.0;

TEST_F(Probes, TellSweeps) {
  const std::vector<std::string> call{
      "sweep",     "rotor.toml", "--over",        "operation.speed=40:80:20rad/s",
      "--discard", "2000",       "--revolutions", "10",
      "--out",     "s.h5"};
  const json r = result(call);
  ASSERT_EQ(r["probes"].size(), 2u);
  EXPECT_EQ(r["probes"][1]["name"], "1Y");
  EXPECT_EQ(r["probes"][0]["unit"], "mil");
  const ResultReader file(folder / "s.h5");
  EXPECT_EQ(file.strings("/sweep/probe_name"), (std::vector<std::string>{"1X", "1Y"}));
  EXPECT_EQ(file.strings("/sweep/probe_unit"), (std::vector<std::string>{"mil", "um"}));
  EXPECT_EQ(file.shape("/sweep/probe_poincare"), (std::vector<Eigen::Index>{2, 3, 2, 64}));
  const std::vector<double> sections = file.numbers("/sweep/probe_poincare"),
                            spectrum = file.numbers("/sweep/probe_spectrum"),
                            orders = file.numbers("/sweep/probe_order");
  const std::size_t lines = orders.size(),
                    first = static_cast<std::size_t>(std::find(orders.begin(), orders.end(), 1.0) -
                                                     orders.begin());
  ASSERT_LT(first, lines);
  for (std::size_t i = 0; i < 3; ++i) {
    const double Omega = 40.0 + 20.0 * static_cast<double>(i), size = 2.0 * std::abs(circle(Omega));
    const json& up = r["up"][i];
    for (std::size_t p = 0; p < 2; ++p) {
      const double angle = p == 0 ? quarter : 3.0 * quarter;
      EXPECT_NEAR(up["probe_peak_to_peak_m"][p].get<double>(), size, of_samples * size);
      EXPECT_LE(up["probe_peak_to_peak_m"][p].get<double>(), size * (1.0 + 1e-9));
      EXPECT_NEAR(up["probe_mean_m"][p].get<double>(), -9.81 / (omega * omega) * std::sin(angle),
                  1e-12);
      EXPECT_NEAR(sections[(i * 2 + p) * 64], reading(angle, Omega), 1e-12);
      EXPECT_NEAR(spectrum[(i * 2 + p) * lines + first], size, 1e-9 * size);
    }
  }
  EXPECT_TRUE(has(whirl(call).out, "Along the probes, peak to peak"));

  EXPECT_EQ(variants("bifurcation", "s.h5"),
            (std::vector<std::string>{"1X, 45°", "1Y, 135°", "rotor", "forces on supports"}));
  for (const char* kind : {"cascade", "spectral_map"}) {
    EXPECT_EQ(variants(kind, "s.h5"),
              (std::vector<std::string>{"1X, 45° (up)", "1X, 45° (down)", "1Y, 135° (up)",
                                        "1Y, 135° (down)", "rotor (up)", "rotor (down)"}))
        << kind;
  }
  const ResultView view(folder / "s.h5");
  const Figure f = figures("bifurcation", view).at(0);
  constexpr double mil = 25.4e-6;
  EXPECT_EQ(f.panels.at(0).y.title, "reading once a revolution [mil]");
  EXPECT_NEAR(f.panels.at(0).curves.at(0).y.at(0), reading(quarter, 40.0) / mil, 1e-7);
  EXPECT_EQ(f.panels.at(1).y.title, "peak to peak [mil]");
  EXPECT_NEAR(f.panels.at(1).curves.at(0).y.at(2), 2.0 * std::abs(circle(80.0)) / mil,
              of_samples * 2.0 * std::abs(circle(80.0)) / mil);
}

// Branches over a sweep are along the probe of its figure: an orbit is where its sections are.
TEST_F(Probes, HaveBranchesOverTheirSweeps) {
  const auto call = [&](const char* verb, const char* range, const char* out) {
    result({verb, "rotor.toml", "--speed", "60rad/s", "--over", range, "--discard", "20", "--out",
            out, "--set", "bearing.1.damping=40"});
  };
  call("sweep", "unbalance.1.offset=0.1,0.2mm", "s.h5");
  call("continue", "unbalance.1.offset=0.1:0.2:0.05mm", "b.h5");
  const ResultView sweep(folder / "s.h5"), branches(folder / "b.h5");
  std::vector<Figure> over = figures("bifurcation", sweep);
  ASSERT_EQ(lay_over(over, sweep, branches, "b.h5"), "");
  const Figure& f = over.at(0);
  ASSERT_EQ(f.variant, "1X, 45°");
  const Curve& found = f.panels.at(0).curves.at(0);
  int compared = 0;
  for (const Curve& c : f.panels.at(0).curves) {
    if (c.name != "period 1, stable") continue;
    for (std::size_t i = 0; i < c.x.size(); ++i) {
      if (std::isnan(c.y[i]) || c.x[i] != found.x.front()) continue;
      EXPECT_NEAR(c.y[i], found.y.front(), 1e-6);
      ++compared;
    }
  }
  EXPECT_GT(compared, 0);
}

TEST_F(Probes, HaveWaterfallsAndSections) {
  simulate("64");
  const std::vector<std::string> names{"1X, 45°", "1Y, 135°", "rotor"};
  EXPECT_EQ(variants("waterfall", "run.h5"), names);
  EXPECT_EQ(variants("poincare", "run.h5"), names);
  const ResultView view(folder / "run.h5");
  constexpr double of_rest = 1e-2;  // what is left of the transient
  const Figure waterfall = figures("waterfall", view).at(1);
  double largest = 0.0;
  for (const Curve& c : waterfall.panels.at(0).curves) {
    EXPECT_GE(c.x.front(), 0.0);
    for (const std::string& text : c.hover) {
      EXPECT_TRUE(has(text, " um")) << text;
      largest = std::max(largest, std::stod(text));
    }
  }
  const double size = 2e6 * std::abs(circle(60.0));
  EXPECT_NEAR(largest, size, of_rest * size);
  const Figure section = figures("poincare", view).at(1);
  ASSERT_GE(section.panels.at(0).curves.at(0).y.size(), 63u);
  for (const double y : section.panels[0].curves[0].y) {
    EXPECT_NEAR(y, 1e6 * reading(3.0 * quarter, 60.0), of_rest * size);
  }
  EXPECT_EQ(section.panels[1].y.title, "reading a revolution later [um]");
}

TEST_F(Probes, ChooseFigures) {
  simulate("32");
  const auto plot = [&](const char* kind, const char* which) {
    return whirl({"plot", "run.h5", kind, "--which", which, "--out", "p.svg", "--json", "-"});
  };
  EXPECT_EQ(plot("time_history", "1Y").tree()["variant"], "probes");
  const std::string drawn = content(folder / "p.svg");
  EXPECT_TRUE(has(drawn, "1Y, 135°"));
  EXPECT_FALSE(has(drawn, "1X, 45°"));  // of all probes that one
  EXPECT_EQ(plot("spectrum", "1X").tree()["variant"], "probes");
  EXPECT_EQ(plot("orbit", "1X").tree()["variant"], "rotor");  // where it is
  EXPECT_EQ(plot("poincare", "1X").tree()["variant"], "1X, 45°");
  EXPECT_EQ(plot("time_history", "rotor").tree()["variant"], "rotor");
  const Outcome refused = plot("time_history", "2X");
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(
      has(refused.err,
          "--which 2X: there is no such figure; there are probes | rotor; of probes 1X | 1Y"))
      << refused.err;
  result({"unbalance", "rotor.toml", "--speeds", "0:200:20rad/s", "--out", "run.h5"});
  EXPECT_EQ(plot("bode", "1Y").tree()["variant"], "probes");
  EXPECT_EQ(plot("polar", "1Y").tree()["variant"], "1Y, 135°");
}

TEST_F(Probes, AreNotInStudiesOfModelsWithoutThem) {
  write("plain.toml", jeffcott);
  const json r = result({"sweep", "plain.toml", "--over", "operation.speed=40,80rad/s", "--discard",
                         "2000", "--revolutions", "10", "--out", "s.h5"});
  EXPECT_FALSE(r.contains("probes"));
  for (const auto& [key, value] : r["up"][0].items()) EXPECT_FALSE(has(key, "probe")) << key;
  for (const std::string& name : ResultReader(folder / "s.h5").list("/sweep")) {
    EXPECT_FALSE(has(name, "probe")) << name;
  }
  EXPECT_EQ(variants("bifurcation", "s.h5"),
            (std::vector<std::string>{"rotor", "forces on supports"}));
}

// The sag of 0.98 mm is no motion; seen from the rotor it would be a circle beside which the orbit
// of 0.06 mm, which stands still there, is not seen.
TEST_F(Probes, SagIsLeftOutOfWhatTurnsWithTheRotor) {
  simulate("32");
  const json r = result(
      {"simulate", "rotor.toml", "--speed", "60rad/s", "--discard", "1000", "--revolutions", "32"});
  const json& strongest = r["stations"][0]["peaks_rotating"][0];
  EXPECT_NEAR(strongest["frequency_rpm"].get<double>(), -60.0 / rpm, 1e-9);
  EXPECT_NEAR(strongest["amplitude_m"].get<double>(), 9.81 / (omega * omega), 1e-9);
  const std::string text = whirl({"simulate", "rotor.toml", "--speed", "60rad/s", "--discard",
                                  "1000", "--revolutions", "32"})
                               .out;
  EXPECT_TRUE(has(text, "mean position")) << text;
  EXPECT_TRUE(has(text, "  981 um  ")) << text;
  EXPECT_FALSE(has(text, "-573.0 (981")) << text;
  const Figure f = figures("orbit", ResultView(folder / "run.h5")).at(0);
  const Panel& panel = f.panels.at(1);
  EXPECT_EQ(panel.title, "seen from the rotor, about the mean position");
  EXPECT_TRUE(has(f.notes.back(), "without the mean position")) << f.notes.back();
  // it stands still there: a point at |x + i y|, lagging
  constexpr double of_rest = 1e-2;
  const double scale = 1.0 / 25.4e-6;
  const std::complex<double> place = scale * circle(60.0);
  for (const Curve& c : panel.curves) {
    if (c.name != "orbit") continue;
    for (std::size_t i = 0; i < c.x.size(); ++i) {
      EXPECT_NEAR(c.x[i], place.real(), of_rest * std::abs(place));
      EXPECT_NEAR(c.y[i], place.imag(), of_rest * std::abs(place));
    }
  }
}

// A forward whirl tilts faces forward: two axial probes a quarter turn apart see it as two radial
// ones do.
TEST_F(Probes, AlongTheShaftAreReadRecordedAndIdentified) {
  const std::string rotor = WHIRL_SOURCE_DIR "/models/two_disk_mac.toml";
  const std::string faces = R"([[probe]]
name = "face x"
node = 10
angle = "0 deg"
face_radius = "120 mm"
[[probe]]
name = "face y"
node = 10
angle = "90 deg"
face_radius = "120 mm"
)";
  write("faces.toml", faces);
  write("wobbling.toml", file_text(rotor) + faces);
  const json r =
      result({"simulate", "wobbling.toml", "--speed", "3000rpm", "--revolutions", "32", "--out",
              "run.h5", "--measure", "faces.toml", "--measured-out", "run.csv"});
  ASSERT_EQ(r["probes"].size(), 2u);
  EXPECT_EQ(r["probes"][0]["face_radius_m"], 0.12);
  const double size = r["probes"][0]["peak_to_peak_m"];
  EXPECT_GT(size, 1e-3);
  const auto record = read_result<MotionRecord>(ResultReader(folder / "run.h5"));
  EXPECT_EQ(record.probes.at(1).face_radius, 0.12);
  EXPECT_EQ(variants("time_history", "run.h5").front(), "probes");

  const std::vector<std::string> call{"identify", rotor,        "--speed",    "3000rpm",
                                      "--probes", "faces.toml", "--measured", "run.csv"};
  const json found = result(call);
  EXPECT_NEAR(found["peaks"][0]["frequency_rpm"], 3000.0, 1.0);  // forward: above 0
  EXPECT_NEAR(2.0 * found["peaks"][0]["amplitude_m"].get<double>(), size, 0.01 * size);
  EXPECT_TRUE(has(whirl(call).out, "face x (0 deg along z)"));

  write("flat.toml",
        std::string(jeffcott) + "[[probe]]\nbody = \"rotor\"\nangle = 0\nface_radius = 0.1\n");
  const Outcome flat = whirl({"check", "flat.toml"});
  EXPECT_EQ(flat.status, 2);
  EXPECT_TRUE(has(flat.err, "probe.1.face_radius: this body does not tilt")) << flat.err;
}

}  // namespace probes_test
}  // namespace whirl::test
