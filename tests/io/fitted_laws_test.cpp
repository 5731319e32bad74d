// Responses of supports beside the laws that were fitted to them.

#include "libio/model/fitted_laws.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "libio/model/model_file.hpp"

namespace whirl::fitted_laws_test {

Complex pedestal(Complex s) {
  return 1e6 - 1e12 / (4.0 * s * s + 500.0 * s + 5e6);
}

constexpr int samples = 40;
constexpr double step = 40.0;  ///< [rad/s]

/// A part of the response that no law of two poles has, of either sign by turns.
double noise(int k, double size) {
  return k % 2 == 0 ? size : -size;
}

Model model(double noise_size, const std::string& more = "") {
  std::string text =
      "format = 1\n[[body]]\nname = \"disk\"\nmass = 10\n[[support]]\nname = \"free\"\nbody = "
      "\"disk\"\nD = [[1e6]]\nangle = 0\n[[support]]\nname = \"pedestal\"\nbody = \"disk\"\n" +
      more + "response = \"\"\"\nfrequency [rad/s], real, imaginary\n";
  for (int k = 1; k <= samples; ++k) {
    const Complex K = pedestal(Complex(0.0, step * k)) * (1.0 + noise(k, noise_size));
    text += fmt::format("{}, {}, {}\n", step * k, K.real(), K.imag());
  }
  return parse_model(text + "\"\"\"\n");
}

TEST(FittedLaws, SamplesAndLawAreThoseOfThePedestal) {
  // what stands beside the law is none of it
  const SupportFits found = fitted_laws(model(0.0, "stiffness = 1e5\ndamping = 30\n"));
  ASSERT_EQ(found.fits.size(), 1u);
  EXPECT_EQ(found.fits[0].name, "pedestal");
  EXPECT_EQ(found.fits[0].poles, 2);
  ASSERT_EQ(found.samples.size(), static_cast<std::size_t>(samples));
  ASSERT_EQ(found.curve.size(), 4u * (samples - 1) + 1u);
  for (const auto& [points, within] :
       {std::pair(&found.samples, 1e-15), std::pair(&found.curve, 1e-9)}) {
    for (std::size_t k = 0; k < points->size(); ++k) {
      const StiffnessPoint& p = (*points)[k];
      const Complex K = pedestal(Complex(0.0, p.frequency));
      EXPECT_LT(std::abs(p.value() - K), within * std::abs(K)) << p.frequency;
      EXPECT_EQ(p.support + p.row + p.column, 0);
    }
  }
  EXPECT_EQ(found.samples[2].frequency, 3.0 * step);
  EXPECT_EQ(found.curve[1].frequency, 1.25 * step);
  EXPECT_EQ(found.curve.back().frequency, samples * step);
}

// Samples that jump by a share are left by a share, and the error is that of what is drawn.
TEST(FittedLaws, ErrorIsThatOfTheCurves) {
  const SupportFits found = fitted_laws(model(1e-3, "order = 2\n"));
  const SupportFit& fit = found.fits.at(0);
  double sum = 0.0, largest = 0.0, largest_at = 0.0;
  for (std::size_t k = 0; k < found.samples.size(); ++k) {
    const Complex told = found.samples[k].value(), law = found.curve[4 * k].value();
    const double left = std::abs(law - told) / std::abs(told);
    sum += left * left / samples;
    if (left > largest) largest_at = found.samples[k].frequency;
    largest = std::max(largest, left);
  }
  EXPECT_NEAR(fit.error, std::sqrt(sum), 1e-12);
  EXPECT_NEAR(fit.largest, largest, 1e-12);
  EXPECT_EQ(fit.largest_at, largest_at);
  EXPECT_NEAR(fit.error, 1e-3, 2e-4);
  EXPECT_EQ(fit.samples, samples);
}

TEST(FittedLaws, ModelsWithoutResponsesHaveNone) {
  EXPECT_TRUE(fitted_laws(parse_model("format = 1\n[[body]]\nname = \"disk\"\nmass = 10\n"
                                      "[[support]]\nbody = \"disk\"\nD = [[1e6]]\nangle = 0\n"))
                  .fits.empty());
}

}  // namespace whirl::fitted_laws_test
