// plot: pictures of models and of linear results.

#include <fmt/format.h>

#include <regex>

#include "libfe/analyses/critical_map.hpp"
#include "libio/results/columns.hpp"
#include "tests/cli/plots.hpp"

namespace whirl::test {
namespace plot_test {

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
  // what is drawn is in the file
  const auto stored = read_result<CriticalMap>(view.file);
  const CriticalMap solved =
      critical_map_of(view.assembler->structure(), read_result<CriticalSpeeds>(view.file));
  EXPECT_EQ(stored.x, solved.x);
  EXPECT_EQ(stored.top, solved.top);
  ASSERT_EQ(stored.branches.size(), solved.branches.size());
  for (std::size_t i = 0; i < solved.branches.size(); ++i) {
    for (std::size_t k = 0; k < solved.x.size(); ++k) {
      const double speed = stored.branches[i].speed.at(k);
      EXPECT_TRUE(speed == solved.branches[i].speed[k] || std::isnan(speed)) << i << " " << k;
      EXPECT_EQ(std::isnan(speed), std::isnan(solved.branches[i].speed[k]));
    }
  }
  ASSERT_EQ(stored.curves.size(), 2u);
  EXPECT_EQ(stored.curves[1].name, "Kyy");
  EXPECT_EQ(stored.curves[1].stiffness, solved.curves[1].stiffness);
  ASSERT_EQ(stored.crossings.size(), crossings.y.size());
  for (std::size_t i = 0; i < crossings.y.size(); ++i) {
    EXPECT_EQ(stored.crossings[i].curve, solved.crossings[i].curve);
    EXPECT_EQ(stored.crossings[i].branch, solved.crossings[i].branch);
    EXPECT_EQ(stored.crossings[i].speed / rpm, crossings.y[i]);
  }
}

// The sag of a shaft between bearings: reactions bear the rotor's weight, the moment is zero at
// both ends and largest between.
TEST_F(Plot, ASagShowsReactionsAndMoments) {
  const std::string model = WHIRL_SOURCE_DIR "/models/two_disk_double_rub.toml";
  make({"static", model}, "s.h5");
  const ResultView view(folder / "s.h5");
  const std::vector<Figure> figures = figures_in("static", view);
  ASSERT_EQ(figures.size(), 1u);
  const Figure& f = figures.front();
  ASSERT_EQ(f.panels.size(), 4u);
  const Vec stress = view.file.vector("/static/bending_stress");
  EXPECT_NEAR(largest_of(named(f.panels[3], "bending").at(0).y), 1e-6 * stress.maxCoeff(),
              1e-9 * stress.maxCoeff());
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

// Journals bear the rotor, so their films are told and labeled; seals that bear next to nothing are
// told only.
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

// An isotropic rotor does not whirl backward by a forward force: rounding is neither a peak nor a
// line, beside a response or alone.
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

// Bearings of oil films are as long as they are, above and below the journals, which they leave
// room.
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
