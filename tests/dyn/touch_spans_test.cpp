// When a contact touches on a periodic motion: spans in closed form, of kinks, dampers, reversals
// of slip and touches that are shorter than any grid.

#include "libdyn/system/touch_spans.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/scenes.hpp"

namespace whirl::touch_spans_test {

using std::numbers::pi;
using test::MassInRing;

/// Angles, by the rounding of sines over the slope of a gap, 1e-3 or more.
constexpr double rounding = 1e-11;
constexpr double of_forces = 1e-12;  ///< relative

/// A motion of (x, y) with one harmonic: coefficients of 1, cos and sin.
Periodic motion_of(const ContactSystem& system, const Vec2& mean, const Vec2& cosine,
                   const Vec2& sine, int period = 1) {
  Mat c(2, 3);
  c << mean, cosine, sine;
  return {c, period, system.phase_rate()};
}

/// Its spans; none lies between two copies of one event.
std::vector<PeriodicContact::Span> spans_of(const ContactSystem& system, const Periodic& motion) {
  std::vector<PeriodicContact::Span> spans;
  for (const auto& span : PeriodicContact(system.contacts()[0], motion).spans()) {
    EXPECT_GE(span.from, 0.0);
    EXPECT_LT(span.from, 2.0 * pi);
    EXPECT_LE(span.to - span.from, 2.0 * pi);
    EXPECT_GT(span.to - span.from, rounding);
    spans.push_back(span);
  }
  return spans;
}

// x = A cos theta touches on both sides, where |cos theta| > c / A.
TEST(TouchSpans, AreThoseOfACosine) {
  const MassInRing p{};
  const Scene scene = p.scene();
  for (const double ratio : {1.01, 1.5, 20.0}) {
    const double b = std::acos(1.0 / ratio);
    const Periodic motion =
        motion_of(scene.contacts, {0.0, 0.0}, {ratio * p.clearance, 0.0}, {0.0, 0.0});
    const auto spans = spans_of(scene.contacts, motion);
    ASSERT_EQ(spans.size(), 2u) << ratio;
    for (std::size_t i = 0; i < 2; ++i) {
      const double middle = static_cast<double>(i + 1) * pi;
      EXPECT_NEAR(spans[i].from, middle - b, rounding);
      EXPECT_NEAR(spans[i].to, middle + b, rounding);
      EXPECT_TRUE(spans[i].begins);
      EXPECT_TRUE(spans[i].ends);
      EXPECT_FALSE(spans[i].is_whole());
    }
  }
}

// The same of a touch of a two thousandth of the period, between two angles of any usual grid.
TEST(TouchSpans, FindTouchesThatAreShorterThanTheGrid) {
  const MassInRing p{};
  const Scene scene = p.scene();
  const double ratio = 1.0 + 1e-6, b = std::acos(1.0 / ratio);
  for (const double shift : {0.003, 0.01, 0.017, 0.02}) {
    const double A = ratio * p.clearance;
    const Periodic motion = motion_of(scene.contacts, {0.0, 0.0}, {A * std::cos(shift), 0.0},
                                      {A * std::sin(shift), 0.0});
    const auto spans = spans_of(scene.contacts, motion);
    ASSERT_EQ(spans.size(), 2u) << shift;
    EXPECT_NEAR(spans[0].from, shift + (spans[0].from < 1.0 ? 0.0 : pi) - b, rounding);
    EXPECT_NEAR(spans[0].to - spans[0].from, 2.0 * b, rounding);
    EXPECT_NEAR(spans[1].to - spans[1].from, 2.0 * b, rounding);
  }
}

TEST(TouchSpans, AreNoneOrOneWhereAWhirlNeverOrAlwaysTouches) {
  const MassInRing p{.Omega = 100.0, .mu = 0.2, .R = 2e-3};
  const Scene scene = p.scene();
  const auto whirl_of = [&](double radius, double sense) {
    return spans_of(scene.contacts,
                    motion_of(scene.contacts, {0.0, 0.0}, {radius, 0.0}, {0.0, sense * radius}));
  };
  EXPECT_TRUE(whirl_of(0.9 * p.clearance, 1.0).empty());
  // slip Omega (R + A) forward, Omega (R - A) backward
  const struct {
    double radius, sense, sign;
  } cases[] = {{1.5e-3, 1.0, 1.0}, {1.5e-3, -1.0, 1.0}, {3e-3, 1.0, 1.0}, {3e-3, -1.0, -1.0}};
  for (const auto& [radius, sense, sign] : cases) {
    const auto spans = whirl_of(radius, sense);
    ASSERT_EQ(spans.size(), 1u);
    EXPECT_TRUE(spans[0].is_whole());
    EXPECT_EQ(spans[0].sign, sign) << radius << " " << sense;
    EXPECT_NEAR(spans[0].to - spans[0].from, 2.0 * pi, rounding);
  }
}

// Pressed to a flat stop and moved along it, y = B sin theta: the slip Omega (R + B cos theta)
// changes its sign where cos theta = -R / B, without a touch or a release.
TEST(TouchSpans, AreCutWhereTheSlipTurnsBack) {
  const MassInRing p{.Omega = 100.0, .mu = 0.2, .R = 2e-3};
  Model m = p.model();
  m.contacts[0].geometry = geometry::Stop{.angle = 0.0};
  const Scene scene = make_scene(m);
  const double B = 2.0 * p.R, turn = std::acos(-p.R / B);
  const auto spans = spans_of(
      scene.contacts, motion_of(scene.contacts, {1.5 * p.clearance, 0.0}, {0.0, 0.0}, {0.0, B}));
  ASSERT_EQ(spans.size(), 2u);
  EXPECT_NEAR(spans[0].from, turn, rounding);
  EXPECT_NEAR(spans[0].to, 2.0 * pi - turn, rounding);
  EXPECT_EQ(spans[0].sign, -1.0);
  EXPECT_NEAR(spans[1].from, 2.0 * pi - turn, rounding);
  EXPECT_NEAR(spans[1].to, 2.0 * pi + turn, rounding);
  EXPECT_EQ(spans[1].sign, 1.0);
  for (const auto& span : spans) {
    EXPECT_FALSE(span.begins);
    EXPECT_FALSE(span.ends);
    EXPECT_FALSE(span.is_whole());
  }
}

// Against a damped stop, x = A cos theta touches at the surface, theta = -arccos(c / A), and lets
// go where the force ends: with g = c_C w / k
//   A cos theta - c - g A sin theta = 0,
//   theta = arccos(c / (A (1 + g^2)^(1/2))) - arctan g
TEST(TouchSpans, EndWhereTheForceOfADampedContactDoes) {
  const double g = 0.2, Omega = 50.0, kC = 1e5;
  for (const int period : {1, 2}) {
    const MassInRing p{.Omega = Omega, .kC = kC, .cC = g * kC / Omega * period};
    Model m = p.model();
    m.contacts[0].geometry = geometry::Stop{.angle = 0.0};
    const Scene scene = make_scene(m);
    const double ratio = 1.5;
    const auto spans = spans_of(
        scene.contacts,
        motion_of(scene.contacts, {0.0, 0.0}, {ratio * p.clearance, 0.0}, {0.0, 0.0}, period));
    ASSERT_EQ(spans.size(), 1u) << period;
    const double end = std::acos(1.0 / (ratio * std::sqrt(1.0 + g * g))) - std::atan(g);
    EXPECT_NEAR(spans[0].from, 2.0 * pi - std::acos(1.0 / ratio), rounding);
    EXPECT_NEAR(spans[0].to, 2.0 * pi + end, rounding);
    EXPECT_TRUE(spans[0].begins);
    EXPECT_TRUE(spans[0].ends);
  }
}

// A whirl of radius A about the middle of the ring, once in so many revolutions.
TEST(TouchSpans, KnowTheContactAtAnAngle) {
  const MassInRing p{.Omega = 100.0, .kC = 1e6, .mu = 0.2, .R = 2e-3, .offset = {3e-4, -2e-4}};
  const Scene scene = p.scene();
  const double A = 1.5e-3;
  for (const int period : {1, 3}) {
    const Periodic motion = motion_of(scene.contacts, p.offset, {A, 0.0}, {0.0, A}, period);
    const PeriodicContact path(scene.contacts.contacts()[0], motion);
    for (const double theta : {0.0, 1.0, 4.0}) {
      const ContactForces f = path.at(theta);
      EXPECT_NEAR(f.n(0), std::cos(theta), of_forces);
      EXPECT_NEAR(f.n(1), std::sin(theta), of_forces);
      EXPECT_NEAR(f.r, A, of_forces * A);
      EXPECT_NEAR(f.depth, A - p.clearance, of_forces * A);
      EXPECT_NEAR(f.rate, 0.0, of_forces * A * p.Omega);
      EXPECT_NEAR(f.slip, p.Omega * (p.R + A / period), of_forces);
      EXPECT_NEAR(f.normal, p.kC * (A - p.clearance), of_forces * p.kC * A);
      EXPECT_EQ(f.friction, 0.0);
    }
  }
}

}  // namespace whirl::touch_spans_test
