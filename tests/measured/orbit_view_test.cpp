// Orbits at moments, mean positions and peaks of orders, against closed forms.

#include "libdata/measured/orbit_view.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "libbase/error.hpp"
#include "libbase/numerics/band_filter.hpp"
#include "libdata/measured/mean_path.hpp"
#include "libdata/measured/order_peaks.hpp"

namespace whirl::orbit_view_test {

constexpr double pi = std::numbers::pi;
constexpr Complex i_(0.0, 1.0);

/// A motion of a rotor whose speed rises evenly from f to f + r t [1/s], made of circles:
/// z = gap(t) + sum of a e^(i order angle).
struct Made {
  struct Circle {
    double order;  ///< < 0 backward
    Complex a;     ///< [m]
  };
  double f = 20.0, r = 0.0, duration = 4.0, rate = 4000.0;  ///< [1/s, 1/s^2, s, 1/s]
  std::vector<Circle> circles{};
  Complex gap{1.7e-3, -0.4e-3}, drift{};  ///< [m], [m/s]
  double tone = 0.0, tone_size = 0.0;     ///< of a line along x [rad/s], [m]
  StationMotion station{"x + y", {}, {}};
  std::vector<double> turns{};

  double angle(double t) const { return 2.0 * pi * (f * t + 0.5 * r * t * t); }
  Complex at(double t) const {
    Complex z = gap + drift * t + tone_size * std::cos(tone * t);
    for (const Circle& c : circles) z += c.a * std::polar(1.0, c.order * angle(t));
    return z;
  }
  TurnedMotion motion() {
    const auto n = static_cast<Eigen::Index>(duration * rate) + 1;
    Vec time = Vec::LinSpaced(n, 0.0, duration);
    station.x.resize(n);
    station.y.resize(n);
    for (Eigen::Index j = 0; j < n; ++j) {
      const Complex z = at(time(j));
      station.x(j) = z.real();
      station.y(j) = z.imag();
    }
    turns.clear();
    for (int k = 0; angle(duration) + 1e-9 >= 2.0 * pi * k; ++k) {
      turns.push_back(r == 0.0 ? k / f : (-f + std::sqrt(f * f + 2.0 * r * k)) / r);
    }
    std::vector<std::string> notes;
    return {std::move(time), {&station}, TurnClock(turns, {}, notes), true};
  }
};

// The gap is taken off, and the order of an ellipse is its two circles, whatever else there is:
// half the speed, harmonics, the gap itself.
TEST(OrbitView, FindsTheEllipseOfAnOrder) {
  Made made{
      .circles = {{1.0, 50e-6}, {-1.0, 20e-6 * std::polar(1.0, 0.7)}, {2.0, 15e-6}, {0.5, 12e-6}}};
  const TurnedMotion motion = made.motion();
  const StationOrbit first = orbit_at(motion, 0, 2.0, {.order = 1.0});
  EXPECT_NEAR(first.forward(), 50e-6, 1e-11);
  EXPECT_NEAR(first.backward(), 20e-6, 1e-11);
  EXPECT_NEAR(first.speed, 2.0 * pi * 20.0, 1e-6);
  EXPECT_NEAR(std::abs(first.gap - made.gap), 0.0, 1e-6);
  ASSERT_EQ(first.marks.size(), 1u);
  // at a pulse the angle is a multiple of a turn
  EXPECT_NEAR(std::abs(first.marks[0] - (made.circles[0].a + made.circles[1].a)), 0.0, 1e-11);
  const double major = (first.x.array().square() + first.y.array().square()).sqrt().maxCoeff();
  EXPECT_NEAR(major, 70e-6, 0.01e-6);  // of 240 points
  EXPECT_NEAR(orbit_at(motion, 0, 2.0, {.order = 2.0}).forward(), 15e-6, 1e-11);
  const StationOrbit half = orbit_at(motion, 0, 2.0, {.order = 0.5});
  EXPECT_NEAR(half.forward(), 12e-6, 1e-11);
  EXPECT_EQ(half.marks.size(), 2u);  // two revolutions until it closes
}

TEST(OrbitView, TakesTheMeanOffRawOrbitsAndMarksPulses) {
  Made made{.circles = {{1.0, 50e-6}}};
  const TurnedMotion motion = made.motion();
  const StationOrbit raw = orbit_at(motion, 0, 2.0, {.revolutions = 4.0});
  EXPECT_NEAR(raw.x.mean(), 0.0, 1e-12);
  EXPECT_EQ(raw.x.size(), 800);
  EXPECT_NEAR(raw.x.maxCoeff(), 50e-6, 1e-9);
  ASSERT_GE(raw.marks.size(), 4u);
  for (const Complex& mark : raw.marks) EXPECT_NEAR(std::abs(mark - 50e-6), 0.0, 1e-9);
}

// Speed that rises: the moment of a speed, and the order there.
TEST(OrbitView, FindsTheMomentOfASpeed) {
  Made made{.f = 10.0, .r = 2.0, .duration = 10.0, .circles = {{1.0, 30e-6 * i_}}};
  const TurnedMotion motion = made.motion();
  const double t = moment_of_speed(motion.clock, 2.0 * pi * 25.0);
  EXPECT_NEAR(t, 7.5, 1e-3);
  const StationOrbit orbit = orbit_at(motion, 0, t, {.order = 1.0});
  EXPECT_NEAR(orbit.forward(), 30e-6, 1e-8);
  EXPECT_NEAR(orbit.speed, 2.0 * pi * 25.0, 0.02);
  EXPECT_THROW(moment_of_speed(motion.clock, 2.0 * pi * 40.0), OptionError);
  EXPECT_THROW(orbit_at(motion, 0, 11.0, {}), OptionError);
  EXPECT_THROW(orbit_at(motion, 0, 5.0, {.order = 1.0, .revolutions = 2.0}), OptionError);
}

// The average over revolutions keeps what repeats with them and drops the rest.
TEST(OrbitView, AveragesOverRevolutions) {
  Made made{.circles = {{1.0, 40e-6}, {3.0, 10e-6}}, .tone = 2.0 * pi * 33.0, .tone_size = 25e-6};
  const TurnedMotion motion = made.motion();
  const StationOrbit average = orbit_at(motion, 0, 2.0, {.is_averaged = true, .revolutions = 40.0});
  for (Eigen::Index j = 0; j < average.x.size(); ++j) {
    const double angle = 2.0 * pi * 20.0 * average.t(j);
    const Complex z = 40e-6 * std::polar(1.0, angle) + 10e-6 * std::polar(1.0, 3.0 * angle);
    EXPECT_NEAR(std::abs(Complex(average.x(j), average.y(j)) - z), 0.0, 0.02e-6);
  }
}

// Slow roll of a shaft that is out of round: its vector off an order, its waveform off the rest.
TEST(OrbitView, TakesSlowRollOff) {
  Made made{.f = 4.0, .r = 4.0, .duration = 10.0};
  made.circles = {{1.0, 8e-6}, {2.0, 3e-6 * i_}};  // runout alone
  const TurnedMotion motion = made.motion();
  const double slow = 2.0 * pi * 8.0;
  EXPECT_LT(orbit_at(motion, 0, 8.0, {.order = 1.0, .slow_roll = slow}).forward(), 0.01e-6);
  const StationOrbit raw = orbit_at(motion, 0, 8.0, {.slow_roll = slow});
  EXPECT_LT(raw.x.cwiseAbs().maxCoeff(), 0.02e-6);
  const StationOrbit average = orbit_at(motion, 0, 8.0, {.is_averaged = true, .slow_roll = slow});
  EXPECT_LT(average.y.cwiseAbs().maxCoeff(), 0.02e-6);
}

TEST(OrbitView, KeepsABandOfFrequencies) {
  Made made{.circles = {{1.0, 40e-6}}, .tone = 2.0 * pi * 50.0, .tone_size = 25e-6};
  const TurnedMotion motion = made.motion();
  const StationOrbit band =
      orbit_at(motion, 0, 2.0, {.band = std::pair(2.0 * pi * 40.0, 2.0 * pi * 60.0)});
  EXPECT_NEAR(band.x.maxCoeff(), 25e-6, 0.3e-6);
  EXPECT_LT(band.y.cwiseAbs().maxCoeff(), 0.3e-6);
}

// A tone that makes whole periods is kept or left out exactly.
TEST(BandFilter, SeparatesTonesOfWholePeriods) {
  const Eigen::Index n = 1000;
  Vec low(n), high(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    low(j) = 3.0 * std::cos(2.0 * pi * 5.0 * static_cast<double>(j) / 1000.0 + 0.2);
    high(j) = std::sin(2.0 * pi * 90.0 * static_cast<double>(j) / 1000.0);
  }
  const Vec sum = (low + high).array() + 7.0;
  EXPECT_LT((band_passed(sum, 1e-3, 2.0 * pi * 5.0, 2.0 * pi * 20.0) - low).norm(), 1e-10);
  EXPECT_LT((band_passed(sum, 1e-3, 2.0 * pi * 50.0, 2.0 * pi * 90.0) - high).norm(), 1e-10);
}

// A shaft that climbs while the speed rises: means of revolutions are where the line is in their
// middle, whatever turns.
TEST(MeanPath, FollowsTheGapBelowTheMotion) {
  Made made{.f = 10.0,
            .r = 1.0,
            .duration = 20.0,
            .circles = {{1.0, 60e-6}, {-2.0, 20e-6}},
            .drift = Complex(2e-6, 5e-6)};
  const TurnedMotion motion = made.motion();
  const MeanPath path = mean_path(motion, 0);
  ASSERT_GT(path.time.size(), 150);
  for (Eigen::Index k = 0; k < path.time.size(); ++k) {
    const Complex z = made.gap + made.drift * path.time(k);
    // a circle that speeds up within the revolution leaves some of itself
    EXPECT_NEAR(std::abs(Complex(path.x(k), path.y(k)) - z), 0.0, 0.25e-6) << path.time(k);
    EXPECT_NEAR(path.speed(k), 2.0 * pi * (10.0 + path.time(k)), 0.02);
  }
}

/// Response of one mode to unbalance over speeds of any order [rad/s].
CVec response_of(const Vec& speed, double critical, double zeta) {
  CVec response(speed.size());
  for (Eigen::Index k = 0; k < speed.size(); ++k) {
    const double r = speed(k) / critical;
    response(k) = 50e-6 * r * r / (1.0 - r * r + 2.0 * i_ * zeta * r);
  }
  return response;
}

// A mode of known damping: the peak and its half-power speeds solve
//   r^4 / ((1 - r^2)^2 + (2 zeta r)^2) = peak^2 / 2,   peak = 1 / (2 zeta sqrt(1 - zeta^2)).
TEST(OrderPeaks, TellTheAmplificationFactorOfAModeAsItsClosedForm) {
  constexpr double critical = 150.0, zeta = 0.04;
  const double top = 1.0 / (2.0 * zeta * std::sqrt(1.0 - zeta * zeta));
  // r^4 (1 - 2 / top^2) - 2 r^2 (1 - 2 zeta^2) + 1 = 0, with u = r^2
  const double a = 1.0 - 2.0 / (top * top), b = 1.0 - 2.0 * zeta * zeta;
  const double below = std::sqrt((b - std::sqrt(b * b - a)) / a),
               above = std::sqrt((b + std::sqrt(b * b - a)) / a);
  const double at = 1.0 / std::sqrt(1.0 - 2.0 * zeta * zeta);
  for (const bool is_coast_down : {false, true}) {
    Vec speed = Vec::LinSpaced(801, 50.0, 300.0);
    if (is_coast_down) speed.reverseInPlace();
    const CVec response = response_of(speed, critical, zeta);
    const std::vector<OrderPeak> peaks = order_peaks(speed, response, 3);
    ASSERT_EQ(peaks.size(), 1u);
    EXPECT_EQ(peaks[0].row, 3);
    EXPECT_NEAR(peaks[0].speed, critical * at, 2e-4 * critical);
    EXPECT_NEAR(peaks[0].amplitude, 50e-6 * top, 1e-3 * 50e-6 * top);
    EXPECT_NEAR(peaks[0].below, critical * below, 1e-3 * critical);
    EXPECT_NEAR(peaks[0].above, critical * above, 1e-3 * critical);
    EXPECT_NEAR(peaks[0].amplification(), at / (above - below), 0.005 * at / (above - below));
  }
}

// Noise makes no peaks on the flanks of a resonance, and a steady record has none.
TEST(OrderPeaks, AreNoNoise) {
  const Vec speed = Vec::LinSpaced(801, 50.0, 300.0);
  CVec response = response_of(speed, 150.0, 0.04);
  for (Eigen::Index k = 0; k < response.size(); ++k) {
    response(k) *= 1.0 + 0.02 * std::sin(7919.0 * static_cast<double>(k));
  }
  const std::vector<OrderPeak> peaks = order_peaks(speed, response, 0);
  ASSERT_EQ(peaks.size(), 1u);
  EXPECT_NEAR(peaks[0].amplification(), 12.5, 0.5);
  EXPECT_TRUE(order_peaks(Vec::LinSpaced(801, 150.0, 151.0), response, 0).empty());
}

}  // namespace whirl::orbit_view_test
