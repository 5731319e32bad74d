// Laws of oil films: the closed form of the short bearing against its integral and known results.

#include "libcontact/films.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <vector>

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

// Of an independent program for the two-disk rotor on oil films, to ten digits; the sign of one
// term of the paper's fy is corrected there as here.
TEST(ShortFilm, HasTheForcesOfAnIndependentProgram) {
  constexpr double digits = 5e-10;
  const auto expect = [&](double x, double y, double x_rate, double y_rate, Force found) {
    const Force f = force(x, y, x - 2.0 * y_rate, y + 2.0 * x_rate);
    EXPECT_NEAR(f.x, found.x, digits);
    EXPECT_NEAR(f.y, found.y, digits);
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
//   |F| = e (16 e^2 + pi^2 (1 - e^2))^(1/2) / (1 - e^2)^2,
//   tan(attitude) = pi (1 - e^2)^(1/2) / (4 e)
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

// ---- squeeze films ----

constexpr JournalBearing damper{
    .radius = 0.065, .length = 0.02, .clearance = 1e-4, .viscosity = 0.02};

std::vector<Squeeze> dampers() {
  std::vector<Squeeze> all;
  for (const FilmTheory theory : {FilmTheory::short_bearing, FilmTheory::long_bearing}) {
    for (const FilmExtent extent : {FilmExtent::half, FilmExtent::full}) {
      all.push_back({.theory = theory, .extent = extent});
    }
  }
  return all;
}

/// What a damper does in a centered circle of eccentricity e at omega: force = -K r - C r'.
struct Circle {
  double K, C;  // [N/m], [N.s/m]
};
Circle circle(const Squeeze& law, double e, double omega) {
  const auto [fx, fy] = law.force(e, 0.0, -2.0 * e * omega, 0.0);
  const double factor = law.factor(damper), c = damper.clearance;
  return {-factor * fx / (e * c), -factor * fy / (e * c * omega)};
}

// Short, with B = pi viscosity R (L/c)^3: half  C = B / (2 (1-e^2)^(3/2)), K = 2 viscosity omega R
// (L/c)^3 e / (1-e^2)^2; full  C = B / (1-e^2)^(3/2), K = 0. Long, with 12 viscosity L (R/c)^3:
// half C = pi b / ((2+e^2) (1-e^2)^(1/2)), K = 2 b omega e / ((2+e^2) (1-e^2)); full twice C and no
// K.
TEST(SqueezeFilm, HasTheCoefficientsOfCenteredCircles) {
  constexpr double digits = 1e-9, omega = 1000.0;
  const auto& [R, L, c, viscosity] = damper;
  const Squeeze half{};
  EXPECT_NEAR(circle(half, 0.5, omega).C, 25151.35, 5e-3);
  EXPECT_NEAR(circle(half, 0.5, omega).K, 1.848889e7, 5.0);
  for (const double e : {0.01, 0.2, 0.5, 0.8, 0.95}) {
    const double Q = 1.0 - e * e;
    const double s = viscosity * R * std::pow(L / c, 3),
                 l = 12.0 * viscosity * L * std::pow(R / c, 3);
    const double C_short = pi * s / std::pow(Q, 1.5),
                 C_long = 2.0 * pi * l / ((2.0 + e * e) * std::sqrt(Q));
    const Circle expected[] = {{2.0 * s * omega * e / (Q * Q), 0.5 * C_short},
                               {0.0, C_short},
                               {2.0 * l * omega * e / ((2.0 + e * e) * Q), 0.5 * C_long},
                               {0.0, C_long}};
    for (std::size_t i = 0; i < 4; ++i) {
      const Circle found = circle(dampers()[i], e, omega);
      EXPECT_NEAR(found.C, expected[i].C, digits * expected[i].C) << e << " " << i;
      EXPECT_NEAR(found.K, expected[i].K, digits * expected[i].C * omega) << e << " " << i;
    }
  }
}

/// Integral over a range by many points of the midpoint rule; exact to rounding over a whole turn.
template <class F>
double integral(const F& f, double from, double to, int points = 4000) {
  double sum = 0.0;
  const double h = (to - from) / points;
  for (int i = 0; i < points; ++i) sum += h * f(from + h * (i + 0.5));
  return sum;
}

// The long films from H^3 P' = -integral of the squeeze + constant, which the pressures at the ends
// of the oil give: equal all around, or zero at both ends of the half.
TEST(SqueezeFilm, IsTheIntegralOfItsPressure) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit;
  for (int i = 0; i < 40; ++i) {
    const double e = 0.8 * std::sqrt(unit(random)), turn = 2.0 * pi * unit(random);
    const double way = 2.0 * pi * unit(random);
    const double x = e * std::cos(turn), y = e * std::sin(turn);
    const double a = 0.7 * std::cos(way), b = 0.7 * std::sin(way);
    const double start = std::atan2(-b, -a), p = std::hypot(a, b);
    for (const Squeeze& law : dampers()) {
      const double from = start, to = start + (law.extent == FilmExtent::half ? pi : 2.0 * pi);
      const auto H = [&](double t) { return 1.0 - x * std::cos(t) - y * std::sin(t); };
      Force expected{};
      double accuracy = 1e-11;
      if (law.theory == FilmTheory::long_bearing) {
        const auto flow = [&](double t) { return p * std::cos(t - start); };
        const double m = integral([&](double t) { return flow(t) / std::pow(H(t), 3); }, from, to) /
                         integral([&](double t) { return 1.0 / std::pow(H(t), 3); }, from, to);
        const auto slope = [&](double t) { return (flow(t) - m) / std::pow(H(t), 3); };
        // by parts, with P = 0 at the ends or equal there
        expected.x = integral([&](double t) { return slope(t) * std::sin(t); }, from, to);
        expected.y = -integral([&](double t) { return slope(t) * std::cos(t); }, from, to);
        if (law.extent == FilmExtent::half) accuracy = 1e-5 / std::pow(1.0 - e, 5);
      } else {
        const auto density = [&](double t) {
          return 2.0 * p * std::sin(t - start) / std::pow(H(t), 3);
        };
        expected.x = -integral([&](double t) { return density(t) * std::cos(t); }, from, to);
        expected.y = -integral([&](double t) { return density(t) * std::sin(t); }, from, to);
        if (law.extent == FilmExtent::half) accuracy = 1e-5 / std::pow(1.0 - e, 5);
      }
      if (law.extent == FilmExtent::full) accuracy = 1e-10 / std::pow(1.0 - e, 5);
      const auto [fx, fy] = law.force(x, y, a, b);
      EXPECT_NEAR(fx, expected.x, accuracy) << e << " " << law.formula();
      EXPECT_NEAR(fy, expected.y, accuracy) << e << " " << law.formula();
    }
  }
}

// Both halves together are the full film: a motion and the opposite one.
TEST(SqueezeFilm, OfTheShortKindIsFullByItsHalves) {
  const Squeeze half{}, full{.extent = FilmExtent::full};
  const auto [ax, ay] = half.force(0.3, -0.4, 0.5, 0.7);
  const auto [bx, by] = half.force(0.3, -0.4, -0.5, -0.7);
  const auto [fx, fy] = full.force(0.3, -0.4, 0.5, 0.7);
  EXPECT_NEAR(ax - bx, fx, 1e-12);
  EXPECT_NEAR(ay - by, fy, 1e-12);
}

TEST(SqueezeFilm, IsANumberInsideAndNothingAtRest) {
  for (const Squeeze& law : dampers()) {
    for (const double e : {0.0, 1e-300, 0.5, 0.99999}) {
      for (const double p : {0.0, 1e-300, 1e-9, 1.0, 1e6}) {
        for (const double way : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0}) {
          const auto [fx, fy] = law.force(0.0, -e, p * std::cos(way), p * std::sin(way));
          EXPECT_TRUE(std::isfinite(fx) && std::isfinite(fy)) << e << " " << p << " " << way;
          if (p == 0.0) {
            EXPECT_EQ(std::hypot(fx, fy), 0.0) << e;
          }
        }
      }
    }
    const auto [fx, fy] = law.force(1.0, 0.1, 0.3, 0.4);
    EXPECT_FALSE(std::isfinite(fx));
  }
}

TEST(FilmLaws, AreToldApartByTheirFormulas) {
  std::set<std::size_t> numbers{formula_of(AnyFilmLaw(Short{}))};
  for (const Squeeze& law : dampers()) numbers.insert(formula_of(AnyFilmLaw(law)));
  EXPECT_EQ(numbers.size(), 5u);
  EXPECT_TRUE(is_dragged(AnyFilmLaw(Short{})));
  EXPECT_FALSE(is_dragged(AnyFilmLaw(Squeeze{})));
  EXPECT_EQ(spring_of(AnyFilmLaw(Squeeze{.spring = 2e6})), 2e6);
  EXPECT_EQ(spring_of(AnyFilmLaw(Short{})), 0.0);
}

}  // namespace whirl::films_test
