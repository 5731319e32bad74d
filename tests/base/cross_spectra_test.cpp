// Cross spectra of what is known in closed form: tones, delays, and energy.

#include "libbase/numerics/cross_spectra.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/random_response.hpp"

namespace whirl::cross_spectra_test {

constexpr double pi = std::numbers::pi;

// The integral of G_aa over frequency is the variance of a channel, whatever its spectrum.
TEST(CrossSpectra, HoldTheVarianceOfEachChannel) {
  std::mt19937_64 random(1);
  const Mat x = test::normal_numbers(random, 60000, 2) * Vec2(1.0, 3.0).asDiagonal();
  const CrossSpectra s = cross_spectra(x, 0.01, 500);
  CMat sum = CMat::Zero(2, 2);
  for (const CMat& G : s.matrix) sum += G * s.bin / (2.0 * pi);
  EXPECT_GT(s.segments, 200);
  EXPECT_NEAR(sum(0, 0).real(), 1.0, 0.02);
  EXPECT_NEAR(sum(1, 1).real(), 9.0, 0.2);
  EXPECT_LT(std::abs(sum(0, 1)), 0.05);
}

// A tone A cos(w t) of a line's frequency has all of its variance A^2 / 2 in three lines; a channel
// that is a quarter of a period late has the phase pi / 2 against it, G_ab = X_a conj(X_b).
TEST(CrossSpectra, ShowToneAndPhase) {
  const double spacing = 0.01;
  const double omega = 2.0 * pi * 5.0;
  Mat x(4000, 2);
  for (int t = 0; t < x.rows(); ++t) {
    x(t, 0) = 2.0 * std::cos(omega * spacing * t) + 7.0;  // the mean does not count
    x(t, 1) = 0.5 * std::cos(omega * spacing * t - 0.5 * pi);
  }
  const CrossSpectra s = cross_spectra(x, spacing, 400);
  const auto k = static_cast<std::size_t>(std::lround(omega / s.bin));
  double power = 0.0;
  for (std::size_t i = k - 1; i <= k + 1; ++i)
    power += s.matrix[i](0, 0).real() * s.bin / (2.0 * pi);
  EXPECT_NEAR(power, 2.0, 1e-9);
  EXPECT_NEAR(std::arg(s.matrix[k](0, 1)), 0.5 * pi, 1e-9);
  EXPECT_NEAR(std::norm(s.matrix[k](0, 1)), s.matrix[k](0, 0).real() * s.matrix[k](1, 1).real(),
              1e-9);
}

}  // namespace whirl::cross_spectra_test
