// Runout that is found with the values of a model, and deviations where the model does not explain
// a record.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "libbase/numerics/random.hpp"
#include "tests/cli/program.hpp"

namespace whirl::test {
namespace fit_runout_test {

constexpr double m = 2.0, k = 2e4, c = 20.0, e = 1e-4;  // SI
constexpr double pi = std::numbers::pi;

struct Vector {
  const char* probe;
  int order;
  double amplitude, phase_deg;  // [um]
};
const std::vector<Vector> runout{
    {"x", 1, 8.0, 40.0}, {"x", 2, 3.0, -100.0}, {"y", 1, 5.0, 160.0}, {"y", 2, 2.0, 10.0}};

/// A body on an isotropic spring, below and above its critical speed, by its closed form
/// x + i y = e m Omega^2 / (k - m Omega^2 + i c Omega) e^(i Omega t).
class FitRunout : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("m.toml",
          fmt::format(
              "format = 1\n[operation]\nspeed = 90\n[[body]]\nname = \"rotor\"\nmass = {}\n"
              "spins = true\n[[bearing]]\nname = \"shaft\"\nbody = \"rotor\"\nstiffness = {}\n"
              "damping = {}\n[[unbalance]]\nbody = \"rotor\"\noffset = {}\n",
              m, 1.1 * k, c, e));
    write("probes.toml",
          "[[probe]]\nname = \"x\"\nbody = \"rotor\"\nangle = 0\nunit = \"um\"\n"
          "[[probe]]\nname = \"y\"\nbody = \"rotor\"\nangle = \"90 deg\"\nunit = \"um\"\n"
          "[keyphasor]\nchannel = \"key\"\n");
    write("records.toml", "[[record]]\nfile = \"slow.csv\"\n[[record]]\nfile = \"fast.csv\"\n");
    record("slow.csv", 60.0, 1);
    record("fast.csv", 120.0, 2);
  }

  void record(const std::string& file, double Omega, unsigned seed) const {
    constexpr double noise = 0.1;  // [um]
    const std::complex<double> size =
        1e6 * e * m * Omega * Omega / std::complex<double>(k - m * Omega * Omega, c * Omega);
    std::mt19937_64 random(seed);
    std::string text = "time [s],x [um],y [um],key\n";
    for (int j = 0; j < 1600; ++j) {
      const double t = 0.001 * j, angle = Omega * t;
      const std::complex<double> z = size * std::polar(1.0, angle);
      double readings[]{z.real() + noise * random_normal(random),
                        z.imag() + noise * random_normal(random)};
      for (const Vector& v : runout) {
        readings[v.probe[0] == 'y'] +=
            v.amplitude * std::cos(v.order * angle + v.phase_deg * pi / 180.0);
      }
      const double turns = angle / (2.0 * pi), behind = turns + 0.5 - std::floor(turns + 0.5) - 0.5;
      const double key =
          std::clamp(0.5 + behind * 10.0, 0.0, 1.0) - std::clamp((behind - 0.2) * 10.0, 0.0, 1.0);
      text += fmt::format("{:.3f},{:.6f},{:.6f},{:.6f}\n", t, readings[0], readings[1], key);
    }
    write(file, text);
  }

  json found(const std::vector<std::string>& more) const {
    std::vector<std::string> words{"fit",        "m.toml",
                                   "--measured", "records.toml",
                                   "--probes",   "probes.toml",
                                   "--free",     "bearing.shaft.stiffness",
                                   "--json",     "-"};
    words.insert(words.end(), more.begin(), more.end());
    return whirl(words).tree();
  }
};

TEST_F(FitRunout, IsFoundWithTheValuesOfTheModel) {
  const json tree = found({"--runout", "2"});
  ASSERT_TRUE(tree.at("converged").get<bool>()) << tree;
  ASSERT_EQ(tree.at("parameters").size(), 1u);
  const json& stiffness = tree.at("parameters")[0];
  EXPECT_NEAR(stiffness.at("value"), k, 4.0 * stiffness.at("standard_deviation").get<double>());
  EXPECT_LT(stiffness.at("standard_deviation"), 1e-3 * k);
  const json& vectors = tree.at("runouts");
  ASSERT_EQ(vectors.size(), runout.size());
  for (std::size_t i = 0; i < runout.size(); ++i) {
    EXPECT_EQ(vectors[i].at("probe"), runout[i].probe);
    EXPECT_EQ(vectors[i].at("order"), runout[i].order);
    const double deviation = vectors[i].at("standard_deviation_m");
    EXPECT_LT(deviation, 0.1e-6);
    EXPECT_NEAR(vectors[i].at("amplitude_m"), 1e-6 * runout[i].amplitude, 4.0 * deviation);
    EXPECT_NEAR(vectors[i].at("phase_rad"), runout[i].phase_deg * pi / 180.0,
                4.0 * deviation / (1e-6 * runout[i].amplitude));
  }
  EXPECT_DOUBLE_EQ(tree.at("spread"), 1.0);
}

// Without it the model is wrong by micrometers: its deviations are those of what it leaves, not of
// noise.
TEST_F(FitRunout, LeftOutItMakesDeviationsLarger) {
  const json tree = found({});
  const json& stiffness = tree.at("parameters")[0];
  EXPECT_GT(tree.at("spread"), 2.0);
  EXPECT_NEAR(stiffness.at("value"), k, 4.0 * stiffness.at("standard_deviation").get<double>());
  EXPECT_TRUE(has(tree.at("notes").dump(), "hangs together over")) << tree.at("notes");
  EXPECT_TRUE(tree.at("runouts").empty());
  const json known = found({"--noise", "0.1um"});
  EXPECT_FALSE(known.at("converged").get<bool>());
  EXPECT_GT(known.at("spread"), known.at("residual"));
}

}  // namespace fit_runout_test
}  // namespace whirl::test
