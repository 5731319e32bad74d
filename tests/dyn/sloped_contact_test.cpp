// Contacts and films whose numbers bring their derivatives along: kinematics and forces against
// derivatives by hand, and against differences of the systems themselves.

#include "libdyn/system/sloped_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/support/oil_films.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::sloped_contact_test {

using test::MassInRing;
using test::MassOnFilm;

constexpr double of_slopes = 1e-10;  ///< relative, of a stencil of steps of 1 %

/// A mass in its ring, and how a number of it changes the contact.
struct ByNumber {
  SystemSlope beside;
  SlopedContact contact;

  ByNumber(const MassInRing& p, double size, const std::function<void(MassInRing&, double)>& set,
           double value)
      : beside(slope_of("number", p.scene(), value, size,
                        [&](double at) {
                          MassInRing q = p;
                          set(q, at);
                          return q.model();
                        })),
        contact(sloped_contact(p.scene().contacts, 0, NumberSlopes(beside))) {}
};

const MassInRing ring{.Omega = 100.0,
                      .kC = 1e6,
                      .cC = 50.0,
                      .mu = 0.2,
                      .R = 0.01,
                      .clearance = 1e-3,
                      .offset = {1e-4, -2e-4}};

/// 1.5 mm out from the middle of the ring along (0.6, 0.8).
GapMotion<ByParameter> motion() {
  return {{ByParameter(1e-4 + 0.9e-3), ByParameter(-2e-4 + 1.2e-3)},
          {ByParameter(0.3), ByParameter(-0.1)},
          {ByParameter(0.3), ByParameter(-0.1)}};
}

TEST(SlopedContact, HasTheGapOfItsContact) {
  const ByNumber by(
      ring, 0.0, [](MassInRing& q, double at) { q.clearance = at; }, ring.clearance);
  const auto gap = by.contact.gap(0.0, motion());
  EXPECT_NEAR(gap.r.value, 1.5e-3, 1e-15);
  EXPECT_NEAR(gap.n[0].value, 0.6, 1e-12);
  EXPECT_NEAR(gap.n[1].value, 0.8, 1e-12);
  EXPECT_NEAR(gap.depth.value, 0.5e-3, 1e-15);
  EXPECT_NEAR(gap.rate.value, 0.6 * 0.3 - 0.8 * 0.1, 1e-12);
  EXPECT_NEAR(gap.slip.value, 1.0 - 0.8 * 0.3 - 0.6 * 0.1, 1e-12);
}

TEST(SlopedContact, IsLessDeepInAWiderRing) {
  const ByNumber by(
      ring, 0.0, [](MassInRing& q, double at) { q.clearance = at; }, ring.clearance);
  EXPECT_EQ(by.contact.clearance.value, ring.clearance);
  EXPECT_NEAR(by.contact.clearance.slopes(0), 1.0, of_slopes);
  const auto gap = by.contact.gap(0.0, motion());
  EXPECT_NEAR(gap.depth.slopes(0), -1.0, of_slopes);
  EXPECT_EQ(gap.slip.slopes(0), 0.0);
  EXPECT_EQ(gap.rate.slopes(0), 0.0);
}

// Moved by dx, the ring is nearer by -n_x; the normal turns by -t_x / r.
TEST(SlopedContact, MovesWithItsMiddle) {
  const ByNumber by(
      ring, 1e-3, [](MassInRing& q, double at) { q.offset(0) = at; }, ring.offset(0));
  const auto gap = by.contact.gap(0.0, motion());
  EXPECT_NEAR(gap.depth.slopes(0), -0.6, of_slopes);
  // n' = -t t_x / r with t = (-0.8, 0.6)
  const double turned = 0.8 / 1.5e-3;
  EXPECT_NEAR(gap.n[0].slopes(0), -0.8 * turned, of_slopes * turned);
  EXPECT_NEAR(gap.n[1].slopes(0), 0.6 * turned, of_slopes * turned);
}

TEST(SlopedContact, SlipsFasterByTheSpeed) {
  const ByNumber by(
      ring, 0.0, [](MassInRing& q, double at) { q.Omega = at; }, ring.Omega);
  EXPECT_NEAR(by.contact.rim_speed.slopes(0), ring.R, of_slopes * ring.R);
  const auto gap = by.contact.gap(0.0, motion());
  EXPECT_NEAR(gap.slip.slopes(0), ring.R, of_slopes * ring.R);
  EXPECT_EQ(gap.depth.slopes(0), 0.0);
  EXPECT_EQ(by.contact.mu.value, ring.mu);
  EXPECT_EQ(by.contact.mu.slopes(0), 0.0);
}

// N = k d + c d': dN/dk = d, dN/dc = d'.
TEST(SlopedContact, PressesHarderByItsLaw) {
  const ByNumber by_k(
      ring, 0.0, [](MassInRing&q, double at) { q.kC = at; }, ring.kC),
      by_c(
          ring, 0.0, [](MassInRing&q, double at) { q.cC = at; }, ring.cC);
  const double depth = 2e-4, rate = 0.7;
  const auto normal = [&](const ByNumber& by) {
    const auto& law = std::get<Radial<ByParameter>>(by.contact.law);
    return ByParameter(law.normal(ByParameter(depth), ByParameter(rate)));
  };
  EXPECT_NEAR(normal(by_k).value, ring.kC * depth + ring.cC * rate, 1e-9);
  EXPECT_NEAR(normal(by_k).slopes(0), depth, of_slopes * depth);
  EXPECT_NEAR(normal(by_c).slopes(0), rate, of_slopes * rate);
}

// ---- films --------------------------------------------------------------------------------------

/// A film changed by its clearance, viscosity, speed or place.
MassOnFilm film_at(int number, double value) {
  MassOnFilm p{.offset = {1e-5, 2e-5}};
  (number == 0   ? p.bearing.clearance
   : number == 1 ? p.bearing.viscosity
   : number == 2 ? p.Omega
                 : p.offset(1)) = value;
  return p;
}

// The force is in proportion to the viscosity; by the others it has the slopes of differences.
TEST(SlopedFilm, HasTheSlopesOfItsForce) {
  constexpr double of_differences = 1e-6;  // central ones of steps of 1e-4, relative
  const double values[] = {1e-4, 0.02, 300.0, 2e-5}, sizes[] = {0.0, 0.0, 0.0, 1e-4};
  const Vec y{{4e-5, -3e-5, 0.01, -0.02}};
  const auto force_at = [&](int number, double value) {
    return film_force(film_at(number, value).scene().contacts.films()[0], y.data(), 2);
  };
  for (int i = 0; i < 4; ++i) {
    const Scene scene = film_at(i, values[i]).scene();
    const SystemSlope beside = slope_of("number", scene, values[i], sizes[i],
                                        [&](double at) { return film_at(i, at).model(); });
    const SlopedFilm film = sloped_film(scene.contacts, 0, NumberSlopes(beside));
    const auto force =
        film.force({ByParameter(y(0)), ByParameter(y(1))}, {ByParameter(y(2)), ByParameter(y(3))});
    ASSERT_TRUE(force) << i;
    const Vec2 expected = force_at(i, values[i]);
    const double h = 1e-4 * std::abs(values[i]);
    const Vec2 slope = (force_at(i, values[i] + h) - force_at(i, values[i] - h)) / (2.0 * h);
    for (const int k : {0, 1}) {
      const ByParameter& f = (*force)[static_cast<std::size_t>(k)];
      EXPECT_NEAR(f.value, expected(k), 1e-11 * expected.norm()) << i;
      EXPECT_NEAR(f.slopes(0), slope(k), of_differences * slope.norm()) << i;
      if (i == 1) {
        EXPECT_NEAR(f.slopes(0), expected(k) / values[1], of_slopes * expected.norm() / values[1]);
      }
    }
  }
}

TEST(SlopedFilm, IsNoneOutsideTheBearing) {
  const Scene scene = film_at(0, 1e-4).scene();
  const SystemSlope beside =
      slope_of("clearance", scene, 1e-4, 0.0, [](double at) { return film_at(0, at).model(); });
  const SlopedFilm film = sloped_film(scene.contacts, 0, NumberSlopes(beside));
  const std::array<ByParameter, 2> still{};
  EXPECT_TRUE(film.force({ByParameter(1e-5 + 0.99e-4), ByParameter(2e-5)}, still));
  EXPECT_FALSE(film.force({ByParameter(1e-5 + 1.01e-4), ByParameter(2e-5)}, still));
}

}  // namespace whirl::sloped_contact_test
