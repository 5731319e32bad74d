// Running modes in files, as text and as a figure.

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "libdata/measured/running_modes.hpp"
#include "libio/figures/figures.hpp"
#include "libio/results/columns.hpp"
#include "libio/texts/running_modes_text.hpp"
#include "tests/io/result_folder.hpp"
#include "tests/support/random_response.hpp"

namespace whirl::running_modes_result_test {

constexpr double hertz = 2.0 * std::numbers::pi;

/// Two masses with a speed between their modes.
RunningModes example() {
  const auto chain = test::mass_chain(2, 1.0, 4000.0, 0.02);
  std::mt19937_64 random(4);
  const double spacing = 0.01, Omega = 9.0 * hertz;
  Mat record = test::random_response(chain.M, chain.C, chain.K, spacing, 30000, random);
  const double size = record.col(0).norm() / std::sqrt(30000.0);
  for (Eigen::Index t = 0; t < record.rows(); ++t) {
    record(t, 0) += size * std::cos(Omega * spacing * static_cast<double>(t));
  }
  return running_modes(record, spacing,
                       {.channels = {"disk x", "seal x"},
                        .most_order = 24,
                        .stretches = 4,
                        .speed = Omega,
                        .harmonics = 3,
                        .removes_harmonics = false});
}

class RunningModesResult : public test::InResultFolder {
 protected:
  void write(const RunningModes& found) const {
    ResultWriter file(path, Replaces::anything);
    file.dataset("/model",
                 std::vector<std::string>{"format = 1\n[[body]]\nname = \"a\"\nmass = 1\n"}, {});
    file.attribute("/", "format", 1);
    write_result(file, found);
    file.commit();
  }
};

TEST_F(RunningModesResult, ComesBackFromItsFile) {
  const RunningModes found = example();
  ASSERT_EQ(found.modes.size(), 2u);
  write(found);
  const ResultReader file(path);
  const auto back = read_result<RunningModes>(file);
  EXPECT_EQ(back.channels, found.channels);
  EXPECT_EQ(back.speed, found.speed);
  EXPECT_EQ(back.most_order, found.most_order);
  EXPECT_EQ(back.singular_values, found.singular_values);
  ASSERT_EQ(back.modes.size(), found.modes.size());
  EXPECT_EQ(back.modes[1].lambda, found.modes[1].lambda);
  EXPECT_EQ(back.modes[1].shape, found.modes[1].shape);
  EXPECT_EQ(back.modes[1].frequency_deviation, found.modes[1].frequency_deviation);
  ASSERT_EQ(back.poles.size(), found.poles.size());
  for (std::size_t i = 0; i < found.poles.size(); ++i) {
    EXPECT_EQ(back.poles[i].mode, found.poles[i].mode);
    EXPECT_EQ(back.poles[i].harmonic, found.poles[i].harmonic);
    EXPECT_EQ(back.poles[i].is_stable(), found.poles[i].is_stable());
  }
}

TEST_F(RunningModesResult, IsToldToPeopleAndPrograms) {
  const RunningModes found = example();
  const std::string text = text_of(found);
  EXPECT_NE(text.find("frequency [Hz]"), std::string::npos) << text;
  EXPECT_NE(text.find(" ± "), std::string::npos) << text;
  EXPECT_NE(text.find("3 harmonics of 540 rpm marked"), std::string::npos) << text;
  RunningModes nothing = found;
  nothing.modes.clear();
  EXPECT_NE(text_of(nothing).find("none: no pole is stable"), std::string::npos);

  const std::string json = record_of(found).json();
  for (const char* key : {"\"running_modes\"", "\"frequency_rpm\"", "\"damping_ratio\"",
                          "\"frequency_deviation_rpm\"", "\"shape\"", "\"decomposed\""}) {
    EXPECT_NE(json.find(key), std::string::npos) << key;
  }
  EXPECT_EQ(json.find("\"poles\""), std::string::npos);
}

TEST_F(RunningModesResult, IsDrawnWithItsPolesAndHarmonics) {
  const RunningModes found = example();
  write(found);
  const ResultView view(path);
  const auto& kinds = figure_kinds();
  const auto kind = std::find_if(kinds.begin(), kinds.end(),
                                 [](const FigureKind& k) { return k.name == "stabilization"; });
  ASSERT_NE(kind, kinds.end());
  const std::vector<Figure> figures = figures_of(*kind, view);
  ASSERT_EQ(figures.size(), 2u);
  const Panel& orders = figures[0].panels.at(1);
  std::size_t drawn = 0;
  bool has_harmonics = false;
  for (const Curve& c : orders.curves) {
    if (c.has_marker) drawn += c.x.size();
    if (c.name != "harmonic of the speed") continue;
    has_harmonics = true;
    for (const double x : c.x) EXPECT_NEAR(std::remainder(x, 9.0), 0.0, 0.3);
  }
  EXPECT_TRUE(has_harmonics);
  EXPECT_EQ(drawn, found.poles.size());
  EXPECT_EQ(figures[0].table.rows.size(), 2u);
  EXPECT_EQ(figures[1].variant, "damping");
}

}  // namespace whirl::running_modes_result_test
