// Signed spectra, their peaks between the bins, and both frames.

#include "libbase/numerics/spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "libdyn/motions/response.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::spectrum_test {

using test::MassInRing;
using test::pi;

/// Samples of sum a e^(i w t).
CVec tones(const std::vector<std::pair<Complex, double>>& parts, Eigen::Index n, double spacing) {
  CVec z = CVec::Zero(n);
  for (const auto& [a, w] : parts) {
    for (Eigen::Index j = 0; j < n; ++j)
      z(j) += a * std::polar(1.0, w * spacing * static_cast<double>(j));
  }
  return z;
}

TEST(SmoothLength, HasNoPrimeFactorAboveFive) {
  EXPECT_EQ(smooth_length(512), 512);
  EXPECT_EQ(smooth_length(511), 500);
  EXPECT_EQ(smooth_length(7), 6);
  EXPECT_EQ(smooth_length(1), 1);
  for (long n = 2; n < 300; ++n) {
    long rest = smooth_length(n);
    EXPECT_LE(rest, n);
    for (const long p : {2L, 3L, 5L}) {
      while (rest % p == 0) rest /= p;
    }
    EXPECT_EQ(rest, 1) << n;
  }
}

// Circles on bins: a forward and a backward one keep sign, amplitude and phase; a constant is the
// line at zero. The window spreads a line to both neighbors at half its size, and no further.
TEST(HannSpectrum, HasForwardAndBackwardCirclesWithTheirSigns) {
  constexpr Eigen::Index n = 480;
  const double spacing = 1e-3, bin = 2.0 * pi / (n * spacing);
  const Complex forward(3.0, 1.0), backward(0.0, -2.0), mean(0.5, 0.25);
  const Spectrum s = hann_spectrum(
      tones({{forward, 40.0 * bin}, {backward, -25.0 * bin}, {mean, 0.0}}, n, spacing), spacing);
  constexpr double rounding = 1e-12;
  EXPECT_NEAR(s.bin, bin, rounding * bin);
  EXPECT_EQ(s.size(), n);
  EXPECT_LT(std::abs(s.at(40) - forward), rounding);
  EXPECT_LT(std::abs(s.at(-25) - backward), rounding);
  EXPECT_LT(std::abs(s.at(0) - mean), rounding);
  EXPECT_LT(std::abs(s.at(41) + 0.5 * forward), rounding);
  for (const Eigen::Index k : {-40, 25, 42, 38, -27, 100}) EXPECT_LT(std::abs(s.at(k)), rounding);
}

// A tone anywhere between two bins is found where it is. The interpolation is exact but for the
// tone's image at negative and cyclic frequencies, of order (bin / frequency)^3.
TEST(FindPeaks, LocatesTonesBetweenTheBins) {
  constexpr Eigen::Index n = 1000;
  const double spacing = 1e-3, bin = 2.0 * pi / (n * spacing);
  for (const double sign : {1.0, -1.0}) {
    for (double offset = -0.5; offset < 0.5; offset += 0.0625) {
      const double w = sign * (100.0 + offset) * bin;
      const Spectrum s = hann_spectrum(tones({{Complex(2e-3, 0.0), w}}, n, spacing), spacing);
      const std::vector<Peak> peaks = find_peaks(s.lines.cwiseAbs(), s.bin, 0.01, 5);
      ASSERT_EQ(peaks.size(), 1u) << offset;
      EXPECT_NEAR(peaks[0].frequency, w, 1e-5 * bin) << offset;
      EXPECT_NEAR(peaks[0].amplitude, 2e-3, 1e-5 * 2e-3) << offset;
      EXPECT_LE(std::abs(static_cast<double>(peaks[0].bin) * bin - w), 0.5 * bin * (1.0 + 1e-9));
    }
  }
}

TEST(FindPeaks, SortsByAmplitudeAndLeavesOutWhatIsSmall) {
  constexpr Eigen::Index n = 500;
  const double spacing = 1e-2, bin = 2.0 * pi / (n * spacing);
  const Spectrum s = hann_spectrum(
      tones({{1.0, 30.3 * bin}, {3.0, -60.7 * bin}, {0.2, 90.0 * bin}, {0.02, 120.0 * bin}}, n,
            spacing),
      spacing);
  const auto peaks = [&](double share, int most) {
    return find_peaks(s.lines.cwiseAbs(), s.bin, share, most);
  };
  const std::vector<Peak> all = peaks(0.05, 10);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_NEAR(all[0].frequency, -60.7 * bin, 1e-3 * bin);
  EXPECT_NEAR(all[1].frequency, 30.3 * bin, 1e-3 * bin);
  EXPECT_NEAR(all[2].frequency, 90.0 * bin, 1e-3 * bin);
  EXPECT_EQ(peaks(0.05, 2).size(), 2u);
  EXPECT_EQ(peaks(0.5, 10).size(), 1u);
  EXPECT_TRUE(find_peaks(Vec::Zero(100), 1.0, 0.01, 5).empty());
  EXPECT_TRUE(find_peaks(Vec::Ones(4), 1.0, 0.01, 5).empty());  // too short
}

// ---- spectra of recordings ----------------------------------------------------------------------

/// A recording of a mass whose place is a sum of circles about a mean.
Recording recording_of(const Scene& scene, const std::vector<std::pair<Complex, double>>& circles,
                       long revolutions) {
  Recording r{.samples = 16, .revolutions = revolutions, .clock = scene.contacts.clock()};
  const CVec z = tones(circles, revolutions * r.samples, r.spacing());
  r.eta.resize(2, z.size());
  r.eta << z.real().transpose(), z.imag().transpose();
  return r;
}

// Frequencies less Omega: what whirls with the spin stands still seen from the rotor, and what
// stands still turns backward there.
TEST(Response, HasThePeaksOfBothFrames) {
  const MassInRing p{.Omega = 100.0};
  const Scene scene = p.scene();
  const double w = 37.0;
  const ResponseSpectra spectra(
      scene, recording_of(scene, {{2e-4, 100.0}, {1e-4, -w}, {Complex(0.0, -5e-5), 0.0}}, 260));
  EXPECT_EQ(spectra.revolutions(), 256);
  const Point mass{Point::Kind::body, 0};
  EXPECT_LT(std::abs(spectra.mean(mass) - Complex(0.0, -5e-5)), 1e-6);  // 37 rad/s is off the bins
  const PointPeaks peaks = point_peaks(spectra, mass, p.Omega);
  ASSERT_EQ(peaks.stationary.size(), 2u);
  EXPECT_NEAR(peaks.stationary[0].frequency, 100.0, 1e-3 * spectra.bin());
  EXPECT_NEAR(peaks.stationary[0].amplitude, 2e-4, 1e-8);
  EXPECT_NEAR(peaks.stationary[1].frequency, -w, 1e-3 * spectra.bin());
  EXPECT_NEAR(peaks.stationary[1].amplitude, 1e-4, 1e-8);
  ASSERT_EQ(peaks.rotating.size(), 2u);
  EXPECT_NEAR(peaks.rotating[0].frequency, -w - 100.0, 1e-3 * spectra.bin());
  EXPECT_NEAR(peaks.rotating[1].frequency, -100.0, 1e-12);  // the mean
  EXPECT_NEAR(peaks.rotating[1].amplitude, 5e-5, 1e-6);
}

// A line along x is half a circle forward, half backward; amplitudes() give the whole of it.
TEST(Response, SplitsALineIntoTwoCircles) {
  const MassInRing p{.Omega = 100.0};
  const Scene scene = p.scene();
  const ResponseSpectra spectra(scene, recording_of(scene, {{1e-4, 50.0}, {1e-4, -50.0}}, 128));
  const auto bin = static_cast<Eigen::Index>(std::lround(50.0 / spectra.bin()));
  const Point mass{Point::Kind::body, 0};
  EXPECT_NEAR(std::abs(spectra.line(mass, bin)), 1e-4, 1e-15);
  EXPECT_NEAR(std::abs(spectra.line(mass, -bin)), 1e-4, 1e-15);
  EXPECT_NEAR(std::abs(spectra.amplitudes(bin)(0)), 2e-4, 1e-15);
  EXPECT_NEAR(std::abs(spectra.amplitudes(-bin)(1)), 0.0, 1e-15);
  EXPECT_NEAR(spectra.total()(bin), 1e-4, 1e-15);
}

}  // namespace whirl::spectrum_test
