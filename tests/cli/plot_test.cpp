// plot and report: pictures and pages of results.

#include <complex>
#include <cstring>
#include <regex>

#include "libio/comparison.hpp"
#include "libio/figures.hpp"
#include "libio/hdf5.hpp"
#include "tests/cli/program.hpp"

namespace whirl::test {
namespace plot_test {

class Plot : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("rub.toml", rubbing);
  }

  void make(std::vector<std::string> words, const std::string& out) const {
    words.insert(words.end(), {"--out", out, "--quiet"});
    const Outcome outcome = whirl(briefly(words));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }

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
    const std::string page = content(folder / file);
    const auto from = page.find("id=\"data\">") + 10;
    const json data = json::parse(page.substr(from, page.find("</script>", from) - from));
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

/// Numbers of an array of a page: "f64:" and base64 of little-endian doubles.
std::vector<double> numbers_of(const std::string& text) {
  EXPECT_EQ(text.substr(0, 4), "f64:");
  static const std::string letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int held = 0;
  for (const char c : text.substr(4)) {
    const auto value = letters.find(c);
    if (value == std::string::npos) break;  // padding
    bits = (bits << 6) | static_cast<unsigned>(value);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes += static_cast<char>((bits >> held) & 0xffu);
  }
  std::vector<double> numbers(bytes.size() / sizeof(double));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(double));
  return numbers;
}

long count(const std::string& text, const std::string& part) {
  long n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

/// The first panel of the first figure of a kind.
Panel panel_of(std::string_view name, const ResultView& view) {
  for (const FigureKind& kind : figure_kinds()) {
    if (kind.name == name) return figures_of(kind, view).at(0).panels.at(0);
  }
  ADD_FAILURE() << name;
  return {};
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
      {{"static", WHIRL_SOURCE_DIR "/models/two_disk_double_rub.toml"}, {"layout", "static"}},
      {{"unbalance", disks, "--speeds", "0:8000:100rpm"},
       {"layout", "bode", "polar", "deflection"}},
      {{"identify", disks, "--revolutions", "64"},
       {"layout", "modes", "orbit", "time_history", "spectrum", "waterfall", "poincare",
        "contact_forces", "contact_angles", "mac"}},
      {{"classify", "rub.toml", "--discard", "20"}, {"layout", "exponents"}},
      {{"sweep", "rub.toml"}, {"layout", "bifurcation", "spectral_map", "cascade"}},
      {{"continue", "rub.toml"}, {"layout", "branches"}},
      {borders, {"layout", "branches", "borders"}},
      {{"torus"}, {"layout", "torus"}},
      {{"map", "rub.toml"}, {"layout", "map", "exponent_map", "regime_map"}},
      {{"basins", "rub.toml"}, {"layout", "basins"}},
      {{"bench", "rub.toml"}, {"layout", "work_precision"}}};
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
                  "its borders are in the plane of contact.ring.friction and "
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
  EXPECT_TRUE(has(problem({"xyzzy"}), "there are layout, static, modes, "));
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

// A page needs nothing from outside, and holds every figure of all results with their data.
TEST_F(Plot, AReportIsOneFile) {
  make({"simulate", "rub.toml", "--revolutions", "8", "--discard", "4"}, "r.h5");
  make({"campbell", "rub.toml"}, "c.h5");
  const json r = result({"report", "r.h5", "c.h5"});
  EXPECT_EQ(r["files"], json::array({"r.html"}));
  const std::string page = content(folder / "r.html");
  EXPECT_EQ(page.substr(0, 15), "<!DOCTYPE html>");
  for (const char* place : {"{{title}}", "{{style}}", "{{three}}", "{{data}}", "{{script}}"}) {
    EXPECT_FALSE(has(page, place)) << "not filled";
  }
  for (const char* part : {"src=\"http", "href=\"http", "@import", "fetch(", "XMLHttpRequest("}) {
    EXPECT_FALSE(has(page.substr(0, page.find("var three=")), part)) << part;
  }
  const auto from = page.find("id=\"data\">") + 10;
  const json data = json::parse(page.substr(from, page.find("</script>", from) - from));
  ASSERT_EQ(data["results"].size(), 2u);
  std::size_t figures = data["machine"]["figures"].size();  // of both
  for (const json& one : data["results"]) figures += one["figures"].size();
  EXPECT_EQ(figures, r["figures"]);
  const json &linear = data["results"][0], &motion = data["results"][1];
  EXPECT_EQ(motion["figures"][0]["kind"], "orbit");
  std::vector<std::string> facts;
  for (const json& fact : motion["facts"]) facts.push_back(fact[0]);
  EXPECT_EQ(facts, (std::vector<std::string>{"result", "model", "command", "made by", "made at",
                                             "speed", "recorded", "cost", "rotor"}));
  EXPECT_TRUE(has(motion["model"], "clearance = \"0.5 mm\""));
  EXPECT_TRUE(motion["motion"].contains("motions"));
  EXPECT_FALSE(linear["motion"].contains("motions"));
  // program, style and libraries: below 1 MB
  EXPECT_LT(page.size() - data.dump().size(), 1'000'000u);
}

// A response to unbalance moves the page's rotor like a shaft: its cross-sections tilt with the
// slopes, theta_x = -dy/dz and theta_y = dx/dz, at the left end by those of the first element.
TEST_F(Plot, AResponseTiltsThePagesRotorWithItsSlopes) {
  write("shaft.toml", R"(format = 1
[material.steel]
density = 7800
youngs_modulus = "200 GPa"
poisson_ratio = 0.3
[[shaft]]
material = "steel"
length = 1
outer_diameter = "30 mm"
elements = 4
[[disk]]
at = 0.5
mass = 5
diametral_inertia = 0.1
unbalance = { moment = 1e-4 }
[[bearing]]
at = 0
stiffness = 1e7
damping = 500
[[bearing]]
at = 1
stiffness = 1e7
damping = 500
)");
  make({"unbalance", "shaft.toml", "--speeds", "0:500:2"}, "u.h5");
  ASSERT_EQ(whirl({"report", "u.h5"}).status, 0);
  const std::string page = content(folder / "u.html");
  const auto from = page.find("id=\"data\">") + 10;
  const json data = json::parse(page.substr(from, page.find("</script>", from) - from));
  const json& motion = data["results"][0]["motion"];
  const json& response = motion["motions"][0];
  const double length = motion["z"][1].get<double>() - motion["z"][0].get<double>();
  for (const char* part : {"re", "im"}) {  // x, y, theta_x, theta_y of every node
    const auto v = numbers_of(data["arrays"][response[part].get<std::size_t>()]);
    ASSERT_EQ(v.size(), 5u * 4u);
    const double rounding = 1e-12 * std::abs(v[8] + v[9]);
    EXPECT_NEAR(v[2], -(v[4 + 1] - v[1]) / length, rounding) << part;
    EXPECT_NEAR(v[3], (v[4] - v[0]) / length, rounding) << part;
    EXPECT_GT(std::abs(v[2]) + std::abs(v[3]), 1e3 * rounding) << part;
  }
}

// Two runs over each other: what was changed is said, and every curve of both is there, in the units
// of the first, although the second one's motion is so small that it is shown in others.
TEST_F(Plot, AReportComparesResults) {
  for (const auto& [set, out] :
       {std::pair{"unbalance.1.offset=1mm", "a.h5"}, {"unbalance.1.offset=0.0001mm", "b.h5"}}) {
    make({"simulate", "rub.toml", "--set", set, "--revolutions", "8", "--discard", "40"}, out);
  }
  const json r = result({"report", "a.h5", "b.h5"});
  const std::string page = content(folder / "a.html");
  const auto from = page.find("id=\"data\">") + 10;
  const json data = json::parse(page.substr(from, page.find("</script>", from) - from));
  const json& compared = data["comparison"];
  EXPECT_EQ(compared["names"], json::array({"a", "b"}));
  EXPECT_EQ(compared["differences"]["header"], json::array({"model", "a", "b"}));
  EXPECT_EQ(compared["differences"]["rows"],
            json::array({json::array({"unbalance.1.offset", "1mm", "0.0001mm"})}));
  const ResultView a(folder / "a.h5"), b(folder / "b.h5");
  const auto history = [](const json& figures) {
    for (const json& f : figures) {
      if (f["kind"] == "time_history") return f;
    }
    return json{};
  };
  const json both = history(compared["figures"]), one = history(data["results"][0]["figures"]);
  ASSERT_EQ(both["panels"].size(), one["panels"].size());
  EXPECT_EQ(both["panels"][0]["y"]["title"], "x [µm]");
  EXPECT_NE(history(data["results"][1]["figures"])["panels"][0]["y"]["title"], "x [µm]");
  EXPECT_EQ(both["panels"][0]["curves"][0]["name"], "a: x");
  EXPECT_EQ(both["panels"][0]["curves"][1]["name"], "b: x");
  EXPECT_NE(both["panels"][0]["curves"][0]["paint"], both["panels"][0]["curves"][1]["paint"]);
  // the smaller motion is a ten-thousandth of the linear one, as numbers of the same unit
  const auto figures = [&](const ResultView& view) {
    for (const FigureKind& kind : figure_kinds()) {
      if (kind.name == "time_history") return figures_of(kind, view).at(0);
    }
    return Figure{};
  };
  const Figure x = figures(a), y = figures(b);
  const auto overlaid = overlay({&x, &y}, {"a", "b"});
  ASSERT_TRUE(overlaid);
  const std::vector<double>& small = overlaid->panels.at(0).curves.at(1).y;
  const double in_nm = largest_of(y.panels.at(0).curves.at(0).y);
  EXPECT_NEAR(largest_of(small), 1e-3 * in_nm, 1e-9 * in_nm);
  for (const json& f : compared["figures"]) EXPECT_NE(f["kind"], "layout");
}

/// Texts of an SVG picture that are not turned: where they are, from left to right and up to down.
struct ShownText {
  double left, right, top, floor, size;
  std::string text;
};

std::vector<ShownText> texts_in(const std::string& svg) {
  // letters of the fonts that SVG names are half as wide as high at least in the mean
  constexpr double letter_width = 0.5;
  std::vector<ShownText> all;
  const std::regex pattern(
      "<text x=\"([-0-9.]+)\" y=\"([-0-9.]+)\" font-size=\"([0-9.]+)\"([^>]*)>([^<]+)</text>");
  for (std::sregex_iterator it(svg.begin(), svg.end(), pattern), end; it != end; ++it) {
    const std::string more = (*it)[4];
    if (has(more, "rotate")) continue;
    const double x = std::stod((*it)[1]), y = std::stod((*it)[2]), size = std::stod((*it)[3]);
    const std::string text = (*it)[5];
    const double width = letter_width * size *
                         static_cast<double>(std::count_if(text.begin(), text.end(), [](char c) {
                           return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u;
                         }));
    const double left = has(more, "\"end\"")      ? x - width
                        : has(more, "\"middle\"") ? x - 0.5 * width
                                                  : x;
    all.push_back({left, left + width, y - 0.7 * size, y, size, text});
  }
  return all;
}

// A column of a journal, 85 x 60 mm at 8 pt: the picture has that size and its letters theirs, and no
// text lies on another one or reaches out.
TEST_F(Plot, APictureOfAJournalColumnIsReadable) {
  make({"unbalance", WHIRL_SOURCE_DIR "/models/two_disk_mac.toml", "--speeds", "0:8000:100rpm"},
       "u.h5");
  make({"campbell", WHIRL_SOURCE_DIR "/models/two_disk_mac.toml", "--speeds", "0:8000:400rpm"},
       "c.h5");
  make({"modes", WHIRL_SOURCE_DIR "/models/two_disk_mac.toml"}, "m.h5");
  make({"static", WHIRL_SOURCE_DIR "/models/two_disk_double_rub.toml"}, "s.h5");
  constexpr double pixel = 8.0 / 12.0;  // [pt]: 12 pixels of the drawing are 8 pt
  constexpr double smallest = 11.0;     // [pixels], letters at points and in cells
  constexpr double width = 85.0 / 25.4 * 72.0 / pixel, height = 60.0 / 25.4 * 72.0 / pixel;
  for (const auto& [file, kind] : {std::pair{"u.h5", "bode"},
                                   {"u.h5", "polar"},
                                   {"u.h5", "deflection"},
                                   {"c.h5", "campbell"},
                                   {"c.h5", "log_decrement"},
                                   {"c.h5", "layout"},
                                   {"m.h5", "modes"},
                                   {"s.h5", "static"}}) {
    SCOPED_TRACE(kind);
    const std::string picture = std::string(kind) + ".picture";
    const json r = result({"plot", file, kind, "--size", "85x60mm", "--font", "8", "--no-title",
                           "--format", "svg", "--out", picture});
    EXPECT_EQ(r["files"], json::array({picture}));
    const std::string svg = content(folder / picture);
    EXPECT_TRUE(has(svg, "width=\"85mm\" height=\"60mm\""));
    EXPECT_FALSE(std::regex_search(svg, std::regex("Two-disk rotor [a-z ]+</text>")));
    const auto texts = texts_in(svg);
    EXPECT_GT(texts.size(), 5u);
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const ShownText& a = texts[i];
      EXPECT_GE(a.size, smallest) << a.text;
      EXPECT_GE(a.left, -1.0) << a.text;
      EXPECT_LE(a.right, width + 1.0) << a.text;
      EXPECT_GE(a.top, -1.0) << a.text;
      EXPECT_LE(a.floor, height + 1.0) << a.text;
      for (std::size_t k = 0; k < i; ++k) {
        const ShownText& b = texts[k];
        const bool cross =
            a.left < b.right && b.left < a.right && a.top < b.floor && b.top < a.floor;
        EXPECT_FALSE(cross) << a.text << " on " << b.text;
      }
    }
  }
  // what has no room is said
  const Outcome told = whirl({"plot", "m.h5", "modes", "--size", "85x60mm", "--out", "m.svg"});
  EXPECT_TRUE(has(told.out, "no room for the table")) << told.out;
  EXPECT_TRUE(has(told.out, "of 6 panels")) << told.out;
  // a larger picture holds all
  EXPECT_EQ(result({"plot", "m.h5", "modes", "--size", "17x20cm", "--out", "m.svg"})["left_out"],
            json::array());
}

TEST_F(Plot, RefusesSizesThatAreNone) {
  make({"modes", WHIRL_SOURCE_DIR "/models/two_disk_mac.toml"}, "m.h5");
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"--size", "85"},
                                             {"--size", "85x60"},
                                             {"--size", "1x1mm"},
                                             {"--size", "axbmm"},
                                             {"--size", "85x9999999mm"},
                                             {"--font", "0"},
                                             {"--font", "8pt"},
                                             {"--font", "nan"},
                                             {"--format", "gif"},
                                             {"--format", ""}}) {
    std::vector<std::string> call{"plot", "m.h5", "modes", "--out", "p.svg"};
    call.insert(call.end(), words.begin(), words.end());
    const Outcome outcome = whirl(call);
    EXPECT_EQ(outcome.status, 2) << words[1];
    EXPECT_TRUE(has(outcome.err, words[0])) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "p.svg")) << words[1];
  }
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

/// What a report's page holds.
json page_data(const std::string& page) {
  const auto from = page.find("id=\"data\">") + 10;
  return json::parse(page.substr(from, page.find("</script>", from) - from));
}

// Analyses of one model are one report of one machine, drawn once, in the order of a report; other
// speeds are no other machine. Another model, or a verb twice, is compared.
TEST_F(Plot, AnalysesOfOneModelAreOneReport) {
  const std::string disks = WHIRL_SOURCE_DIR "/models/two_disk_mac.toml";
  make({"unbalance", disks, "--speeds", "0:8000:200rpm"}, "u.h5");
  make({"modes", disks, "--speed", "3000rpm"}, "m.h5");
  make({"modes", disks, "--speed", "5000rpm"}, "n.h5");
  make({"campbell", disks, "--speeds", "0:8000:800rpm", "--set", "disk.1.width=12mm"}, "c.h5");
  ASSERT_EQ(whirl({"report", "u.h5", "m.h5", "--out", "one.html"}).status, 0);
  const json one = page_data(content(folder / "one.html"));
  ASSERT_TRUE(one.contains("machine"));
  EXPECT_FALSE(one.contains("comparison"));
  EXPECT_EQ(one["machine"]["figures"].size(), 1u);
  EXPECT_EQ(one["machine"]["figures"][0]["kind"], "layout");
  ASSERT_EQ(one["results"].size(), 2u);
  EXPECT_EQ(one["results"][0]["heading"], "Modes");
  EXPECT_EQ(one["results"][1]["heading"], "Unbalance response");
  for (const json& r : one["results"]) {
    for (const json& f : r["figures"]) EXPECT_NE(f["kind"], "layout");
  }
  for (const char* other : {"n.h5", "c.h5"}) {
    ASSERT_EQ(whirl({"report", "m.h5", other, "--out", "two.html"}).status, 0);
    const json two = page_data(content(folder / "two.html"));
    EXPECT_TRUE(two.contains("comparison")) << other;
    EXPECT_FALSE(two.contains("machine")) << other;
  }
}

// Nodes of another model than that of the file, as of files that were put together: the page says which
// figure failed and why, and draws the others.
TEST_F(Plot, AFigureThatFailsLeavesTheOthers) {
  const std::string disks = WHIRL_SOURCE_DIR "/models/two_disk_mac.toml";
  ASSERT_EQ(whirl({"modes", disks, "--out", "whole.h5"}).status, 0);
  {
    const ResultReader from(folder / "whole.h5");
    ResultWriter to(folder / "d.h5");
    const auto copy = [&](const char* path, const std::string& of) {
      to.dataset(path, from.vector(path), {"", of, {""}});
    };
    to.dataset("/model", from.strings("/model"), {"", "model", {""}});
    to.attribute("/model", "path", disks);
    to.dataset("/arguments", std::vector<std::string>{"whirl", "modes"},
               {"", "command line", {""}});
    to.dataset("/points/z", Vec(Vec::LinSpaced(2, 0.0, 1.0)), {"m", "z", {""}});
    to.dataset("/points/node_name", std::vector<std::string>{"", ""}, {"", "name", {""}});
    to.dataset("/modes/number", from.integers("/modes/number"), {"", "number", {""}});
    to.dataset("/modes/eigenvalue", from.complex_vector("/modes/eigenvalue"),
               {"1/s", "eigenvalue", {""}});
    to.dataset("/modes/shape", from.complex_matrix("/modes/shape"), {"m", "shape", {"", ""}});
    copy("/modes/frequency", "frequency");
    copy("/modes/damping_ratio", "damping ratio");
    copy("/modes/log_decrement", "log decrement");
    copy("/modes/kappa", "axis ratio");
    to.dataset("/modes/whirl", from.strings("/modes/whirl"), {"", "whirl", {""}});
    to.commit();
  }
  const Outcome made = whirl({"report", "d.h5"});
  ASSERT_EQ(made.status, 0) << made.err;
  const json data = page_data(content(folder / "d.html"));
  ASSERT_EQ(data["results"][0]["figures"].size(), 1u);
  EXPECT_EQ(data["results"][0]["figures"][0]["kind"], "layout");
  EXPECT_TRUE(has(data["results"][0]["warnings"].dump(), "no figure \\\"modes\\\": "))
      << data["results"][0]["warnings"];
  const Outcome list = whirl({"plot", "d.h5"});
  EXPECT_EQ(list.status, 0);
  EXPECT_TRUE(has(list.out, "modes cannot be drawn: ")) << list.out;
  EXPECT_TRUE(has(list.out, "layout"));
}

// What a model's text says cannot leave the place where it is shown.
TEST_F(Plot, APageHoldsTextsAsTexts) {
  write("evil.toml",
        std::string("# </script><script>alert(1)</script> <!-- {{script}} {{x\n") + jeffcott);
  make({"modes", "evil.toml", "--speed", "100rad/s"}, "e.h5");
  write("bold.toml",
        std::regex_replace(std::string(jeffcott), std::regex("Jeffcott rotor"), "<b>x</b>"));
  make({"campbell", "evil.toml"}, "c.h5");
  make({"campbell", "bold.toml"}, "b.h5");
  ASSERT_EQ(whirl({"report", "b.h5", "c.h5"}).status, 0);
  const std::string page = content(folder / "b.html");
  EXPECT_FALSE(has(page, "<script>alert"));
  EXPECT_TRUE(has(page, "\\u003c!-- {{script}} {{x"));  // no place of the page
  EXPECT_TRUE(has(page, "\nbuild();\n"));               // where the script's end is
  EXPECT_TRUE(has(page, "<title>&lt;b&gt;x&lt;/b&gt;</title>"));
}

}  // namespace plot_test
}  // namespace whirl::test
