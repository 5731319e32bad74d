// check and plot: a pedestal whose law is fitted to a hammer test.

#include <cmath>
#include <fstream>

#include "libbase/numerics/constants.hpp"
#include "tests/cli/plots.hpp"

namespace whirl::test {
namespace plot_test {

const std::string pedestal = WHIRL_SOURCE_DIR "/tests/data/pedestal/";

/// Accelerances over force in the file, as its lines have them.
std::vector<Complex> accelerances() {
  std::ifstream file(pedestal + "hammer.uff");
  std::vector<Complex> all;
  int line_number = 0;
  constexpr int first_line = 20;
  for (std::string line; std::getline(file, line);) {
    if (++line_number < first_line || line == "    -1") continue;
    for (std::size_t at = 0; at + 26 <= line.size(); at += 26) {
      all.emplace_back(std::stod(line.substr(at, 13)), std::stod(line.substr(at + 13, 13)));
    }
  }
  return all;
}

TEST_F(Plot, AFitHasItsSamplesAndTheLaw) {
  const json r = result({"check", pedestal + "pedestal.toml", "--out", "fit.h5"});
  ASSERT_EQ(r["support_fits"].size(), 1u);
  const json& fit = r["support_fits"][0];
  EXPECT_EQ(fit["name"], "pedestal");
  EXPECT_EQ(fit["samples"], 160);
  EXPECT_EQ(fit["poles"], 2);
  // noise of 0.4 % in both parts
  EXPECT_NEAR(fit["error"].get<double>(), 0.004 * std::sqrt(2.0), 5e-4);

  const ResultView view(folder / "fit.h5");
  const auto figures = figures_in("support_fit", view);
  ASSERT_EQ(figures.size(), 1u);
  EXPECT_EQ(figures[0].variant, "pedestal");
  const auto samples = named(figures[0].panels.at(0), "samples"),
             phases = named(figures[0].panels.at(1), "samples"),
             law = named(figures[0].panels.at(0), "law");
  ASSERT_EQ(samples.size(), 1u);
  ASSERT_EQ(law.size(), 1u);
  const std::vector<Complex> told = accelerances();
  ASSERT_EQ(told.size(), 160u);
  ASSERT_EQ(samples[0].y.size(), told.size());
  ASSERT_EQ(law[0].y.size(), 4 * told.size() - 3);
  // N/m in the unit that is shown, a power of ten
  const double first = std::pow(2.0 * hertz, 2) / std::abs(told[0]);
  const double unit = std::pow(10.0, std::round(std::log10(samples[0].y[0] / first)));
  for (std::size_t k = 0; k < told.size(); ++k) {
    const Complex s{0.0, 2.0 * static_cast<double>(k + 1) * hertz};
    const Complex K = s * s / told[k];
    EXPECT_NEAR(samples[0].y[k], unit * std::abs(K), 1e-12 * unit * std::abs(K));
    EXPECT_NEAR(phases[0].y[k], std::arg(K) / degree, 1e-9);
    const Complex right = 1e6 - 1e12 / (4.0 * s * s + 500.0 * s + 5e6);
    EXPECT_NEAR(law[0].y[4 * k], unit * std::abs(right), 0.01 * unit * std::abs(right)) << k;
  }
  ASSERT_EQ(whirl({"plot", "fit.h5", "support_fit"}).status, 0);
}

}  // namespace plot_test
}  // namespace whirl::test
