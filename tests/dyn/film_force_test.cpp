// The force of an oil film at a place and a velocity: Ocvirk's closed form, quadrature of the
// squeezed half, slopes by differences, and the place that carries a load.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "libdyn/system/film.hpp"
#include "tests/support/oil_films.hpp"

namespace whirl::film_force_test {

using std::numbers::pi;
using test::MassOnFilm;

constexpr double rounding = 1e-12;
constexpr double of_differences = 1e-7;  ///< central ones of steps of 1e-5, relative

/// s = viscosity R L^3 / (4 c^2) [N.s]
double size_of(const JournalBearing& b) {
  return b.viscosity * b.radius * std::pow(b.length, 3) / (4.0 * b.clearance * b.clearance);
}

OilFilm oil_film(const MassOnFilm& p) {
  return p.model().films[0];
}

/// A short half film by quadrature, where (a, b) says how it is squeezed and dragged,
///
///   F = -2 s int (b cos t - a sin t)_+ (cos t, sin t) / (1 - x cos t - y sin t)^3 dt,
///
/// over the half circle from the zero of the bracket on, in its own angle.
Vec2 by_quadrature(double s, const Vec2& d, double a, double b) {
  constexpr int N = 4000;
  const double first = std::atan2(-a, b) - 0.5 * pi;  // b cos t - a sin t = p cos(t - atan2(-a, b))
  Vec2 sum = Vec2::Zero();
  for (int i = 0; i <= N; ++i) {  // Simpson's rule
    const double t = first + pi * i / N, weight = i == 0 || i == N ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    const Vec2 e(std::cos(t), std::sin(t));
    sum += weight * (b * e(0) - a * e(1)) / std::pow(1.0 - d.dot(e), 3) * e;
  }
  return -2.0 * s * sum * pi / (3.0 * N);
}
constexpr double of_quadrature = 1e-8;  ///< Simpson's rule of 4000 parts, to e = 0.6

TEST(FilmForce, IsThatOfTheSqueezedHalf) {
  for (const double Omega : {300.0, -300.0, 0.0}) {
    const MassOnFilm p{.Omega = Omega, .offset = {2e-5, -1e-5}};
    const Scene scene = p.scene();
    const ReducedFilm& film = scene.contacts.films()[0];
    const double c = p.bearing.clearance;
    for (const Vec2& d : {Vec2(0.3, 0.0), Vec2(-0.2, 0.5), Vec2(0.1, -0.6)}) {
      const Vec2 v(40.0, -70.0);  // over the clearance [1/s]
      const Eigen::Vector4d y = (Eigen::Vector4d() << p.offset + c * d, c * v).finished();
      const Vec2 force = film_force(film, y.data(), 2);
      const Vec2 expected = by_quadrature(size_of(p.bearing), d, Omega * d(0) - 2.0 * v(1),
                                          Omega * d(1) + 2.0 * v(0));
      EXPECT_LT((force - expected).norm(), of_quadrature * expected.norm()) << Omega;
      EXPECT_NEAR(eccentricity(film, y.data(), 2), d.norm(), rounding);
    }
  }
}

// Ocvirk: a journal at rest at e along x is pushed back by 4 s Omega e^2 / Q^2 and along its spin
// by pi s Omega e / Q^(3/2), Q = 1 - e^2.
TEST(FilmForce, IsOcvirksAtRest) {
  for (const double Omega : {300.0, -120.0}) {
    const MassOnFilm p{.Omega = Omega};
    const FilmAtSpeed film = at_speed(oil_film(p), Omega, Omega);
    const double s = size_of(p.bearing);
    for (const double e : {0.05, 0.5, 0.95}) {
      const double Q = (1.0 - e) * (1.0 + e);
      const auto slopes = film_slopes(film, {e * p.bearing.clearance, 0.0}, Vec2::Zero());
      ASSERT_TRUE(slopes);
      const double back = 4.0 * s * std::abs(Omega) * e * e / (Q * Q);
      const double along = pi * s * Omega * e / std::pow(Q, 1.5);
      EXPECT_NEAR(slopes->force(0), -back, 1e-10 * std::abs(back));
      EXPECT_NEAR(slopes->force(1), along, 1e-10 * std::abs(along));
    }
  }
}

TEST(FilmForce, TakesItsRatesByThePhase) {
  const MassOnFilm p{.offset = {1e-5, 2e-5}};
  const OilFilm oil = oil_film(p);
  const struct {
    double Omega, rate, spin;
  } cases[] = {{300.0, 300.0, 1.0}, {-300.0, 300.0, -1.0}, {0.0, 2.0 * pi, 0.0}};
  for (const auto& [Omega, rate, spin] : cases) {
    const FilmAtSpeed film = at_speed(oil, Omega, Omega);
    EXPECT_EQ(film.rate, rate);
    EXPECT_EQ(film.spin, spin);
    EXPECT_EQ(film.clearance, p.bearing.clearance);
    EXPECT_EQ(film.offset, p.offset);
    EXPECT_NEAR(film.factor, size_of(p.bearing), rounding * size_of(p.bearing));
  }
  OilFilm squeezed = oil;
  squeezed.law = Squeeze{};
  EXPECT_EQ(at_speed(squeezed, 300.0, 300.0).spin, 0.0);  // the journal does not drag it
}

// In the middle of its bearing, K_xy = -K_yx = pi s Omega / c, C = 2 pi s / c.
TEST(FilmForce, HasTheSlopesOfAFullTurnInTheMiddle) {
  const MassOnFilm p{};
  const FilmAtSpeed film = at_speed(oil_film(p), p.Omega, p.Omega);
  const double s = size_of(p.bearing), c = p.bearing.clearance;
  const auto slopes = film_slopes(film, Vec2::Zero(), Vec2::Zero());
  ASSERT_TRUE(slopes);
  const double k = pi * s * p.Omega / c, d = 2.0 * pi * s / c;
  EXPECT_NEAR(slopes->by_u(1, 0), k, 1e-9 * k);
  EXPECT_NEAR(slopes->by_u(0, 1), -k, 1e-9 * k);
  EXPECT_NEAR(slopes->by_u_rate(0, 0), -d, 1e-9 * d);
  EXPECT_NEAR(slopes->by_u_rate(1, 1), -d, 1e-9 * d);
}

TEST(FilmForce, HasTheSlopesOfDifferences) {
  const MassOnFilm p{.offset = {2e-5, -1e-5}};
  const Scene scene = p.scene();
  const ReducedFilm& film = scene.contacts.films()[0];
  const double c = p.bearing.clearance;
  const Eigen::Vector4d y =
      (Eigen::Vector4d() << p.offset + c * Vec2(0.3, -0.4), c * Vec2(50.0, 90.0)).finished();
  const auto slopes = film_slopes(film, y.head<2>(), y.tail<2>());
  ASSERT_TRUE(slopes);
  const Vec2 force = film_force(film, y.data(), 2);
  EXPECT_LT((slopes->force - force).norm(), rounding * force.norm());
  for (int i = 0; i < 4; ++i) {
    const double h = 1e-5 * c * (i < 2 ? 1.0 : p.Omega);
    Eigen::Vector4d up = y, down = y;
    up(i) += h;
    down(i) -= h;
    const Vec2 by = (film_force(film, up.data(), 2) - film_force(film, down.data(), 2)) / (2.0 * h);
    const Mat2& all = i < 2 ? slopes->by_u : slopes->by_u_rate;
    EXPECT_LT((all.col(i % 2) - by).norm(), of_differences * all.norm()) << i;
  }
}

TEST(FilmForce, IsNoneOutsideTheBearing) {
  const MassOnFilm p{.offset = {2e-5, 0.0}};
  const Scene scene = p.scene();
  const ReducedFilm& film = scene.contacts.films()[0];
  for (const double e : {0.999, 1.001}) {
    const Vec2 u = p.offset + p.bearing.clearance * e * Vec2(0.6, -0.8);
    EXPECT_EQ(film_slopes(film, u, {0.0, 0.1}).has_value(), e < 1.0);
    const Eigen::Vector4d y = (Eigen::Vector4d() << u, 0.0, 0.1).finished();
    EXPECT_EQ(film_force(film, y.data(), 2).allFinite(), e < 1.0);
    EXPECT_NEAR(eccentricity(film, y.data(), 2), e, rounding);
  }
}

// Where the film alone carries a load, its force is the opposite of that; from hardly any load to
// a film of a thousandth of the clearance.
TEST(FilmForce, CarriesALoadWhereItSays) {
  constexpr double found = 1e-8;  // of the load: 1e-16 of the place, over 1 - e of 1e-3
  for (const double Omega : {300.0, -300.0}) {
    const MassOnFilm p{.Omega = Omega, .offset = {2e-3, -1e-3}};
    FilmAtSpeed film = at_speed(oil_film(p), Omega, Omega);
    for (const double e : {1e-4, 0.3, 0.9, 0.999}) {
      const double Q = (1.0 - e) * (1.0 + e);
      const double W = size_of(p.bearing) * std::abs(Omega) * e *
                       std::sqrt(16.0 * e * e + pi * pi * Q) / (Q * Q);
      for (const double angle : {-0.5 * pi, 0.7, 3.0}) {
        const Vec2 load = W * Vec2(std::cos(angle), std::sin(angle));
        film.offset.setZero();  // it would cost digits near the wall
        const auto u = place_under(film, load);
        ASSERT_TRUE(u) << e;
        EXPECT_NEAR(u->norm() / p.bearing.clearance, e, 1e-10);
        const auto slopes = film_slopes(film, *u, Vec2::Zero());
        ASSERT_TRUE(slopes);
        EXPECT_LT((slopes->force + load).norm(), found * W) << e;
        film.offset = p.offset;
        const auto aside = place_under(film, load);
        ASSERT_TRUE(aside);
        EXPECT_LT((*aside - *u - p.offset).norm(), rounding * p.offset.norm());
      }
    }
    EXPECT_EQ(place_under(film, Vec2::Zero()), std::optional(p.offset));
  }
}

TEST(FilmForce, CarriesNothingWithoutSpin) {
  const MassOnFilm p{.Omega = 0.0};
  EXPECT_FALSE(place_under(at_speed(oil_film(p), 0.0, 0.0), {0.0, -1.0}));
}

}  // namespace whirl::film_force_test
