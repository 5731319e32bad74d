// Samples of a smooth force on a periodic motion: their sums are Fourier integrals, in closed form
// of a cubic spring and a damper.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "libdyn/system/port_forces.hpp"

namespace whirl::smooth_force_test {

using std::numbers::pi;

constexpr double rounding = 1e-12;

/// x = A cos theta with a period of some revolutions and a number of harmonics.
Periodic cosine(double A, int harmonics, int period = 1, double rate = 1.0) {
  Periodic motion{Mat::Zero(1, 2 * harmonics + 1), period, rate};
  motion.coefficients(0, 1) = A;
  return motion;
}

/// g = x^3 + c x', with its slopes.
PortForces spring(double c) {
  return smooth_force("spring", Mat::Ones(1, 1), Mat::Ones(1, 1),
                      [c](double, const PortVec& u, const PortVec& rate, PortSample& s) {
                        s.g(0) = u(0) * u(0) * u(0) + c * rate(0);
                        s.by_u(0, 0) = 3.0 * u(0) * u(0);
                        s.by_rate(0, 0) = c;
                        return true;
                      });
}

TEST(SmoothForce, HasEnoughEvenInstants) {
  for (const int harmonics : {1, 5, 40}) {
    for (const int period : {1, 3}) {
      const int N = even_instants(cosine(1.0, harmonics, period), 8);
      EXPECT_GE(N, 8 * harmonics);
      EXPECT_GE(N, 4 * period);
    }
  }
  EXPECT_GE(even_instants(cosine(1.0, 40), 16), 640);
}

// A^3 cos^3 = A^3 (3 cos + cos 3) / 4; c x' = -c A w sin with w the rate over the period.
TEST(SmoothForce, HasSamplesWhoseSumsAreFourierIntegrals) {
  const double A = 1.3, c = 0.4, rate = 50.0;
  for (const int period : {1, 2}) {
    const PortForces force = spring(c);
    EXPECT_EQ(force.name, "spring");
    std::vector<PortSample> samples;
    ASSERT_TRUE(force.sample(cosine(A, 3, period, rate), samples));
    double all = 0.0, cosine_1 = 0.0, sine_1 = 0.0, cosine_3 = 0.0, slope = 0.0, of_rate = 0.0;
    for (const PortSample& s : samples) {
      EXPECT_GE(s.theta, 0.0);
      EXPECT_LT(s.theta, 2.0 * pi);
      all += s.share;
      cosine_1 += s.share * s.g(0) * std::cos(s.theta);
      sine_1 += s.share * s.g(0) * std::sin(s.theta);
      cosine_3 += s.share * s.g(0) * std::cos(3.0 * s.theta);
      slope += s.share * s.by_u(0, 0);
      of_rate += s.share * s.by_rate(0, 0);
    }
    const double size = A * A * A + c * A * rate;
    EXPECT_NEAR(all, 1.0, rounding);
    EXPECT_NEAR(cosine_1, 0.375 * A * A * A, rounding * size);
    EXPECT_NEAR(sine_1, -0.5 * c * A * rate / period, rounding * size);
    EXPECT_NEAR(cosine_3, 0.125 * A * A * A, rounding * size);
    EXPECT_NEAR(slope, 1.5 * A * A, rounding * size);
    EXPECT_NEAR(of_rate, c, rounding);
  }
}

// The phase goes through as many revolutions as the motion has.
TEST(SmoothForce, KnowsThePhase) {
  std::vector<double> phases;
  const PortForces force =
      smooth_force("phase", Mat::Ones(1, 1), Mat::Ones(1, 1),
                   [&](double phase, const PortVec&, const PortVec&, PortSample&) {
                     phases.push_back(phase);
                     return true;
                   });
  std::vector<PortSample> samples;
  ASSERT_TRUE(force.sample(cosine(1.0, 1, 3), samples));
  ASSERT_EQ(phases.size(), samples.size());
  for (std::size_t i = 0; i < phases.size(); ++i) {
    EXPECT_NEAR(phases[i], 3.0 * samples[i].theta, rounding * 20.0);
    EXPECT_TRUE(samples[i].g.isZero(0.0));  // a law that fills nothing has no force
    EXPECT_TRUE(samples[i].by_u.isZero(0.0));
  }
}

// As outside an oil film.
TEST(SmoothForce, IsNoneWhereItsLawHasNone) {
  const PortForces force = smooth_force(
      "film", Mat::Ones(1, 1), Mat::Ones(1, 1),
      [](double, const PortVec& u, const PortVec&, PortSample&) { return std::abs(u(0)) < 1.0; });
  std::vector<PortSample> samples;
  EXPECT_TRUE(force.sample(cosine(0.9, 1), samples));
  samples.clear();
  EXPECT_FALSE(force.sample(cosine(1.1, 1), samples));
}

}  // namespace whirl::smooth_force_test
