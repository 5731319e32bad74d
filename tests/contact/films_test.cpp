// Laws of oil films: the closed form of the short bearing against its integral and known results.

#include "libcontact/films.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace whirl::films_test {

using std::numbers::pi;

struct Force {
  double x, y;
};

Force force(double x, double y, double a, double b) {
  const auto [fx, fy] = Short::force(x, y, a, b);
  return {fx, fy};
}

/// The force as the integral of the pressure over the half that is squeezed, by the double
/// exponential rule.
Force integrated(double x, double y, double a, double b) {
  const double start = std::atan2(b, a) - pi;  // b cos t - a sin t = p sin(t - start)
  const double p = std::hypot(a, b);
  Force sum{0.0, 0.0};
  constexpr int points = 400;
  constexpr double reach = 3.4, h = 2.0 * reach / points;
  for (int i = 0; i <= points; ++i) {
    const double s = -reach + h * i;
    const double inner = 0.5 * pi * std::sinh(s);
    const double place = 1.0 / (1.0 + std::exp(-2.0 * inner));  // 0 to 1
    const double weight = h * 0.5 * pi * std::cosh(s) * 0.5 / std::pow(std::cosh(inner), 2);
    const double t = start + pi * place;
    const double gap = 1.0 - x * std::cos(t) - y * std::sin(t);
    const double density = p * std::sin(pi * place) / (gap * gap * gap) * pi * weight;
    sum.x -= 2.0 * density * std::cos(t);
    sum.y -= 2.0 * density * std::sin(t);
  }
  return sum;
}

// Printed with the data of the two-disk rotor on oil films, to ten digits; the sign of one term of
// the paper's fy is corrected there as here.
TEST(ShortFilm, HasThePrintedForces) {
  constexpr double digits = 5e-10;
  const auto expect = [&](double x, double y, double x_rate, double y_rate, Force printed) {
    const Force f = force(x, y, x - 2.0 * y_rate, y + 2.0 * x_rate);
    EXPECT_NEAR(f.x, printed.x, digits);
    EXPECT_NEAR(f.y, printed.y, digits);
  };
  expect(0.0, -0.5, 0.0, 0.0, {2.418399152, 1.777777778});
  expect(0.3, -0.4, 0.1, -0.2, {-1.821529841, 9.029516486});
}

// Any state inside: anywhere in the bearing, squeezed and dragged in every direction. The relative
// error of both sides is that of the gap, rounding / (1 - e), to the power of the integrand.
TEST(ShortFilm, IsTheIntegralOfItsPressure) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit;
  for (int i = 0; i < 2000; ++i) {
    const double e = 0.9 * std::sqrt(unit(random)), turn = 2.0 * pi * unit(random);
    const double p = std::pow(10.0, 4.0 * unit(random) - 2.0), way = 2.0 * pi * unit(random);
    const double x = e * std::cos(turn), y = e * std::sin(turn);
    const double a = p * std::cos(way), b = p * std::sin(way);
    const Force f = force(x, y, a, b), g = integrated(x, y, a, b);
    const double bound = 1e-12 * p / std::pow(1.0 - e * e, 2.5);
    EXPECT_NEAR(f.x, g.x, bound) << e;
    EXPECT_NEAR(f.y, g.y, bound) << e;
  }
}

// A journal that only turns, at eccentricity e (Ocvirk's load, half of the film):
//
//   |F| = e (16 e^2 + pi^2 (1 - e^2))^(1/2) / (1 - e^2)^2,   tan(attitude) = pi (1 - e^2)^(1/2) / (4 e)
TEST(ShortFilm, CarriesTheLoadOfTheTextbook) {
  for (const double e : {1e-6, 0.01, 0.3, 0.6, 0.9, 0.99, 0.9999}) {
    const Force f = force(e, 0.0, e, 0.0);
    const double Q = (1.0 - e) * (1.0 + e);
    const double load = e * std::sqrt(16.0 * e * e + pi * pi * Q) / (Q * Q);
    const double rounding = 1e-14 / Q + 1e-18 / (e * e);  // the second: the kink that is rounded
    EXPECT_NEAR(std::hypot(f.x, f.y), load, rounding * load) << e;
    EXPECT_LT(f.x, 0.0);
    EXPECT_NEAR(f.y / -f.x, pi * std::sqrt(Q) / (4.0 * e), rounding * f.y / -f.x) << e;
  }
}

// Squeezed outward along x without spin: b = 2 x',  F = -2 x' d2G/dx2 with G as in short.hpp, whose
// values at e = 0 and, to leading order, at e -> 1 are known: pi and 6 pi / (1 - e^2)^(5/2).
TEST(ShortFilm, DampsWithoutSpin) {
  EXPECT_NEAR(force(0.0, 0.0, 0.0, 2.0).x, -2.0 * pi, 1e-14);
  EXPECT_NEAR(force(0.0, 0.0, 0.0, 2.0).y, 0.0, 1e-14);
  const double Q = 2e-8, e = std::sqrt(1.0 - Q);
  const double leading = -2.0 * 6.0 * pi / std::pow(Q, 2.5);
  EXPECT_NEAR(force(e, 0.0, 0.0, 2.0).x / leading, 1.0, 1e-6);
}

// Proportional to (a, b), turned with the axes, and zero without flow.
TEST(ShortFilm, KnowsNoDirectionAndNoScaleOfRates) {
  const Force f = force(0.5, 0.2, 0.7, -0.4), doubled = force(0.5, 0.2, 1.4, -0.8);
  EXPECT_NEAR(doubled.x, 2.0 * f.x, 1e-14);
  EXPECT_NEAR(doubled.y, 2.0 * f.y, 1e-14);
  const Force turned = force(-0.2, 0.5, 0.4, 0.7);
  EXPECT_NEAR(turned.x, -f.y, 1e-14);
  EXPECT_NEAR(turned.y, f.x, 1e-14);
  for (const double e : {0.0, 0.5, 0.999}) {
    EXPECT_EQ(force(e, 0.0, 0.0, 0.0).x, 0.0);
    EXPECT_EQ(force(e, 0.0, 0.0, 0.0).y, 0.0);
  }
}

// Numbers at every state inside, however small the rates; none at the wall and beyond.
TEST(ShortFilm, IsANumberInsideAndNoneOutside) {
  for (const double e : {0.0, 1e-300, 0.5, 1.0 - 1e-15}) {
    for (const double p : {0.0, 1e-300, 1e-30, 1e-9, 1.0, 1e6}) {
      for (const double way : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0}) {
        const Force f = force(0.0, -e, p * std::cos(way), p * std::sin(way));
        EXPECT_TRUE(std::isfinite(f.x) && std::isfinite(f.y)) << e << " " << p << " " << way;
      }
    }
  }
  for (const double e : {1.0, 1.0 + 1e-12, 1.5}) {
    EXPECT_FALSE(std::isfinite(force(e, 0.0, 0.3, 0.4).x)) << e;
  }
}

// s = viscosity R L^3 / (4 C^2), the paper's viscosity Omega R L (R / C)^2 (L / 2R)^2 over Omega.
TEST(ShortFilm, HasThePapersFactor) {
  const JournalBearing b{.radius = 0.025, .length = 0.012, .clearance = 1.1e-4, .viscosity = 0.018};
  const double paper = 0.018 * 0.025 * 0.012 * std::pow(0.025 / 1.1e-4, 2) * std::pow(0.24, 2);
  EXPECT_NEAR(Short::factor(b), paper, 1e-14 * paper);
}

}  // namespace whirl::films_test
