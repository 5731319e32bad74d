// plot: pictures of results.

#include <fmt/format.h>

#include <complex>
#include <regex>

#include "libio/figures/figures.hpp"
#include "libio/results/hdf5.hpp"
#include "tests/cli/pictures.hpp"

namespace whirl::test {
namespace plot_test {

class Plot : public Pictures {
 protected:
  /// Kinds of figures that a result holds.
  std::vector<std::string> kinds(const std::string& file) const {
    std::vector<std::string> names;
    const json list = result({"plot", file});
    for (const json& k : list["kinds"]) names.push_back(k["kind"]);
    return names;
  }

  /// A result of a torus with circles at rotations from 0.3 to 0.45, after each of `period`
  /// revolutions.
  void write_torus(const std::string& file, int period) const {
    ResultWriter to(folder / file, Replaces::anything);
    to.dataset("/model", std::vector<std::string>{rubbing}, {"", "model", {""}});
    to.attribute("/model", "path", "rub.toml");
    to.dataset("/arguments", std::vector<std::string>{"whirl"}, {"", "command line", {""}});
    to.dataset("/torus/angle", std::vector<double>{0.0}, {"rad", "angle", {""}});
    to.dataset("/torus/displacement", Mat(Mat::Zero(1, 4)), {"m, rad", "displacement", {"", ""}});
    to.dataset("/torus/value", std::vector<double>{100.0, 110.0, 120.0},
               {"rad/s", "operation.speed", {""}});
    for (const auto& [name, values] :
         {std::pair<const char*, std::vector<double>>{"rotation", {0.3, 0.37, 0.45}},
          {"largest_exponent", {-0.2, -0.1, 0.1}},
          {"tail", {1e-9, 1e-9, 1e-9}}}) {
      to.dataset(std::string("/torus/") + name, values, {"", name, {"/torus/value"}});
    }
    to.attribute("/torus", "period_revolutions", period);
    to.commit();
  }

  /// Words that follow the first period doubling of a stator's rub in friction and stiffness.
  const std::vector<std::string> borders{
      "continue", WHIRL_SOURCE_DIR "/models/jeffcott_stator.toml",
      "--speed",  "138.4rad/s",
      "--over",   "contact.ring.friction=0.1:0.15:0.002",
      "--over",   "contact.ring.stiffness=50:80:0.5MN/m",
      "--at",     "0.15,64MN/m"};

  /// A report's figures of a kind, of its first result.
  json in_report(const std::string& file, const std::string& kind) const {
    const json data = page_data(content(folder / file));
    for (const json& f : data["results"][0]["figures"]) {
      if (f["kind"] == kind) return f;
    }
    return {};
  }
};

/// Curves of a name.
std::vector<Curve> named(const Panel& panel, const std::string& name) {
  std::vector<Curve> curves;
  for (const Curve& c : panel.curves) {
    if (c.name == name) curves.push_back(c);
  }
  return curves;
}

/// Figures of a kind.
std::vector<Figure> figures_in(std::string_view name, const ResultView& view) {
  for (const FigureKind& kind : figure_kinds()) {
    if (kind.name == name) return figures_of(kind, view);
  }
  return {};
}

long count(const std::string& text, const std::string& part) {
  long n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

/// The first panel of the first figure of a kind.
Panel panel_of(std::string_view name, const ResultView& view) {
  return figures_in(name, view).at(0).panels.at(0);
}

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
       {"layout", "bode", "polar", "deflection"}},
      {{"unbalance", "shaken.toml", "--speeds", "300:900:300rpm"}, {"bode", "polar", "forced"}},
      {{"frf", disks}, {"layout", "frf"}},
      {{"lateral", disks, "--maximum-speed", "6000rpm"},
       {"layout", "lateral", "campbell", "log_decrement", "critical_map", "lateral_response",
        "coupling"}},
      {{"identify", disks, "--revolutions", "64"},
       {"layout", "modes", "orbit", "time_history", "spectrum", "waterfall", "poincare",
        "contact_forces", "contact_angles", "mac"}},
      {{"identify", disks, "--measured", "run.csv", "--probes", "probes.toml", "--orders", "1",
        "--running-modes"},
       {"layout", "modes", "measured_orbit", "measured_spectrum", "measured_waterfall",
        "order_bode", "order_polar", "mac", "stabilization"}},
      {{"fit", disks, "--measured", "run.csv", "--probes", "probes.toml", "--free",
        "contact.ring.stiffness", "--revolutions", "4"},
       {"layout", "fit"}},
      {{"classify", "rub.toml", "--discard", "20"}, {"layout", "exponents"}},
      {{"sweep", "rub.toml"}, {"layout", "bifurcation", "spectral_map", "cascade"}},
      {{"continue", "rub.toml"}, {"layout", "branches"}},
      {borders, {"layout", "branches", "borders"}},
      {{"torus"}, {"layout", "torus"}},
      {{"map", "rub.toml"}, {"layout", "map", "exponent_map", "regime_map"}},
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
  std::vector<std::string> drawn;
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

// Of the Campbell diagram: every branch by its name, every critical speed of the JSON.
TEST_F(Plot, ACampbellDiagramListsItsCriticalSpeeds) {
  const json r = result({"campbell", WHIRL_SOURCE_DIR "/models/two_disk_mac.toml", "--speeds",
                         "0:8000:100rpm", "--out", "c.h5"});
  ASSERT_EQ(whirl({"plot", "c.h5", "campbell"}).status, 0);
  const std::string svg = content(folder / "c_campbell.svg");
  ASSERT_GE(r["criticals_rpm"].size(), 4u);
  for (const json& speed : r["criticals_rpm"]) {
    char text[32];
    std::snprintf(text, sizeof text, ">%.1f</text>", speed.get<double>());
    EXPECT_TRUE(has(svg, text)) << text;
  }
  for (const char* name : {">1B</text>", ">2F</text>", ">3B</text>", ">4F</text>", ">1X</text>"}) {
    EXPECT_TRUE(has(svg, name)) << name;
  }
}

// Of the resonances: both branches at their speed, seen from the rotor in the ratio p:q. A backward
// mode is faster there by the speed, a forward one differs from it.
TEST_F(Plot, ACampbellDiagramMarksResonances) {
  const json r = result({"resonances", WHIRL_SOURCE_DIR "/models/two_disk_mac.toml", "--speeds",
                         "3000:6500:50rpm", "--out", "c.h5"});
  const ResultView view(folder / "c.h5");
  const auto figures = figures_in("campbell", view);
  ASSERT_EQ(figures.size(), 2u);
  EXPECT_EQ(figures[0].variant, "resonances");
  const auto marks = named(figures[0].panels.at(0), "p:q resonance seen from the rotor");
  ASSERT_EQ(marks.size(), 1u);
  ASSERT_GT(r["resonances"].size(), 3u);
  ASSERT_EQ(marks[0].x.size(), 3 * r["resonances"].size());
  constexpr double between_speeds = 0.2;  // [rpm], of lines between the speeds of the branches
  for (std::size_t i = 0; i < r["resonances"].size(); ++i) {
    const json& one = r["resonances"][i];
    const double speed = one["speed_rpm"], seen = one["frequency_rpm"];
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(marks[0].x[3 * i + k], speed, 1e-9 * speed);
      const double frequency = 60.0 * marks[0].y[3 * i + k];
      const double times = one[k == 0 ? "p" : "q"];
      EXPECT_LT(std::min(std::abs(speed + frequency - times * seen),
                         std::abs(std::abs(speed - frequency) - times * seen)),
                between_speeds)
          << marks[0].hover[3 * i];
    }
    EXPECT_TRUE(std::isnan(marks[0].y[3 * i + 2]));  // marks are not joined
  }
  EXPECT_TRUE(figures[1].variant.empty());
  EXPECT_EQ(named(figures[1].panels.at(0), marks[0].name).size(), 0u);
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

// A linear rotor, whose orbit is known: x at phase 0 is Re e m Omega^2 / (k - m Omega^2 + i c Omega),
// and the exponent of a revolution -c / (2 m) times its time.
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

// Ratios of small integers that a rotation from 0.3 to 0.45 passes: 1/3, 2/5, 3/7, 3/8, 4/9, ...; of
// circles of every second revolution 1/3 = (2/3)/2, 3/8 = (3/4)/2, 3/10 = (3/5)/2, ...
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

// A mass m on a bearing whose stiffness grows with speed, k0 + s Omega: it meets the map's line
// Omega = sqrt(k / m) where m Omega^2 - s Omega - k0 = 0. Without gyroscopics the planes are apart,
// and both crossings are critical speeds of the model.
TEST_F(Plot, BearingsCrossTheCriticalMapAtTheCriticalSpeeds) {
  constexpr double m = 2.0, kx = 2e4, sx = 50.0, ky = 5e4, sy = 20.0;
  write("rotor.toml", R"(format = 1
[[body]]
name = "rotor"
mass = 2
spins = true
[[bearing]]
name = "shaft"
body = "rotor"
table = "k.csv"
)");
  write("k.csv", "speed, kxx, kyy\n0, 2e4, 5e4\n1000, 7e4, 7e4\n");
  const json r = result({"critical", "rotor.toml", "--out", "c.h5"});
  const ResultView view(folder / "c.h5");
  const Panel panel = panel_of("critical_map", view);
  const auto curve = [&](const std::string& name) {
    for (const Curve& c : panel.curves) {
      if (c.name == name) return c;
    }
    ADD_FAILURE() << name;
    return Curve{};
  };
  for (const auto& [name, k0, s] : {std::tuple{"Kxx", kx, sx}, {"Kyy", ky, sy}}) {
    const Curve c = curve(name);
    ASSERT_GT(c.x.size(), 10u);
    for (std::size_t i = 0; i < c.x.size(); ++i) {
      const double Omega = std::min(c.y[i] * rpm, 1000.0);  // constant beyond the table
      EXPECT_NEAR(c.x[i], k0 + s * Omega, 1e-9 * c.x[i]);
    }
  }
  const Curve crossings = curve("crossings");
  for (const auto& [k0, s] : {std::pair{kx, sx}, {ky, sy}}) {
    const double Omega = (s + std::sqrt(s * s + 4.0 * m * k0)) / (2.0 * m);
    const auto near = [&](double v) { return std::abs(v * rpm - Omega) < 1e-6 * Omega; };
    EXPECT_GE(std::count_if(crossings.y.begin(), crossings.y.end(), near), 1) << Omega / rpm;
    for (std::size_t i = 0; i < crossings.x.size(); ++i) {
      if (!near(crossings.y[i])) continue;
      EXPECT_NEAR(crossings.x[i], k0 + s * Omega, 1e-5 * k0);
    }
    bool is_critical = false;
    for (const json& c : r["criticals"]) is_critical |= near(c["speed_rpm"]);
    EXPECT_TRUE(is_critical) << Omega / rpm;
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
  EXPECT_TRUE(has(problem({"xyzzy"}), "there are layout, lateral, static, modes, "));
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
  EXPECT_TRUE(has(whirl({"plot", "rub.toml", "branches"}).err, "  whirl continue rub.toml --out"));
  EXPECT_TRUE(has(whirl({"report", "rub.toml"}).err, "  whirl simulate rub.toml --out rub.h5\n"));
  EXPECT_TRUE(has(whirl({"report", "nothing.h5"}).err, "there is no such file"));
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

// The sag of a shaft between bearings: reactions bear the rotor's weight, the moment is zero at both
// ends and largest between.
TEST_F(Plot, ASagShowsReactionsAndMoments) {
  const std::string model = WHIRL_SOURCE_DIR "/models/two_disk_double_rub.toml";
  make({"static", model}, "s.h5");
  const ResultView view(folder / "s.h5");
  const std::vector<Figure> figures = figures_in("static", view);
  ASSERT_EQ(figures.size(), 1u);
  const Figure& f = figures.front();
  ASSERT_EQ(f.panels.size(), 3u);
  const Mat load = view.file.matrix("/static/bearing_load");
  EXPECT_EQ(f.table.rows.size(), static_cast<std::size_t>(load.rows()));
  const auto rises = std::count_if(f.panels[0].labels.begin(), f.panels[0].labels.end(),
                                   [](const Label& l) { return l.text.starts_with("↑ "); });
  EXPECT_EQ(rises, load.rows());
  const auto moment = named(f.panels[1], "in the y-z plane");
  ASSERT_EQ(moment.size(), 1u);
  constexpr double rounding = 1e-6;  // of the largest moment
  const double largest = largest_of(moment[0].y);
  EXPECT_NEAR(moment[0].y.front(), 0.0, rounding * largest);
  EXPECT_NEAR(moment[0].y.back(), 0.0, rounding * largest);
  EXPECT_FALSE(named(f.panels[0], "disk").empty());
  EXPECT_FALSE(named(f.panels[0], "bearing").empty());
}

// Journals bear the rotor, so their films are told and labeled; seals that bear next to nothing are told only.
TEST_F(Plot, ASagTellsWhatOilFilmsBear) {
  make({"static", WHIRL_SOURCE_DIR "/models/compressor.toml"}, "s.h5");
  const ResultView view(folder / "s.h5");
  const Figure f = figures_in("static", view).at(0);
  ASSERT_EQ(f.table.rows.size(), view.model->structure.seals.size() + 2u);
  const Mat load = view.file.matrix("/films/load");
  double sum = 0.0;  // [kN]
  for (const Eigen::Index i : {0, 1}) {
    const auto& row = f.table.rows.at(f.table.rows.size() - 2u + static_cast<std::size_t>(i));
    EXPECT_EQ(row.at(0), i == 0 ? "left" : "right");
    EXPECT_TRUE(has(row.at(2), fmt::format("{:.4g}", 1e-3 * std::abs(load(i, 1))))) << row.at(2);
    sum += 1e-3 * std::abs(load(i, 1));
  }
  EXPECT_GT(sum, 0.9 * 735.0 * 9.81e-3);  // of the rotor's weight
  const Mat seals = view.file.matrix("/static/bearing_load");
  const double small = 0.05 * load.cwiseAbs().maxCoeff();
  const auto loaded = 2 + (seals.col(1).array().abs() >= small).count();
  EXPECT_LT(loaded, 4);
  std::vector<std::string> arrows;
  for (const Label& l : f.panels[0].labels) {
    if (l.text.starts_with("↑ ")) arrows.push_back(l.text);
  }
  ASSERT_EQ(std::ssize(arrows), loaded);
  EXPECT_EQ(arrows.end()[-2], fmt::format("↑ {:.4g} kN", -1e-3 * load(0, 1)));
  EXPECT_EQ(arrows.end()[-1], fmt::format("↑ {:.4g} kN", -1e-3 * load(1, 1)));
}

// An isotropic rotor does not whirl backward by a forward force: rounding is neither a peak nor a line,
// beside a response or alone.
TEST_F(Plot, AResponseThatIsNoneIsNotDrawn) {
  for (const std::string others : {"7:forward,", ""}) {
    const std::vector<std::string> call{"frf",     WHIRL_SOURCE_DIR "/models/two_disk_mac.toml",
                                        "--speed", "3000rpm",
                                        "--from",  "7:forward",
                                        "--to",    others + "7:backward",
                                        "--out",   "f.h5"};
    const std::string text = whirl(call).out;
    EXPECT_TRUE(std::regex_search(text, std::regex(" backward +none +0 +- +-"))) << text;
    const std::vector<Figure> figures = figures_in("frf", ResultView(folder / "f.h5"));
    ASSERT_EQ(figures.size(), 3u);
    for (const Figure& f : figures) {
      for (const Panel& p : f.panels) EXPECT_EQ(p.curves.size(), others.empty() ? 0u : 1u);
      ASSERT_EQ(f.notes.size(), 1u);
      EXPECT_TRUE(has(f.notes[0], "no response")) << f.notes[0];
    }
    EXPECT_EQ(whirl({"plot", "f.h5", "frf", "--out", "f.svg"}).status, 0);
  }
}

// Bearings of oil films are as long as they are, above and below the journals, which they leave room.
TEST_F(Plot, ALayoutShowsOilFilmsToScale) {
  make({"modes", WHIRL_SOURCE_DIR "/models/compressor.toml"}, "m.h5");
  const ResultView view(folder / "m.h5");
  const auto films = named(panel_of("layout", view), "oil film");
  ASSERT_EQ(films.size(), 2 * view.model->films.size());
  for (std::size_t i = 0; i < films.size(); ++i) {
    const JournalBearing& bearing = view.model->films[i / 2].bearing;
    const auto [left, right] = std::minmax_element(films[i].x.begin(), films[i].x.end());
    EXPECT_NEAR(*right - *left, 1e3 * bearing.length, 1e-9);
    EXPECT_GT(std::abs(films[i].y.front()), 1e3 * bearing.radius);
    EXPECT_EQ(films[i].y.front() > 0.0, i % 2 == 0);
  }
}

// It says what the shaft bends under.
TEST_F(Plot, ASagNamesItsLoads) {
  const std::string rotor = R"([material.steel]
density = "7850 kg/m^3"
youngs_modulus = "210 GPa"
shear_modulus = "80 GPa"
[[shaft]]
material = "steel"
length = "1 m"
outer_diameter = "30 mm"
[[bearing]]
at = "0 m"
stiffness = "1 MN/m"
[[bearing]]
at = "1 m"
stiffness = "1 MN/m"
)";
  const std::string force = "[[force]]\nat = \"0.5 m\"\nforce = \"10 N\"\n",
                    gravity = "gravity = 9.81\n", head = "format = 1\n";
  const auto subtitle = [&](const std::string& text) {
    write("rotor.toml", text);
    make({"static", "rotor.toml"}, "s.h5");
    return figures_in("static", ResultView(folder / "s.h5")).at(0).subtitle;
  };
  EXPECT_TRUE(has(subtitle(head + gravity + rotor), "under gravity, with"));
  EXPECT_TRUE(
      has(subtitle(head + gravity + rotor + force), "under gravity and constant forces, with"));
  EXPECT_TRUE(has(subtitle(head + rotor + force), "under constant forces, with"));
}

// Modes are told in a table and drawn one by one too, between the nodes as well.
TEST_F(Plot, ModesHaveATableAndShapesBetweenTheNodes) {
  const json r = result({"modes", WHIRL_SOURCE_DIR "/models/two_disk_mac.toml", "--out", "m.h5"});
  ResultView view(folder / "m.h5");
  view.frequency = *frequency_unit("cpm");
  const std::vector<Figure> figures = figures_in("modes", view);
  ASSERT_EQ(figures.size(), 1 + r["modes"].size());  // all, and each
  const FigureTable& table = figures[0].table;
  EXPECT_EQ(table.header[1], "frequency [cpm]");
  ASSERT_EQ(table.rows.size(), r["modes"].size());
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const double told = std::stod(table.rows[i][1]), exact = r["modes"][i]["frequency_rpm"];
    EXPECT_NEAR(told, exact, 1e-4 * exact);  // five digits
    EXPECT_EQ(table.rows[i][4], r["modes"][i]["whirl"]);
  }
  const Panel& panel = figures[1].panels.at(0);
  EXPECT_EQ(figures[1].variant, "mode 1");
  const auto x = named(panel, "x at its largest");
  ASSERT_EQ(x.size(), 1u);
  EXPECT_GT(x[0].x.size(), 4 * view.file.vector("/points/z").size());
  EXPECT_FALSE(named(panel, "disk").empty());
  EXPECT_FALSE(named(panel, "bearing").empty());
}

}  // namespace plot_test
}  // namespace whirl::test
