// plot: pictures of results.

#include <complex>
#include <regex>

#include "tests/cli/plots.hpp"

namespace whirl::test {
namespace plot_test {

// Every kind of figure is drawn from the result of the verb that holds its numbers.
TEST_F(Plot, DrawsEveryKindOfFigure) {
  const std::string disks = WHIRL_SOURCE_DIR "/models/two_disk_mac.toml";
  const std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>> cases{
      {{"campbell", disks, "--speeds", "0:8000:400rpm"}, {"layout", "campbell", "log_decrement"}},
      {{"resonances", disks, "--speeds", "4000:5000:200rpm"},
       {"layout", "campbell", "log_decrement"}},
      {{"critical", disks}, {"layout", "critical_map"}},
      {{"modes", disks}, {"layout", "modes"}},
      {{"modes", disks, "--over", "bearing.left.stiffness.xy,-bearing.left.stiffness.yx=0,1MN/m"},
       {"layout", "modes_over", "root_locus"}},
      {{"critical", disks, "--over", "bearing.left.stiffness=4,8MN/m"},
       {"layout", "critical_over"}},
      {{"unbalance", disks, "--over", "bearing.left.damping=4,8kN.s/m"},
       {"layout", "unbalance_over"}},
      {{"static", WHIRL_SOURCE_DIR "/models/two_disk_double_rub.toml"}, {"layout", "static"}},
      {{"unbalance", disks, "--speeds", "0:8000:100rpm"},
       {"layout", "bode", "polar", "deflection", "support_forces"}},
      {{"unbalance", "shaken.toml", "--speeds", "300:900:300rpm"},
       {"bode", "polar", "forced", "support_forces"}},
      {{"orbit", WHIRL_SOURCE_DIR "/models/jeffcott_stator.toml", "--period", "1"},
       {"layout", "multipliers"}},
      {{"frf", disks}, {"layout", "frf"}},
      {{"sensitivity", WHIRL_SOURCE_DIR "/models/magnetic_bearing.toml", "--steps", "50ms"},
       {"layout", "sensitivity", "step_response"}},
      {{"check", WHIRL_SOURCE_DIR "/tests/data/pedestal/pedestal.toml"}, {"support_fit"}},
      {{"lateral", disks, "--maximum-speed", "6000rpm"},
       {"layout", "lateral", "campbell", "log_decrement", "critical_map", "lateral_response",
        "coupling"}},
      {{"identify", disks, "--revolutions", "64"},
       {"layout", "modes", "orbit", "time_history", "spectrum", "waterfall", "orbits", "centerline",
        "poincare", "phase_plane", "tilts", "contact_motion", "contact_forces", "contact_angles",
        "support_history", "mac", "all_spectra"}},
      {{"identify", disks, "--measured", "run.csv", "--probes", "probes.toml", "--orders", "1",
        "--running-modes", "--trend"},
       {"layout", "modes", "orbits", "centerline", "measured_orbit", "measured_spectrum",
        "measured_waterfall", "measured_deflection", "order_bode", "order_polar", "trend", "mac",
        "stabilization"}},
      {{"balance", disks, "--speed", "1500rpm", "--runs", "balance.toml"}, {"layout", "balancing"}},
      {{"fit", disks, "--measured", "run.csv", "--probes", "probes.toml", "--free",
        "contact.ring.stiffness", "--revolutions", "4"},
       {"layout", "fit"}},
      {{"classify", "rub.toml", "--discard", "20"}, {"layout", "exponents"}},
      {{"sweep", "rub.toml"},
       {"layout", "bifurcation", "exponents_over", "spectral_map", "cascade"}},
      {{"continue", "rub.toml"}, {"layout", "branches"}},
      {borders, {"layout", "branches", "borders"}},
      {{"torus"}, {"layout", "torus"}},
      {{"map", "rub.toml"},
       {"layout", "map", "exponent_map", "regime_map", "shares", "contact_edges"}},
      {{"basins", "rub.toml"}, {"layout", "basins"}},
      {{"bench", "rub.toml"}, {"layout", "work_precision"}}};
  write("shaken.toml",
        std::string(jeffcott) + "[[force]]\nbody = \"rotor\"\nforce = \"3 N\"\norder = 2\n");
  write("probes.toml",
        "[[probe]]\nname = \"x\"\nnode = 7\nangle = 0\n[[probe]]\nname = \"y\"\nnode = 7\n"
        "angle = \"90 deg\"\n[keyphasor]\nchannel = \"key\"\n");
  ASSERT_EQ(whirl({"simulate", disks, "--measure", "probes.toml", "--measured-out", "run.csv",
                   "--revolutions", "64"})
                .status,
            0);
  write("balance.toml",
        "angles = \"with rotation\"\n[[plane]]\nname = \"left\"\nnode = 4\nradius = \"120 mm\"\n"
        "[[probe]]\nname = \"left\"\nnode = 4\nangle = 0\n");
  std::vector<std::string> drawn{"measured_cascade"};  // of a run-up: tests/measured draws it
  for (const auto& [words, expected] : cases) {
    SCOPED_TRACE(words[0]);
    if (words[0] == "torus") {  // a circle takes long to find
      write_torus("r.h5", 1);
    } else if (words == borders) {
      std::vector<std::string> all = words;  // as they are: make() adds another --over
      all.insert(all.end(), {"--out", "r.h5"});
      ASSERT_EQ(whirl(all).status, 0);
    } else {
      make(words, "r.h5");
    }
    EXPECT_EQ(kinds("r.h5"), expected);
    for (const std::string& kind : expected) {
      SCOPED_TRACE(kind);
      const json r = result({"plot", "r.h5", kind, "--out", "picture.svg"});
      EXPECT_EQ(r["files"], json::array({"picture.svg"}));
      const std::string svg = content(folder / "picture.svg");
      EXPECT_TRUE(has(svg, "<svg ") && has(svg, "</svg>"));
      EXPECT_EQ(count(svg, "<g "), count(svg, "</g>"));
      EXPECT_FALSE(std::regex_search(svg, std::regex("=\"-?(nan|inf)")));
      EXPECT_GT(count(svg, "<polyline") + count(svg, "<path") + count(svg, "<circle") +
                    count(svg, "<polygon"),
                0);
      drawn.push_back(kind);
    }
    std::filesystem::remove(folder / "r.h5");
  }
  for (const FigureKind& kind : figure_kinds()) {
    EXPECT_NE(std::find(drawn.begin(), drawn.end(), kind.name), drawn.end()) << kind.name;
  }
}

// The curve of a period doubling, both ways from the bifurcation of the branch: the numbers of the
// JSON in the units of the axes, over a map of the same values either way round.
TEST_F(Plot, BordersLieInThePlaneOfTheMap) {
  auto words = borders;
  words.insert(words.end(), {"--out", "b.h5"});
  const json r = result(words);
  ASSERT_EQ(r["borders"].size(), 2u);
  const ResultView view(folder / "b.h5");
  const Figure own = figures_in("borders", view).at(0);
  ASSERT_EQ(own.panels.at(0).curves.size(), 1u);
  const Curve& curve = own.panels[0].curves[0];
  EXPECT_EQ(curve.name, "period doubling");
  EXPECT_EQ(curve.end_name, "1 period doubling");
  EXPECT_EQ(own.panels[0].y.title, "contact.ring.stiffness [MN/m]");
  const json &down = r["borders"][0]["points"], &up = r["borders"][1]["points"];
  ASSERT_EQ(curve.x.size(), down.size() + up.size() - 1);
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const json& point = i < down.size() ? down[down.size() - 1 - i] : up[i + 1 - down.size()];
    EXPECT_NEAR(curve.x[i], point[0], 1e-12);
    EXPECT_NEAR(curve.y[i], 1e-6 * point[1].get<double>(), 1e-9);
  }
  double at_64 = 0.0;  // where the branch doubles its period
  for (const json& b : r["bifurcations"]) {
    if (b["kind"] == "period-doubling") at_64 = b["value"];
  }
  EXPECT_NEAR(curve.x[down.size() - 1], at_64, 1e-9);

  const std::string friction = "contact.ring.friction=0.12,0.13",
                    stiffness = "contact.ring.stiffness=63,65MN/m";
  const auto map = [&](const std::vector<std::string>& over, const std::string& out) {
    std::vector<std::string> line{"map",           WHIRL_SOURCE_DIR "/models/jeffcott_stator.toml",
                                  "--speed",       "138.4rad/s",
                                  "--discard",     "5",
                                  "--revolutions", "5",
                                  "--out",         out,
                                  "--quiet"};
    for (const std::string& o : over) line.insert(line.end(), {"--over", o});
    ASSERT_EQ(whirl(line).status, 0);
  };
  map({friction, stiffness}, "m.h5");
  map({stiffness, friction}, "turned.h5");
  for (const char* file : {"m.h5", "turned.h5"}) {
    const ResultView study(folder / file);
    auto figures = figures_in("map", study);
    ASSERT_EQ(lay_over(figures, study, view, "b.h5"), "");
    const Panel& p = figures.at(0).panels.at(0);
    const Curve over = named(p, "period doubling").at(0);
    const bool is_turned = file[0] == 't';
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      EXPECT_NEAR((is_turned ? over.y : over.x)[i], curve.x[i], 1e-12);
      EXPECT_NEAR((is_turned ? over.x : over.y)[i], curve.y[i], 1e-9);
    }
    EXPECT_FALSE(over.is_key);  // what is seen is the map
    EXPECT_EQ(whirl({"plot", file, "map", "--with", "b.h5", "--out", "m.svg"}).status, 0);
    EXPECT_TRUE(has(content(folder / "m.svg"), ">1 period doubling</text>"));
  }
  map({friction, "contact.ring.clearance=4,5mm"}, "other.h5");
  EXPECT_TRUE(has(whirl({"plot", "other.h5", "map", "--with", "b.h5"}).err,
                  "its bifurcation curves are in the plane of contact.ring.friction and "
                  "contact.ring.stiffness, the map in that of contact.ring.friction and "
                  "contact.ring.clearance"));
}

// A linear rotor, whose orbit is known: x at phase 0 is Re e m Omega^2 / (k - m Omega^2 + i c
// Omega), and the exponent of a revolution -c / (2 m) times its time.
TEST_F(Plot, BranchesLieOverTheSweep) {
  constexpr double m = 2.0, k = 2e4, e = 1e-4, Omega = 60.0;
  write("rotor.toml", std::string(jeffcott) + "[operation]\nspeed = 60\n");
  const auto call = [&](std::vector<std::string> words, const std::string& out) {
    words.insert(words.begin() + 1, "rotor.toml");
    words.insert(words.end(), {"--set", "gravity=0", "--discard", "20", "--out", out, "--quiet"});
    const Outcome outcome = whirl(words);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  };
  call({"sweep", "--over", "bearing.1.damping=40,80,120", "--revolutions", "5"}, "s.h5");
  call({"continue", "--over", "bearing.1.damping=40:120:20"}, "b.h5");
  const ResultView sweep(folder / "s.h5"), branches(folder / "b.h5");
  auto figures = figures_in("bifurcation", sweep);
  ASSERT_EQ(lay_over(figures, sweep, branches, "b.h5"), "");
  const Figure& f = figures.at(0);
  const Curve x = named(f.panels.at(0), "period 1, stable").at(0),
              exponent = named(f.panels.at(1), "period 1, stable").at(0);
  EXPECT_EQ(f.panels[0].y.title, "x once a revolution [µm]");
  ASSERT_GE(x.x.size(), 4u);
  for (std::size_t i = 0; i < x.x.size(); ++i) {
    if (std::isnan(x.x[i])) continue;
    const double c = x.x[i];
    const std::complex<double> steady =
        e * m * Omega * Omega / std::complex<double>(k - m * Omega * Omega, c * Omega);
    EXPECT_NEAR(x.y[i], 1e6 * steady.real(), 1e-4);  // [um]
    EXPECT_NEAR(exponent.y[i], -c / (2.0 * m) * 2.0 * pi / Omega, 1e-6);
  }
  EXPECT_EQ(f.notes.back(),
            "Lines: periodic orbits of b.h5, solid where stable, dashed where unstable.");
  ASSERT_EQ(whirl({"plot", "s.h5", "bifurcation", "--with", "b.h5"}).status, 0);
  EXPECT_TRUE(has(content(folder / "s_bifurcation.svg"), "period 1, stable"));

  // a report does it by itself; not where the models differ in something else
  ASSERT_EQ(whirl({"report", "s.h5", "b.h5"}).status, 0);
  EXPECT_TRUE(has(in_report("s.html", "bifurcation")["notes"].dump(), "periodic orbits of b.h5"));
  call({"continue", "--over", "bearing.1.damping=40:120:20", "--set", "bearing.1.stiffness=3e4"},
       "stiff.h5");
  const ResultView stiff(folder / "stiff.h5");
  EXPECT_EQ(other_values(sweep, stiff), std::vector<std::string>{"bearing.shaft.stiffness"});
  ASSERT_EQ(whirl({"report", "s.h5", "stiff.h5"}).status, 0);
  EXPECT_FALSE(has(in_report("s.html", "bifurcation")["notes"].dump(), "periodic orbits"));

  call({"continue", "--over", "unbalance.1.offset=0.1:0.2:0.05mm"}, "other.h5");
  const auto problem = [&](const std::vector<std::string>& words) {
    const Outcome outcome = whirl(words);
    EXPECT_EQ(outcome.status, 2);
    return outcome.err;
  };
  EXPECT_EQ(problem({"plot", "s.h5", "bifurcation", "--with", "other.h5"}),
            "--with other.h5: its branches run along unbalance.1.offset, the sweep along "
            "bearing.1.damping\n");
  EXPECT_TRUE(has(problem({"plot", "s.h5", "bifurcation", "--with", "s.h5"}),
                  "expected branches of whirl continue"));
  EXPECT_TRUE(has(problem({"plot", "s.h5", "cascade", "--with", "b.h5"}), "only"));
  EXPECT_TRUE(has(problem({"plot", "s.h5", "--with", "b.h5"}), "which kind of figure?"));
}

// Ratios of small integers that a rotation from 0.3 to 0.45 passes: 1/3, 2/5, 3/7, 3/8, 4/9, ...;
// of circles of every second revolution 1/3 = (2/3)/2, 3/8 = (3/4)/2, 3/10 = (3/5)/2, ...
TEST_F(Plot, LinesAtTheRatiosThatARotationPasses) {
  for (const int period : {1, 2}) {
    const std::string file = "t" + std::to_string(period) + ".h5";
    write_torus(file, period);
    const ResultView view(folder / file);
    const Figure f = figures_in("torus", view).at(0);
    EXPECT_EQ(f.panels.at(0).curves.at(0).y, (std::vector<double>{0.3, 0.37, 0.45}));
    EXPECT_EQ(f.panels.at(0).x.title, "operation.speed [rpm]");
    std::vector<std::string> names;
    for (const Rule& r : f.panels[0].rules) {
      names.push_back(r.name);
      const auto slash = r.name.find('/');
      EXPECT_NEAR(r.at, std::stod(r.name) / std::stod(r.name.substr(slash + 1)), 1e-12);
    }
    names.resize(std::min<std::size_t>(names.size(), 5));
    EXPECT_EQ(names, period == 1 ? (std::vector<std::string>{"1/3", "2/5", "3/7", "3/8", "4/9"})
                                 : (std::vector<std::string>{"1/3", "3/8", "3/10", "2/5", "5/12"}));
  }
}

// A page says of every study that was stopped that there is more of it, of a torus, too.
TEST_F(Plot, APageSaysThatAStudyIsNotComplete) {
  for (const int complete : {0, 1}) {
    write_torus("t.h5", 1, complete);
    ASSERT_EQ(whirl({"report", "t.h5"}).status, 0);
    const json warnings = page_data(content(folder / "t.html"))["results"][0]["warnings"];
    EXPECT_EQ(has(warnings.dump(), "the study is not complete"), complete == 0) << warnings;
  }
}

// A free vibration at omega = 100 rad/s dies out as exp(-zeta omega t) beside the steady response
// at the speed: from one spectrum to the next its line falls by that, the other one stays.
TEST_F(Plot, AWaterfallShowsAFreeVibrationDieOut) {
  write("rotor.toml", std::string(jeffcott) +
                          "[operation]\nspeed = 60\n[start]\ndisplaced = [{ body = \"rotor\", x = "
                          "\"2 mm\", vy = 0.2 }]\n");
  ASSERT_EQ(whirl({"simulate", "rotor.toml", "--set", "gravity=0", "--discard", "0",
                   "--revolutions", "128", "--samples", "16", "--out", "r.h5"})
                .status,
            0);
  ResultView view(folder / "r.h5");
  view.frequency = *frequency_unit("rad/s");
  const Panel panel = panel_of("waterfall", view);
  ASSERT_GE(panel.curves.size(), 8u);
  EXPECT_EQ(panel.x.title, "whirl frequency [rad/s]");
  // the decades between the line near a frequency and the largest of all, and the spectrum's time
  const double first = panel.curves.front().y.front(), last = panel.curves.back().y.front();
  const auto line = [&](const Curve& c, double frequency) {
    const double height = 0.09 * (last - first), time = c.y.front();  // flat at its end
    double most = 0.0;
    for (std::size_t k = 0; k < c.x.size(); ++k) {
      if (std::abs(c.x[k] - frequency) < 8.0) most = std::max(most, c.y[k] - time);
    }
    return 3.0 * (most / height - 1.0);
  };
  constexpr double zeta = 0.01, omega = 100.0;
  for (std::size_t i = 1; i < 4; ++i) {
    const Curve &before = panel.curves[i - 1], &now = panel.curves[i];
    const double passed = now.y.front() - before.y.front();
    // the decay within a window widens lines alike
    EXPECT_NEAR(line(now, omega) - line(before, omega), -zeta * omega * passed * std::log10(M_E),
                1e-3);
    EXPECT_NEAR(line(now, 60.0), line(before, 60.0), 0.02);
  }
}

// The same numbers in other units, on the axes, the lines of orders and in the table.
TEST_F(Plot, FrequenciesAreShownInTheUnitOfTheOption) {
  const std::string disks = WHIRL_SOURCE_DIR "/models/two_disk_mac.toml";
  make({"campbell", disks, "--speeds", "0:8000:400rpm"}, "c.h5");
  ResultView view(folder / "c.h5");
  const Panel in_hertz = panel_of("campbell", view);
  for (const auto& [unit, factor] : {std::pair{"cpm", 60.0}, {"rad/s", 2.0 * pi}}) {
    view.frequency = *frequency_unit(unit);
    const Panel p = panel_of("campbell", view);
    EXPECT_EQ(p.y.title, std::string("natural frequency [") + unit + "]");
    for (std::size_t i = 0; i < p.curves.size(); ++i) {
      for (std::size_t k = 0; k < p.curves[i].y.size(); ++k) {
        const double expected = factor * in_hertz.curves[i].y[k];
        if (!std::isfinite(expected)) continue;
        EXPECT_NEAR(p.curves[i].y[k], expected, 1e-9 * expected);
      }
    }
    EXPECT_NEAR(p.rules.at(0).at, factor * in_hertz.rules.at(0).at, 1e-12);
    ASSERT_EQ(whirl({"plot", "c.h5", "campbell", "--frequency", unit, "--out", "u.svg"}).status, 0);
    EXPECT_TRUE(has(content(folder / "u.svg"), p.y.title));
  }
  EXPECT_NEAR(in_hertz.rules.at(0).at, 1.0 / 60.0, 1e-15);  // Hz per rpm
  EXPECT_EQ(whirl({"plot", "c.h5", "campbell", "--frequency", "rpm"}).status, 2);
  ASSERT_EQ(whirl({"report", "c.h5", "--frequency", "cpm"}).status, 0);
  EXPECT_TRUE(has(content(folder / "c.html"), "natural frequency [cpm]"));
}

TEST_F(Plot, TellsWhatCanBeDrawn) {
  make({"simulate", "rub.toml", "--revolutions", "8", "--discard", "4"}, "r.h5");
  const std::string list = whirl({"plot", "r.h5"}).out;
  for (const char* part : {"orbit", "spectrum", "contact_forces", "rotor"}) {
    EXPECT_TRUE(has(list, part)) << part;
  }
  const auto problem = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"plot", "r.h5"});
    const auto before = files();
    const Outcome outcome = whirl(words);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(files(), before);
    return outcome.err;
  };
  EXPECT_EQ(problem({"orbitt"}), "orbitt: unknown kind of figure, did you mean \"orbit\"?\n");
  EXPECT_TRUE(
      has(problem({"xyzzy"}), "unknown kind of figure; this result can be drawn as layout, "));
  EXPECT_TRUE(has(problem({"campbell"}), "does not hold what this figure needs"));
  EXPECT_TRUE(has(problem({"orbit", "--which", "moon"}), "there are rotor"));
  EXPECT_TRUE(has(problem({"orbit", "--out", "x.jpg"}), ".svg, .png or .pdf"));
  EXPECT_TRUE(has(problem({"orbit", "--out", "nowhere/x.svg"}), "there is no directory nowhere"));
  EXPECT_TRUE(has(problem({"orbit", "spectrum"}), "one kind of figure at a time"));
  EXPECT_TRUE(has(problem({"--out", "x.svg"}), "which kind of figure?"));
  write("mine.svg", "<svg></svg>");
  EXPECT_TRUE(has(problem({"orbit", "--out", "mine.svg"}), "would be lost"));
  EXPECT_EQ(whirl({"plot", "rub.toml", "campbell"}).err,
            "whirl: cannot open rub.toml: not an HDF5 file but a model; compute a result first, "
            "such as\n  whirl campbell rub.toml --out rub.h5\n  whirl plot rub.h5 campbell\n");
  EXPECT_TRUE(
      has(whirl({"plot", "rub.toml"}).err, "\nor draw the model:\n  whirl plot rub.toml layout\n"));
  EXPECT_TRUE(has(whirl({"plot", "rub.toml", "branches"}).err, "  whirl continue rub.toml --out"));
  EXPECT_TRUE(has(whirl({"report", "rub.toml"}).err, "  whirl simulate rub.toml --out rub.h5\n"));
  EXPECT_TRUE(has(whirl({"report", "nothing.h5"}).err, "there is no such file"));
}

// The picture of a model is that of its results, without one; --set counts.
TEST_F(Plot, DrawsTheLayoutOfAModel) {
  const std::string disks = WHIRL_SOURCE_DIR "/models/two_disk_mac.toml";
  ASSERT_EQ(whirl({"modes", disks, "--out", "m.h5"}).status, 0);
  ASSERT_EQ(whirl({"plot", "m.h5", "layout", "--out", "of_result.svg"}).status, 0);
  ASSERT_EQ(whirl({"plot", disks, "layout", "--out", "of_model.svg"}).status, 0);
  EXPECT_EQ(content(folder / "of_model.svg"), content(folder / "of_result.svg"));
  ASSERT_EQ(whirl({"plot", disks, "layout", "--set", "disk.1.outer_diameter=0.5m", "--out",
                   "of_model.svg"})
                .status,
            0);
  EXPECT_NE(content(folder / "of_model.svg"), content(folder / "of_result.svg"));
  ASSERT_EQ(whirl({"plot", "rub.toml", "layout"}).status, 0);  // without a shaft, along the axis
  EXPECT_TRUE(has(content(folder / "rub_layout.svg"), "clearance"));
  EXPECT_EQ(whirl({"plot", "rub.toml", "layout", "--which", "x"}).status, 2);
}

// Ranges, names and panels of one's own; wrong ones say what there is, and write nothing.
TEST_F(Plot, TakesRangesAndNamesOfOnesOwn) {
  const std::string disks = WHIRL_SOURCE_DIR "/models/two_disk_mac.toml";
  make({"unbalance", disks, "--speeds", "0:8000:100rpm"}, "u.h5");
  ASSERT_EQ(whirl({"plot", "u.h5", "bode", "--xlim", "20:60Hz", "--panels", "amplitude", "--log",
                   "y", "--xlabel", "Drehzahl [rpm]", "--title", "Läufer", "--labels", "Scheibe",
                   "--size", "85x60mm", "--out", "b.svg"})
                .status,
            0);
  const std::string svg = content(folder / "b.svg");
  for (const char* part : {">Drehzahl [rpm]<", ">Läufer<", ">Scheibe<", ">2000<"}) {
    EXPECT_TRUE(has(svg, part)) << part;
  }
  EXPECT_FALSE(has(svg, "phase"));
  const Outcome wrong = whirl({"plot", "u.h5", "bode", "--ylim", "0:3kN", "--out", "w.svg"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_TRUE(has(wrong.err, "--ylim 0:3kN: no axis is in kN; y is amplitude p-p [")) << wrong.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "w.svg"));
  EXPECT_TRUE(has(whirl({"plot", "u.h5", "bode", "--marker-size", "big"}).err, "expected points"));
  EXPECT_TRUE(has(whirl({"plot", "u.h5", "--xlim", "0:1"}).err, "which kind of figure?"));
}

// PNG and PDF are made by rsvg-convert; without it the package is named and nothing is left behind.
TEST_F(Plot, WritesPngAndPdf) {
  make({"simulate", "rub.toml", "--revolutions", "8", "--discard", "4"}, "r.h5");
  if (wait(start("sh", {"-c", "command -v rsvg-convert"})).status == 0) {
    ASSERT_EQ(whirl({"plot", "r.h5", "orbit", "--out", "o.png"}).status, 0);
    ASSERT_EQ(whirl({"plot", "r.h5", "orbit", "--out", "o.pdf"}).status, 0);
    EXPECT_EQ(content(folder / "o.png").substr(1, 3), "PNG");
    EXPECT_EQ(content(folder / "o.pdf").substr(0, 4), "%PDF");
    EXPECT_EQ(files(), (std::vector<std::string>{"o.pdf", "o.png", "r.h5", "rub.toml"}));
  }
  const Outcome without = wait(start("sh", {"-c", "PATH=/nowhere " + std::string(WHIRL_PROGRAM) +
                                                      " plot r.h5 orbit --out p.png"}));
  EXPECT_EQ(without.status, 2);
  EXPECT_TRUE(has(without.err, "librsvg2-bin")) << without.err;
  EXPECT_EQ(std::filesystem::exists(folder / "p.png"), false);
}

// The line that a click on a cell offers is taken by a shell as it is, with blanks in names and
// values, and gives the motion of the cell: nothing that was set is lost.
TEST_F(Plot, TheCommandOfAPointIsWholeForAShell) {
  std::string spaced = rubbing;
  spaced.replace(spaced.find("name = \"ring\""), 13, "name = \"my ring\"");
  write("my rub.toml", spaced);
  ASSERT_EQ(whirl({"map", "my rub.toml", "--set=body.rotor.mass=2.5 kg", "--speed=90rad/s",
                   "--discard=40", "--over", "contact.my ring.clearance=0.4,0.5mm", "--over",
                   "contact.my ring.stiffness,bearing.shaft.stiffness=2e4,3e4", "--revolutions=20",
                   "--out", "m.h5"})
                .status,
            0);
  ASSERT_EQ(whirl({"report", "m.h5"}).status, 0);
  std::string line = in_report("m.html", "map")["panels"][0]["cells"]["command"];
  EXPECT_EQ(line,
            "whirl classify 'my rub.toml' --set 'body.rotor.mass=2.5 kg' --set "
            "operation.speed=90rad/s --discard=40 --set 'contact.my ring.clearance='{x}m --set "
            "'contact.my ring.stiffness='{y} --set bearing.shaft.stiffness={y}");
  for (const auto& [place, value] : {std::pair{"{x}", "0.0005"}, {"{y}", "30000"}}) {
    for (auto at = line.find(place); at != std::string::npos; at = line.find(place)) {
      line.replace(at, 3, value);
    }
  }
  line.replace(0, 5, WHIRL_PROGRAM);
  const Outcome o = wait(start("sh", {"-c", line + " --revolutions 20 --out c.h5 --json -"}));
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(o.err, "");
  const ResultReader map(folder / "m.h5"), cell(folder / "c.h5");
  EXPECT_EQ(o.tree()["contacts"][0]["regime"], "permanent");
  EXPECT_NEAR(o.tree()["contacts"][0]["max_normal_n"], map.numbers("/map/max_normal")[3],
              1e-6 * map.numbers("/map/max_normal")[3]);  // a later revolution of the same orbit
  EXPECT_TRUE(has(cell.strings("/model").at(0), "2.5 kg"));
}

}  // namespace plot_test
}  // namespace whirl::test
