// Forces in every verb: those that have them, and those that refuse them.

#include <cmath>
#include <complex>
#include <map>
#include <numbers>

#include "libdyn/linear/unbalance_study.hpp"
#include "libio/figures/figures.hpp"
#include "libio/results/columns.hpp"
#include "tests/cli/program.hpp"

namespace whirl::test {
namespace force_verbs_test {

using Complex = std::complex<double>;

constexpr double pi = std::numbers::pi;
constexpr double m = 2.0, k = 2e4, c = 4.0, e = 1e-4;  // of `jeffcott`
constexpr double rounding = 1e-9;                      // relative, of solvers on two dofs

Complex receptance(double w) {
  return 1.0 / Complex(k - m * w * w, c * w);
}

class ForceVerbs : public Program {
 protected:
  /// The Jeffcott rotor with forces.
  void write_rotor(const std::string& forces) {
    write("rotor.toml", std::string(jeffcott) + forces);
  }
  std::string python_says(const std::string& code) const {
    const Outcome outcome = wait(start(python, {"-c", code}));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  }
  static void expect_complex(const json& found, Complex expected) {
    EXPECT_NEAR(found[0].get<double>(), expected.real(), rounding * std::abs(expected));
    EXPECT_NEAR(found[1].get<double>(), expected.imag(), rounding * std::abs(expected));
  }
};

const std::string constant = "[[force]]\nbody = \"rotor\"\nforce = \"10 N\"\n";
const std::string twice = "[[force]]\nbody = \"rotor\"\nforce = \"3 N\"\norder = 2\n";
const std::string shaker =
    "[[force]]\nname = \"shaker\"\nbody = \"rotor\"\nforce = \"5 N\"\nfrequency = \"12 Hz\"\n"
    "whirl = \"backward\"\n";

TEST_F(ForceVerbs, StaticHasConstantOnes) {
  write_rotor(constant + twice + shaker);
  const json r = result({"static", "rotor.toml"});
  EXPECT_NEAR(r["stations"][0]["x_m"].get<double>(), 10.0 / k, rounding * 10.0 / k);
  EXPECT_NEAR(r["bearings"][0]["fx_n"].get<double>(), 10.0, rounding * 10.0);
  const Outcome told = whirl({"static", "rotor.toml", "--set", "gravity=0"});
  EXPECT_TRUE(has(told.out, "under gravity and constant forces")) << told.out;
  EXPECT_FALSE(has(told.out, "has no gravity")) << told.out;
  EXPECT_TRUE(has(whirl({"check", "rotor.toml"}).out, "forces")) << told.out;
}

// Unbalance and forces of order 1 in one response, others in responses of their own.
TEST_F(ForceVerbs, UnbalanceHasTheOthers) {
  write_rotor(twice + shaker +
              "[[force]]\nbody = \"rotor\"\nforce = 2\norder = 1\nangle = \"90 deg\"\n");
  const json r = result({"unbalance", "rotor.toml", "--speeds", "300:900:300rpm", "--out", "u.h5"});
  ASSERT_EQ(r["forced"].size(), 2u);
  const json &two = r["forced"][0], &own = r["forced"][1];
  EXPECT_EQ(two["force"], "2x");
  EXPECT_EQ(two["forces"], "force 1");
  EXPECT_EQ(own["forces"], "shaker");
  EXPECT_EQ(two["order"], 2.0);
  EXPECT_TRUE(two["frequency_rpm"].is_null());
  EXPECT_EQ(two["name"], "rotor");
  EXPECT_EQ(own["force"], "12 Hz");
  EXPECT_NEAR(own["frequency_rpm"].get<double>(), 720.0, 1e-9);
  for (std::size_t i = 0; i < 3; ++i) {
    const double Omega = (300.0 + 300.0 * static_cast<double>(i)) * pi / 30.0, w = 24.0 * pi;
    const Complex one = receptance(Omega) * m * e * Omega * Omega;
    expect_complex(r["stations"][0]["x_m"][i], one);
    expect_complex(r["stations"][0]["y_m"][i], -Complex(0.0, 1.0) * one + 2.0 * receptance(Omega));
    expect_complex(two["x_m"][i], 3.0 * receptance(2.0 * Omega));
    expect_complex(own["x_m"][i], 5.0 * receptance(w));
    EXPECT_NEAR(own["minor_m"][i].get<double>(), -5.0 * std::abs(receptance(w)), 1e-15);
  }
  // the peak of 2x, 3 N / (c w) at about half the resonance, is among the speeds that it chooses
  const json chosen = result({"unbalance", "rotor.toml"})["forced"][0];
  double largest = 0.0;
  for (const json& major : chosen["major_m"]) largest = std::max(largest, major.get<double>());
  EXPECT_NEAR(largest * 100.0 * c / 3.0, 1.0, 1e-3);
  const Outcome told = whirl({"unbalance", "rotor.toml"});
  EXPECT_TRUE(has(told.out, "Response to forces of other frequencies")) << told.out;
  EXPECT_TRUE(has(told.out, "  shaker (12 Hz)  rotor  ")) << told.out;
  EXPECT_EQ(whirl({"plot", "u.h5", "bode"}).status, 0);
}

TEST_F(ForceVerbs, MotionsOfAShakerAreToriWhichOrbitsRefuse) {
  write_rotor(shaker + "[operation]\nspeed = \"700 rpm\"\n[damping]\nrayleigh = {mass = 20}\n");
  const json motion =
      result({"classify", "rotor.toml", "--discard", "200", "--revolutions", "300"});
  EXPECT_EQ(motion["motion"], "quasi-periodic");
  for (const std::vector<std::string>& call : std::vector<std::vector<std::string>>{
           {"orbit", "rotor.toml"},
           {"orbit", "rotor.toml", "--method", "harmonic-balance"},
           {"orbit", "rotor.toml", "--starts", "2"},
           {"torus", "rotor.toml"},
           {"continue", "rotor.toml", "--over", "operation.speed=700:800:10rpm"}}) {
    const Outcome refused = whirl(call);
    EXPECT_EQ(refused.status, 2) << call[0];
    EXPECT_TRUE(has(refused.err, "makes a torus of every motion")) << refused.err;
  }
  const Outcome method = whirl({"simulate", "rotor.toml", "--method", "collocation"});
  EXPECT_EQ(method.status, 2);
  EXPECT_TRUE(has(method.err, "not possible with a force with a frequency of its own"))
      << method.err;
}

// A run that goes on has the shaker where it was, after five revolutions and a fraction of its own.
TEST_F(ForceVerbs, MotionsThatGoOnHaveForcesWhereTheyWere) {
  if (!has_h5py()) GTEST_SKIP() << "there is no h5py";
  write_rotor(shaker + "[operation]\nspeed = \"700 rpm\"\n");
  const auto simulate = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"simulate", "rotor.toml", "--tolerance", "1e-13", "--revolutions"});
    EXPECT_EQ(result(more)["notes"].size(), 0u);
  };
  simulate({"9", "--discard", "0", "--out", "whole.h5"});
  simulate({"5", "--discard", "0", "--out", "first.h5"});
  simulate({"4", "--discard", "0", "--from", "first.h5", "--out", "rest.h5"});
  EXPECT_EQ(python_says("import h5py, numpy as np\n"
                        "a, b = (h5py.File(f)['trajectory'] for f in ('whole.h5', 'rest.h5'))\n"
                        "x, y = np.array(a['end_displacement']), np.array(b['end_displacement'])\n"
                        "print(a.attrs['end_revolution'], b.attrs['end_revolution'],\n"
                        "      abs(x - y).max() < 1e-9 * abs(x).max(), b['time'][0] > 0.42)"),
            "9.0 9.0 True True\n");
}

TEST_F(ForceVerbs, OrbitsRepeatWithForcesOfTheirOrder) {
  write_rotor(
      "[[force]]\nbody = \"rotor\"\nforce = \"3 N\"\norder = 0.5\n"
      "[operation]\nspeed = \"700 rpm\"\n[damping]\nrayleigh = {mass = 20}\n");
  for (const char* method : {"shooting", "harmonic-balance"}) {
    const json r = result({"orbit", "rotor.toml", "--period", "2", "--method", method});
    EXPECT_EQ(r["shortest_period_revs"], 2) << method;
    const Outcome refused = whirl({"orbit", "rotor.toml", "--method", method});
    EXPECT_EQ(refused.status, 2);
    EXPECT_TRUE(has(refused.err, "repeat")) << refused.err;
  }
  const Outcome branch =
      whirl({"continue", "rotor.toml", "--over", "operation.speed=700:800:10rpm", "--period", "2"});
  EXPECT_EQ(branch.status, 2);
  EXPECT_TRUE(has(branch.err, "give the forces orders that are whole numbers")) << branch.err;
  const Outcome along = whirl({"continue", "rotor.toml", "--over", "force.force 1.order=1:2:0.1"});
  EXPECT_EQ(along.status, 2);
  EXPECT_TRUE(has(along.err, "there is no branch along them")) << along.err;
}

// Lines of forces are those of no mode, and no pair of them is a resonance of modes.
TEST_F(ForceVerbs, IdentifyNamesLinesOfForces) {
  write_rotor(twice + shaker +
              "[operation]\nspeed = \"900 rpm\"\n[damping]\nrayleigh = {mass = 20}\n");
  const std::vector<std::string> call{"identify", "rotor.toml", "--discard", "200"};
  const json r = result(call);
  std::map<std::string, double> lines;
  for (const json& peak : r["peaks"]) {
    EXPECT_TRUE(peak["combination"].is_null());
    lines[peak.value("forced", "nothing")] = peak["frequency_rpm"].get<double>();
  }
  ASSERT_EQ(lines.size(), 3u);
  constexpr double of_a_bin = 0.02 * 900.0 / 512.0;
  EXPECT_NEAR(lines["1X"], 900.0, of_a_bin);
  EXPECT_NEAR(std::abs(lines["2x"]), 1800.0, of_a_bin);
  EXPECT_NEAR(lines["12 Hz"], -720.0, of_a_bin);
  EXPECT_TRUE(r["resonance"].is_null());
  const std::string told = whirl(call).out;
  for (const char* name : {"forced (1X)", "forced (2x)", "forced (12 Hz)"}) {
    EXPECT_TRUE(has(told, name)) << told;
  }
}

// Along x cos a + y sin a a force along x is read as its cosine, one that turns backward as large
// as it is, a ahead.
TEST_F(ForceVerbs, ProbesReadTheOthers) {
  write_rotor(twice + shaker + R"([[probe]]
name = "1X"
body = "rotor"
angle = "60 deg"
)");
  const std::vector<std::string> call{"unbalance",      "rotor.toml", "--speeds",
                                      "300:900:300rpm", "--out",      "u.h5"};
  const json r = result(call);
  ASSERT_EQ(r["forced_probes"].size(), 2u);
  const json &two = r["forced_probes"][0], &own = r["forced_probes"][1];
  EXPECT_EQ(two["name"], "1X");
  EXPECT_EQ(two["force"], "2x");
  EXPECT_EQ(two["order"], 2.0);
  EXPECT_EQ(own["force"], "12 Hz");
  EXPECT_NEAR(own["frequency_rpm"].get<double>(), 720.0, 1e-9);
  const auto study = read_result<UnbalanceStudy>(ResultReader(folder / "u.h5"));
  ASSERT_EQ(study.forced_probes.size(), 2u);
  for (std::size_t i = 0; i < 3; ++i) {
    const double Omega = (300.0 + 300.0 * static_cast<double>(i)) * pi / 30.0, w = 24.0 * pi;
    const Complex of_two = 3.0 * std::cos(pi / 3.0) * receptance(2.0 * Omega),
                  of_own = 5.0 * receptance(w) * std::polar(1.0, pi / 3.0);
    for (const auto& [found, reading] : {std::pair(two, of_two), std::pair(own, of_own)}) {
      const double size = 2.0 * std::abs(reading);
      EXPECT_NEAR(found["peak_to_peak_m"][i].get<double>(), size, rounding * size);
      EXPECT_NEAR(found["phase_deg"][i].get<double>(), std::arg(reading) * 180.0 / pi, 1e-6);
    }
    EXPECT_LT(std::abs(study.forced_probes[1].amplitude(static_cast<Eigen::Index>(i)) - of_own),
              rounding * std::abs(of_own));
  }
  const std::string told = whirl(call).out;
  EXPECT_TRUE(has(told, "The same along the probes")) << told;
}

// Amplitude over phase of every force, along the probes and at the stations.
TEST_F(ForceVerbs, ResponsesToTheOthersAreDrawn) {
  write_rotor(twice + shaker + R"([[probe]]
name = "1X"
body = "rotor"
angle = "60 deg"
unit = "mil"
)");
  result({"unbalance", "rotor.toml", "--speeds", "300:900:300rpm", "--out", "u.h5"});
  const ResultView view(folder / "u.h5");
  std::vector<Figure> figures;
  for (const FigureKind& kind : figure_kinds()) {
    if (kind.name == "forced") figures = figures_of(kind, view);
  }
  std::vector<std::string> variants;
  for (const Figure& f : figures) variants.push_back(f.variant);
  ASSERT_EQ(variants,
            (std::vector<std::string>{"2x, probes", "2x, x", "12 Hz, probes", "12 Hz, x"}));
  constexpr double mil = 25.4e-6, um = 1e-6, mm = 1e-3;
  for (std::size_t i = 0; i < 3; ++i) {
    const double Omega = (300.0 + 300.0 * static_cast<double>(i)) * pi / 30.0, w = 24.0 * pi;
    const double two = 2.0 * 3.0 * std::abs(receptance(2.0 * Omega)),
                 own = 2.0 * 5.0 * std::abs(receptance(w));
    const auto drawn = [&](std::size_t figure, std::size_t panel) {
      return figures[figure].panels.at(panel).curves.at(0).y.at(i);
    };
    EXPECT_NEAR(drawn(0, 0) * mil, two * std::cos(pi / 3.0), rounding * two);
    EXPECT_NEAR(drawn(1, 0) * um, two, rounding * two);
    EXPECT_NEAR(drawn(2, 0) * mil, own, rounding * own);
    EXPECT_NEAR(drawn(3, 0) * mm, own, rounding * own);
    EXPECT_NEAR(drawn(3, 1), -std::arg(receptance(w)) * 180.0 / pi, 1e-6);
  }
  EXPECT_EQ(figures[0].panels[0].y.title, "amplitude p-p [mil]");
  EXPECT_EQ(figures[0].table.rows.at(0).at(0), "1X, 60°");
  EXPECT_EQ(whirl({"plot", "u.h5", "forced", "--which", "12 Hz", "--out", "f.svg"}).status, 0);
  EXPECT_TRUE(has(content(folder / "f.svg"), "Response to forces of 12 Hz along the probes"));
  write("rotor.toml", jeffcott);
  result({"unbalance", "rotor.toml", "--speeds", "300:900:300rpm", "--out", "u.h5"});
  EXPECT_EQ(whirl({"plot", "u.h5", "forced"}).status, 2);
}

// A force of order 1/40 repeats after 40 revolutions, more than are searched; forces of 12 and 18
// Hz after 1/6 s, whatever the speed: in no whole number of revolutions at 730 rpm, in 10 at 600
// rpm, where one of 12 Hz alone takes 1/12 s.
TEST_F(ForceVerbs, MotionsSayAfterWhatTheyRepeat) {
  const std::string damped =
      "[damping]\nrayleigh = {mass = 20}\n[operation]\nspeed = \"730 rpm\"\n";
  const auto classified = [&](std::vector<std::string> more) {
    more.insert(more.begin(),
                {"classify", "rotor.toml", "--discard", "200", "--revolutions", "200"});
    return more;
  };
  write_rotor("[[force]]\nbody = \"rotor\"\nforce = \"3 N\"\norder = 0.025\n" + damped);
  const json long_one = result(classified({}));
  EXPECT_EQ(long_one["motion"], "periodic");
  EXPECT_EQ(long_one["period_revs"], 40);
  EXPECT_FALSE(long_one.contains("period_s"));
  EXPECT_TRUE(has(whirl(classified({})).out, "periodic, repeats after 40 revolutions"));

  const std::string other = "[[force]]\nbody = \"rotor\"\nforce = \"4 N\"\nfrequency = \"18 Hz\"\n";
  write_rotor(shaker + other + damped);
  EXPECT_FALSE(result(classified({})).contains("period_s"));  // not with the unbalance
  const std::vector<std::string> balanced = classified({"--set", "unbalance.1.offset=0"});
  const json both = result(balanced);
  EXPECT_EQ(both["motion"], "periodic");
  EXPECT_TRUE(both["period_revs"].is_null());
  EXPECT_NEAR(both["period_s"].get<double>(), 1.0 / 6.0, 1e-9);
  EXPECT_TRUE(has(whirl(balanced).out, "periodic, repeats after 0.166667 s"));

  write_rotor(shaker + damped);
  const json one = result(classified({"--set", "unbalance.1.offset=0", "--speed", "800rpm"}));
  EXPECT_EQ(one["period_revs"], 10);
  EXPECT_NEAR(one["period_s"].get<double>(), 1.0 / 12.0, 1e-9);
}

// What leaves them out says so.
TEST_F(ForceVerbs, WhatLeavesOthersOutSaysSo) {
  write_rotor(twice);
  result({"unbalance", "rotor.toml", "--out", "u.h5"});
  const json over =
      result({"unbalance", "rotor.toml", "--over", "bearing.shaft.damping=4,8", "--out", "o.h5"});
  EXPECT_TRUE(has(over["notes"].dump(), "without that to forces of other frequencies")) << over;
  for (const char* file : {"u.h5", "o.h5"}) {
    const ResultView view(folder / file);
    std::size_t drawn = 0;
    for (const FigureKind& kind : figure_kinds()) {
      if (kind.name != "bode" && kind.name != "polar" && kind.name != "unbalance_over") continue;
      for (const Figure& f : figures_of(kind, view)) {
        ++drawn;
        ASSERT_FALSE(f.notes.empty()) << kind.name;
        EXPECT_TRUE(has(f.notes.back(), "forces of other frequencies are not drawn")) << kind.name;
      }
    }
    EXPECT_GT(drawn, 0u) << file;
  }
  write("rotor.toml", jeffcott);
  EXPECT_EQ(result({"unbalance", "rotor.toml", "--over", "bearing.shaft.damping=4,8"})["notes"],
            json::array());
}

// A reader of universal files that knows nothing of whirl.
TEST_F(ForceVerbs, FrequencyResponsesAreExportedAsAUniversalFile) {
  write_rotor("");
  result({"frf", "rotor.toml", "--speed", "600rpm", "--from", "rotor:x", "--to", "rotor:x,rotor:y",
          "--frequencies", "1:30:0.5Hz", "--out", "frf.h5"});
  const json r = result({"export", "frf.h5", "--format", "uff"});
  EXPECT_EQ(r["files"], json::array({"frf.uff"}));
  EXPECT_EQ(whirl({"export", "frf.h5", "--format", "uff"}).status, 0);  // its own is replaced
  const Outcome refused = whirl({"export", "rotor.toml", "--format", "uff"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(has(refused.err, "take the result of whirl frf")) << refused.err;
  if (!has_h5py()) GTEST_SKIP() << "there is no h5py";
  EXPECT_EQ(
      python_says("import h5py, numpy as np\n"
                  "lines = open('frf.uff').read().split('\\n')\n"
                  "marks = [i for i, l in enumerate(lines) if l.rstrip() == '    -1']\n"
                  "sets = [lines[a + 1:b] for a, b in zip(marks[::2], marks[1::2])]\n"
                  "fs = [s for s in sets if int(s[0][:6]) == 58]\n"
                  "f = h5py.File('frf.h5')['frf']\n"
                  "worst, count = 0.0, 0\n"
                  "for s, name, pair in zip(fs, ['receptance', 'mobility', 'accelerance'] * 2,\n"
                  "                         [0, 0, 0, 1, 1, 1]):\n"
                  "    n = int(s[7][10:20])\n"
                  "    hz = float(s[7][30:43]) + float(s[7][43:56]) * np.arange(n)\n"
                  "    v = [float(l[i:i + 20]) for l in s[12:] for i in range(0, 80, 20)\n"
                  "         if l[i:i + 20].strip()]\n"
                  "    H = np.array(v[::2]) + 1j * np.array(v[1::2])\n"
                  "    g = np.array(f[name])[pair]\n"
                  "    g = g['r'] + 1j * g['i'] if g.dtype.names else g\n"
                  "    worst = max(worst, (abs(H - g) / np.maximum(abs(g), 1e-30)).max())\n"
                  "    assert abs(2 * np.pi * hz / np.array(f['frequency']) - 1).max() < 1e-12\n"
                  "    count += n\n"
                  "print(len(fs), count, worst < 1e-12)"),
      "6 354 True\n");
}

}  // namespace force_verbs_test
}  // namespace whirl::test
