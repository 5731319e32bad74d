// report: pages of results.

#include <cstring>
#include <map>
#include <regex>

#include "libdyn/linear/unbalance_study.hpp"
#include "libio/figures/comparison.hpp"
#include "libio/figures/figures.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/hdf5.hpp"
#include "tests/cli/pictures.hpp"

namespace whirl::test {
namespace report_test {

class Report : public Pictures {};

// A printed report is a PDF or none: where no program can print, nothing is written, not HTML under
// the name of a PDF, and the packages that can are named.
TEST_F(Report, WithoutAPrinterThereIsAnErrorAndNoFile) {
  make({"modes", "rub.toml"}, "m.h5");
  for (const char* name : {"m.pdf", "M.PDF"}) {
    const Outcome outcome = wait(start("sh", {"-c", "PATH=/nowhere " + std::string(WHIRL_PROGRAM) +
                                                        " report m.h5 --out " + name}));
    EXPECT_EQ(outcome.status, 2);
    EXPECT_TRUE(has(outcome.err, std::string("cannot write ") + name)) << outcome.err;
    EXPECT_TRUE(has(outcome.err, "Debian package chromium or weasyprint")) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder / name));
  }
}

// A browser that numbers no pages is not enough, and one that fails is told with its last words.
TEST_F(Report, ABrowserThatCannotPrintIsTold) {
  make({"modes", "rub.toml"}, "m.h5");
  const auto with_browser = [&](const std::string& script) {
    std::ofstream(folder / "chromium") << "#!/bin/sh\n" << script;
    std::filesystem::permissions(folder / "chromium", std::filesystem::perms::owner_all);
    for (const char* needed : {"timeout", "sh", "echo"}) {
      std::error_code ignored;
      std::filesystem::create_symlink(std::string("/usr/bin/") + needed, folder / needed, ignored);
    }
    const Outcome outcome = wait(
        start("sh", {"-c", "PATH=. " + std::string(WHIRL_PROGRAM) + " report m.h5 --out m.pdf"}));
    EXPECT_EQ(outcome.status, 2);
    EXPECT_FALSE(std::filesystem::exists(folder / "m.pdf"));
    return outcome.err;
  };
  EXPECT_TRUE(has(with_browser("echo Chromium 130.0.1\n"), "is of version 130, 131 or later"));
  EXPECT_TRUE(
      has(with_browser("case $1 in --version) echo Chromium 140.0.1;; *) echo no room; exit "
                       "7;; esac\n"),
          "chromium failed: no room"));
}

// The head of a page is that of the model's [report], and of --cover instead.
TEST_F(Report, APageHasTheWordsOfItsCover) {
  write("signed.toml",
        std::string(rubbing) + "[report]\ntitle = \"Rub <1>\"\nauthor = \"J. Jeffcott\"\n");
  make({"modes", "signed.toml"}, "m.h5");
  ASSERT_EQ(whirl({"report", "m.h5", "--cover", "revision=B", "--cover", "author=A. Stodola",
                   "--cover", "date=2026-11-29"})
                .status,
            0);
  const json cover = page_data(content(folder / "m.html"))["cover"];
  EXPECT_EQ(cover["title"], "Rub <1>");
  std::map<std::string, std::string> lines;
  for (const json& line : cover["lines"]) lines[line[0]] = line[1];
  EXPECT_EQ(lines["Author"], "A. Stodola");
  EXPECT_EQ(lines["Revision"], "B");
  EXPECT_EQ(lines["Date"], "2026-11-29");
  EXPECT_EQ(lines["Model, SHA-256"].size(), 64u);
  const Outcome wrong = whirl({"report", "m.h5", "--cover", "auther=A"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_TRUE(has(wrong.err, "--cover auther=A: expected KEY=VALUE")) << wrong.err;
  EXPECT_TRUE(has(wrong.err, "author, checked_by")) << wrong.err;
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

// A page needs nothing from outside, and holds every figure of all results with their data.
TEST_F(Report, AReportIsOneFile) {
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
  const json data = page_data(page);
  ASSERT_EQ(data["results"].size(), 2u);
  std::size_t figures = data["machine"]["figures"].size();  // of both
  for (const json& one : data["results"]) figures += one["figures"].size();
  EXPECT_EQ(figures, r["figures"]);
  const json &linear = data["results"][0], &motion = data["results"][1];
  EXPECT_EQ(motion["figures"][0]["kind"], "orbit");
  std::vector<std::string> facts;
  for (const json& fact : motion["facts"]) facts.push_back(fact[0]);
  EXPECT_EQ(facts,
            (std::vector<std::string>{"result", "model", "command", "made by", "made at",
                                      "computed with", "speed", "recorded", "cost", "rotor"}));
  EXPECT_TRUE(has(motion["model"], "clearance = \"0.5 mm\""));
  EXPECT_TRUE(motion["motion"].contains("motions"));
  EXPECT_FALSE(linear["motion"].contains("motions"));
  // program, style and libraries: below 1 MB
  EXPECT_LT(page.size() - data.dump().size(), 1'000'000u);
}

// A response to unbalance moves the page's rotor like a shaft: its cross-sections tilt with the
// slopes, theta_x = -dy/dz and theta_y = dx/dz, at the left end by those of the first element.
TEST_F(Report, AResponseTiltsThePagesRotorWithItsSlopes) {
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
  const json data = page_data(page);
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

// With oil films a response moves the page's rotor as the verb found it, with their stiffness and
// damping: without films this rotor floats, and its journals move less than half as far. Stations
// are all points in their order.
TEST_F(Report, AResponseOnOilFilmsMovesThePagesRotorAsTheVerbSays) {
  const std::string films = WHIRL_SOURCE_DIR "/models/two_disk_oil_film.toml";
  make({"unbalance", films, "--speeds", "2600:3600:50rpm"}, "u.h5");
  ASSERT_EQ(whirl({"report", "u.h5"}).status, 0);
  const json data = page_data(content(folder / "u.html"));
  const json& motions = data["results"][0]["motion"]["motions"];
  ASSERT_EQ(motions.size(), 1u);
  EXPECT_EQ(motions[0]["name"], "Unbalance response at 3050 rpm");
  const auto part = [&](const char* key) {
    return numbers_of(data["arrays"][motions[0][key].get<std::size_t>()]);
  };
  const std::vector<double> re = part("re"), im = part("im");
  const auto study = read_result<UnbalanceStudy>(ResultReader(folder / "u.h5"));
  const auto at = std::find_if(study.speeds.begin(), study.speeds.end(),
                               [](double speed) { return std::abs(speed - 3050.0 * rpm) < 1e-6; });
  ASSERT_NE(at, study.speeds.end());
  const auto k = at - study.speeds.begin();
  ASSERT_EQ(re.size(), 4 * study.stations.size());
  constexpr double rounding = 1e-9;  // of the same equations, with the equilibrium found again
  for (std::size_t i = 0; i < study.stations.size(); ++i) {
    const StationResponse& s = study.stations[i];
    const double near = rounding * std::abs(s.major(k));
    EXPECT_LE(std::abs(Complex(re[4 * i], im[4 * i]) - s.x(k)), near) << s.label;
    EXPECT_LE(std::abs(Complex(re[4 * i + 1], im[4 * i + 1]) - s.y(k)), near) << s.label;
  }
}

// Two runs over each other: what was changed is said, and every curve of both is there, in the
// units of the first, although the second one's motion is so small that it is shown in others.
TEST_F(Report, AReportComparesResults) {
  for (const auto& [set, out] :
       {std::pair{"unbalance.1.offset=1mm", "a.h5"}, {"unbalance.1.offset=0.0001mm", "b.h5"}}) {
    make({"simulate", "rub.toml", "--set", set, "--revolutions", "8", "--discard", "40"}, out);
  }
  const json r = result({"report", "a.h5", "b.h5"});
  const std::string page = content(folder / "a.html");
  const json data = page_data(page);
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

// Analyses of one model are one report of one machine, drawn once, in the order of a report; other
// speeds are no other machine. Another model, or a verb twice, is compared.
TEST_F(Report, AnalysesOfOneModelAreOneReport) {
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

// Nodes of another model than that of the file, as of files that were put together: the page says
// which figure failed and why, and draws the others.
TEST_F(Report, AFigureThatFailsLeavesTheOthers) {
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
TEST_F(Report, APageHoldsTextsAsTexts) {
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

}  // namespace report_test
}  // namespace whirl::test
