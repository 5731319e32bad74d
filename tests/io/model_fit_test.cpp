// Values of models found in records that were read.

#include "libio/measured/model_fit.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <complex>
#include <fstream>
#include <numbers>

#include "libio/model/model_file.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::model_fit_test {

using ModelFit = test::InResultFolder;

constexpr double m = 2.0, k = 2e4, c = 40.0, e = 1e-4, Omega = 90.0;  // SI

/// A body on an isotropic spring, of another stiffness than that of the record, with two probes.
Model model_with(double damping) {
  return parse_model(
      fmt::format("format = 1\n[operation]\nspeed = {}\n[[body]]\nname = \"rotor\"\nmass = {}\n"
                  "spins = true\n[[bearing]]\nname = \"shaft\"\nbody = \"rotor\"\nstiffness = {}\n"
                  "damping = {}\n[[unbalance]]\nbody = \"rotor\"\noffset = {}\n"
                  "[[probe]]\nname = \"x\"\nbody = \"rotor\"\nangle = 0\n"
                  "[[probe]]\nname = \"y\"\nbody = \"rotor\"\nangle = \"90 deg\"\n",
                  Omega, m, 1.1 * k, damping, e),
      "m.toml");
}

// x + i y = e m Omega^2 / (k - m Omega^2 + i c Omega) e^(i Omega t), which the first model explains
// with one stiffness. The file is gone before the first of the fits.
TEST_F(ModelFit, TakesRecordsThatWereReadOnce) {
  const std::complex<double> size =
      e * m * Omega * Omega / std::complex<double>(k - m * Omega * Omega, c * Omega);
  const auto csv = folder / "run.csv";
  {
    std::ofstream file(csv);
    file << "time [s],x [m],y [m]\n";
    for (int j = 0; j < 160; ++j) {
      const double t = 0.0025 * j;
      const std::complex<double> z = size * std::polar(1.0, Omega * t);
      file << fmt::format("{:.4f},{:.12e},{:.12e}\n", t, z.real(), z.imag());
    }
  }
  const auto records = read_records({.file = csv.string()});
  ASSERT_EQ(records.size(), 1u);
  std::filesystem::remove(csv);
  std::vector<double> left;
  for (const double damping : {c, 3.0 * c}) {
    const Model model = model_with(damping);
    const auto free = free_parameters({model}, "bearing.shaft.stiffness").front();
    EXPECT_GE(free.parameters[0].lower, 0.0);
    EXPECT_LT(free.parameters[0].lower, 1e-3 * free.parameters[0].start);
    EXPECT_TRUE(free.parameters[0].is_lower_general);
    const MeasuredFit found =
        fit_model(model, free, records, {.revolutions = 4.0},
                  {.noise = ProbeNoise{1e-3, true}, .search = {.most_iterations = 30}})
            .found;
    left.push_back(found.residual);
    if (damping == c) {
      EXPECT_NEAR(found.parameters.at(0).value, k, 1e-3 * k);
    }
  }
  EXPECT_LT(left[0], 1e-2);
  EXPECT_GT(left[1], 1.0);
}

// Two revolutions are the least that is documented, whatever a speed does to the last bit of their
// time.
TEST(FitSpan, TwoRevolutionsAreEnough) {
  constexpr double rate = 5000.0;
  for (int i = 0; i < 200; ++i) {
    ProbeReadings readings{.rate = rate, .start = 0.137 * i};
    readings.displacement = Mat::Zero(5000, 1);
    std::vector<std::string> notes;
    const double speed = 100.0 + 1.7 * i;
    FitSpan span;
    EXPECT_NO_THROW(span = fit_span(readings, speed, 3.0, 2.0, notes)) << speed;
    EXPECT_NEAR(static_cast<double>(span.samples - 1) / rate * speed, 4.0 * std::numbers::pi,
                2.0 * speed / rate);
  }
  ProbeReadings readings{.rate = rate};
  readings.displacement = Mat::Zero(5000, 1);
  std::vector<std::string> notes;
  EXPECT_THROW(fit_span(readings, 100.0, 3.0, 1.99, notes), OptionError);
}

}  // namespace whirl::model_fit_test
