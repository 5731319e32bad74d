// Where rotors come to rest in their films and on their stators, against Ocvirk's bearing and
// springs in series.

#include "libdyn/system/port_balance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/support/oil_films.hpp"

namespace whirl::port_balance_test {

using std::numbers::pi;
using test::MassInRing;
using test::MassOnFilm;

constexpr double rounding = 1e-12;
constexpr double found = 1e-9;  ///< of a place: residuals of 1e-12 of the load, or rounding

// The first rows that span all of them, whatever follows from those.
TEST(IndependentRows, SpanAllOthers) {
  const Mat rows{{0.0, 0.0, 0.0},  {1.0, 2.0, 0.0},   {2.0, 4.0, 0.0},
                 {0.0, 1.0, 10.0}, {3.0, 5.0, -10.0}, {0.0, 0.0, 1e-3}};
  const IndependentRows found_rows = independent_rows(rows);
  EXPECT_EQ(found_rows.chosen, (std::vector<Eigen::Index>{1, 3, 5}));
  Mat chosen(3, 3);
  chosen << rows.row(1), rows.row(3), rows.row(5);
  EXPECT_LT((found_rows.of * chosen - rows).norm(), rounding * rows.norm());
  // of those chosen each is itself, to the last bit
  EXPECT_EQ(Vec(found_rows.of.row(3).transpose()), (Vec{{0.0, 1.0, 0.0}}));
}

/// A rotor held at so many ports that are all independent.
HeldRotor held(const Vec& R, const Mat& K) {
  const Mat all = Mat::Identity(R.size(), R.size());
  return {
      .ports = independent_rows(all), .rest = Vec::Zero(R.size()), .shapes = all, .R = R, .K = K};
}

/// Load of a short half film at an eccentricity [Ocvirk].
double load_at(const MassOnFilm& p, double e) {
  const double Q = (1.0 - e) * (1.0 + e);
  return Short::factor(p.bearing) * p.Omega * e * std::sqrt(16.0 * e * e + pi * pi * Q) / (Q * Q);
}

/// Place over the clearance of a journal under a load along -y.
Vec2 place_of(double e) {
  const double attitude = std::atan2(pi * std::sqrt((1.0 - e) * (1.0 + e)), 4.0 * e);
  return e * Vec2(std::sin(attitude), -std::cos(attitude));
}

TEST(PortBalance, FindsAWeightOnOneFilm) {
  const MassOnFilm p{.offset = {3e-4, -2e-4}};
  const FilmAtSpeed film = at_speed(p.model().films[0], p.Omega, p.Omega);
  for (const double e : {0.05, 0.5, 0.95}) {
    const HeldRotor rotor = held(Vec{{0.0, load_at(p, e)}}, Mat::Zero(2, 2));  // R holds it up
    const auto place = PortBalance(rotor, {film}).find();
    ASSERT_TRUE(place) << e;
    ASSERT_EQ(place->journals.size(), 1u);
    const Vec2 expected = p.bearing.clearance * place_of(e);
    EXPECT_LT((place->journals[0] - expected).norm(), found * p.bearing.clearance) << e;
    EXPECT_LT((place->w - Vec(expected + p.offset)).norm(), found * p.bearing.clearance) << e;
    const auto again = PortBalance(rotor, {film}).find(place->w);
    ASSERT_TRUE(again);
    EXPECT_LT((again->w - place->w).norm(), found * p.bearing.clearance) << e;
  }
}

// A spring beside the film takes k times the place, and so the weight is more by that.
TEST(PortBalance, SharesTheLoadWithASpring) {
  const MassOnFilm p{};
  const FilmAtSpeed film = at_speed(p.model().films[0], p.Omega, p.Omega);
  const double e = 0.4, k = 2e6;
  const Vec2 place = p.bearing.clearance * place_of(e);
  const HeldRotor rotor = held(Vec2(0.0, load_at(p, e)) - k * place, k * Mat::Identity(2, 2));
  const auto at = PortBalance(rotor, {film}).find();
  ASSERT_TRUE(at);
  EXPECT_LT((at->w - Vec(place)).norm(), found * p.bearing.clearance);
}

// A rigid rotor on two films of different oil: both journals are at one place, and together they
// carry it.
TEST(PortBalance, SharesTheLoadAmongFilms) {
  const MassOnFilm p{};
  MassOnFilm thick = p;
  thick.bearing.viscosity *= 3.0;
  const double e = 0.6, W = load_at(p, e) + load_at(thick, e);
  Mat ports(4, 2);
  ports << Mat::Identity(2, 2), Mat::Identity(2, 2);
  HeldRotor rotor = held(Vec{{0.0, W}}, Mat::Zero(2, 2));
  rotor.ports = independent_rows(ports);
  ASSERT_EQ(rotor.ports.chosen.size(), 2u);
  const auto at = PortBalance(rotor, {at_speed(p.model().films[0], p.Omega, p.Omega),
                                      at_speed(thick.model().films[0], p.Omega, p.Omega)})
                      .find();
  ASSERT_TRUE(at);
  ASSERT_EQ(at->journals.size(), 2u);
  for (const Vec2& journal : at->journals) {
    EXPECT_LT((journal - p.bearing.clearance * place_of(e)).norm(), found * p.bearing.clearance);
  }
}

// A spring that a force P presses into a ring along x: k w + k_C (w - c) = P. Pressed less it stays
// apart, w = P / k.
TEST(PortBalance, LeansOnAStator) {
  const MassInRing p{.k = 1e4, .kC = 1e6};
  const Scene scene = p.scene();
  for (const double P : {5.0, 20.0, 200.0}) {
    const HeldRotor rotor = held(Vec{{-P, 0.0}}, p.k * Mat::Identity(2, 2));
    const auto at = PortBalance(rotor, {}, {scene.contacts.contacts()[0]}).find();
    ASSERT_TRUE(at) << P;
    const double free = P / p.k;
    const double expected = free < p.clearance ? free : (P + p.kC * p.clearance) / (p.k + p.kC);
    EXPECT_NEAR(at->w(0), expected, found * p.clearance) << P;
    EXPECT_NEAR(at->w(1), 0.0, found * p.clearance) << P;
    EXPECT_TRUE(at->journals.empty());
  }
}

// About another center, along the line through it.
TEST(PortBalance, KnowsTheMiddleOfARing) {
  const MassInRing p{.k = 1e4, .kC = 1e6, .offset = {2e-4, 0.0}};
  const Scene scene = p.scene();
  const double P = 50.0;
  const HeldRotor rotor = held(Vec{{-P, 0.0}}, p.k * Mat::Identity(2, 2));
  const auto at = PortBalance(rotor, {}, {scene.contacts.contacts()[0]}).find();
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->w(0), (P + p.kC * (p.clearance + p.offset(0))) / (p.k + p.kC),
              found * p.clearance);
}

TEST(PortBalance, SaysThatAFilmWithoutSpeedCarriesNothing) {
  const MassOnFilm p{.Omega = 0.0};
  const HeldRotor rotor = held(Vec{{0.0, 100.0}}, Mat::Zero(2, 2));
  EXPECT_FALSE(PortBalance(rotor, {at_speed(p.model().films[0], 0.0, 0.0)}).find());
  EXPECT_NE(not_found_on_films(0.0).find("without speed"), std::string::npos);
  const std::string at_speed_text = not_found_on_films(300.0 * pi / 30.0);
  EXPECT_NE(at_speed_text.find("300 rpm"), std::string::npos) << at_speed_text;
  EXPECT_EQ(at_speed_text.find("without speed"), std::string::npos);
}

}  // namespace whirl::port_balance_test
