// What every contact geometry must obey, run over the list of geometries.

#include "libcontact/geometries.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <variant>

#include "libbase/numerics/dual.hpp"

namespace whirl::geometries_test {

constexpr double rounding = 1e-14;    // relative, of a few operations
constexpr double differences = 1e-7;  // of central differences over 1e-6 of a length
constexpr double Omega = 40.0;        // [rad/s]
constexpr double phase = 0.7;
constexpr ContactSpace space{.clearance = 1e-3, .rim_speed = 0.3};

geometry::Ring sample(geometry::Ring) {
  return {};
}
geometry::Face sample(geometry::Face) {
  return {.radius = 0.05};
}
geometry::BladeRow sample(geometry::BladeRow) {
  return geometry::BladeRow{.blades = 3, .tip = 0.1}.place(1, {.at = Omega, .phase_rate = Omega});
}

geometry::RollingElements sample(geometry::RollingElements) {
  return geometry::RollingElements{
      .elements = 5,
      .play = 1e-3,
      .cage = 0.4,
      .first = 0.2,
      .shapes = {{.is_inner = true, .height = 2e-4, .order = 7.0, .angle = 0.3},
                 {.height = -5e-4, .angle = 0.5, .sharpness = 40.0}}}
      .place(0, {.at = Omega, .against = -0.5 * Omega, .phase_rate = Omega});
}

geometry::Stop sample(geometry::Stop) {
  return {.angle = 0.4};
}

geometry::Ellipse sample(geometry::Ellipse) {
  return {.angle = 0.4, .aspect = 1.3};
}

/// A motion that is beyond the surface of every sample: d, its rate, and the velocity in the slip.
struct Motion {
  Vec2 d, w, v;
};
template <class G>
Motion motion_of(const G& g) {
  const Vec2 d(1.3e-3, 0.9e-3), w(0.4, -0.2);
  return {d, w, g.rubs_apart ? Vec2(0.1, 0.5) : w};
}

template <class G>
ContactGap<double> gap_of(const G& g, double at, const Motion& m) {
  return g.gap(space, at, GapMotion<double>{{m.d(0), m.d(1)}, {m.w(0), m.w(1)}, {m.v(0), m.v(1)}});
}

/// Limits of signals are no places: their depth follows from rates, too.
template <class G>
using IfPlace =
    std::conditional_t<std::is_same_v<G, geometry::Saturation>, std::tuple<>, std::tuple<G>>;
template <class Tuple>
struct TypesOf;
template <class... Geometries>
struct TypesOf<std::tuple<Geometries...>> {
  using Types = ::testing::Types<Geometries...>;
};
template <class Variant>
struct Every;
template <class... Geometries>
struct Every<std::variant<Geometries...>>
    : TypesOf<decltype(std::tuple_cat(std::declval<IfPlace<Geometries>>()...))> {};
template <class G>
struct EveryGeometry : ::testing::Test {
  const G geometry = sample(G{});
  const Motion motion = motion_of(geometry);
};
TYPED_TEST_SUITE(EveryGeometry, Every<AnyGeometry>::Types);

// A signal is compared with both of its limits.
TEST(Saturation, IsBeyondOneOfItsLimits) {
  const Motion m{Vec2(0.7e-3, 9.0), Vec2(9.0, 9.0), Vec2(-2.5e-3, 9.0)};
  const ContactSpace limit{.clearance = 1e-3};
  const auto at = [&](int place) {
    return geometry::Saturation().place(place, {}).gap(
        limit, phase, GapMotion<double>{{m.d(0), m.d(1)}, {m.w(0), m.w(1)}, {m.v(0), m.v(1)}});
  };
  EXPECT_DOUBLE_EQ(at(0).depth, -1.8e-3 - 1e-3);
  EXPECT_DOUBLE_EQ(at(1).depth, 1.8e-3 - 1e-3);
  EXPECT_EQ(at(1).n[0], -1.0);
}

// A place that turns moves with the phase, too.
TYPED_TEST(EveryGeometry, SaysTheRateOfItsDepth) {
  const Motion& m = this->motion;
  const double h = 1e-6 * space.clearance / m.w.norm();
  const auto depth = [&](double t) {
    return gap_of(this->geometry, phase + Omega * t, {m.d + t * m.w, m.w, m.v}).depth;
  };
  const double expected = (depth(h) - depth(-h)) / (2.0 * h);
  EXPECT_NEAR(gap_of(this->geometry, phase, m).rate, expected, differences * std::abs(expected));
}

// The normal force does no work but on the depth, and friction none but on the slip.
TYPED_TEST(EveryGeometry, PushesAlongTheSlopesOfDepthAndSlip) {
  using D = Dual<6>;
  const Motion& m = this->motion;
  GapMotion<D> dual;
  for (int i = 0; i < 2; ++i) {
    const auto k = static_cast<std::size_t>(i);
    dual.d[k] = D::variable(m.d(i), i);
    dual.w[k] = D::variable(m.w(i), 2 + i);
    dual.v[k] = D::variable(m.v(i), 4 + i);
  }
  const auto gap = this->geometry.gap(space, phase, dual);
  const auto plain = gap_of(this->geometry, phase, m);
  EXPECT_EQ(gap.depth.value, plain.depth);
  EXPECT_EQ(gap.rate.value, plain.rate);
  EXPECT_EQ(gap.slip.value, plain.slip);
  const Vec2 n(plain.n[0], plain.n[1]), t(-n(1), n(0));
  if (!TypeParam::is_wall) {
    EXPECT_NEAR(n.norm(), 1.0, rounding);
  }
  EXPECT_LT((gap.depth.slopes.template head<2>() - n).norm(), rounding);
  EXPECT_LT(gap.depth.slopes.template tail<4>().norm(), rounding);
  EXPECT_LT((gap.rate.slopes.template segment<2>(2) - n).norm(), rounding);
  // friction sees a velocity of its own, or that of the place
  EXPECT_LT(
      (gap.slip.slopes.template segment<2>(2) + gap.slip.slopes.template tail<2>() - t).norm(),
      rounding);
}

TYPED_TEST(EveryGeometry, IsBeyondItsSurfaceWhereTheDepthIsPositive) {
  const auto beyond = [&](double scale) {
    const auto gap =
        gap_of(this->geometry, phase, {scale * this->motion.d, this->motion.w, this->motion.v});
    return std::pair(gap.depth, this->geometry.beyond(gap, space));
  };
  for (const double scale : {0.1, 0.5, 0.9, 1.0, 1.5}) {
    const auto [depth, value] = beyond(scale);
    EXPECT_EQ(depth > 0.0, value > 0.0) << scale;
    EXPECT_LT(std::abs(value), 10.0);
  }
}

TYPED_TEST(EveryGeometry, IsAPolynomialAlongAPathIfItSaysSo) {
  const Vec x = (Vec(3) << 0.9, -0.4, 0.3).finished(), y = (Vec(3) << 0.2, 0.7, -1.1).finished();
  const auto along = this->geometry.beyond(x, y);
  EXPECT_EQ(along.has_value(), !TypeParam::turns);
  if (!along) return;
  for (double s = 0.0; s <= 1.0; s += 0.125) {
    const Vec2 d(x(0) + s * (x(1) + s * x(2)), y(0) + s * (y(1) + s * y(2)));
    const auto gap =
        gap_of(this->geometry, phase, {space.clearance * d, this->motion.w, this->motion.v});
    EXPECT_NEAR((*along)(s), this->geometry.beyond(gap, space), 10.0 * rounding) << s;
  }
}

// A wall has a slope of length one where it is touched.
TYPED_TEST(EveryGeometry, HasAUnitNormalOnItsSurface) {
  const AnyGeometry any = this->geometry;
  if (direction_of(any) || turns(any)) return;  // a plane's is everywhere
  for (const double angle : {0.0, 0.7, 2.0, 4.0}) {
    const Vec2 along(std::cos(angle), std::sin(angle));
    const Vec2 on = reach_of(any, space.clearance, along) * along;
    const auto gap = gap_of(this->geometry, phase, {on, this->motion.w, this->motion.v});
    EXPECT_NEAR(gap.depth, 0.0, rounding * space.clearance);
    EXPECT_NEAR(std::hypot(gap.n[0], gap.n[1]), 1.0, rounding);
    EXPECT_NEAR(distance_of(any, space.clearance, on), space.clearance, rounding * space.clearance);
  }
}

TYPED_TEST(EveryGeometry, IsOneOfThePlacesOfAContact) {
  EXPECT_GE(this->geometry.places(), 1);
  const AnyGeometry any = this->geometry;
  EXPECT_EQ(place_of(any, 0, {.at = Omega}).index(), any.index());
  EXPECT_TRUE(any == AnyGeometry(this->geometry));
  // the one direction of a plane is its normal
  if (const auto direction = direction_of(any)) {
    const auto gap = gap_of(this->geometry, phase, this->motion);
    EXPECT_LT((Vec2(gap.n[0], gap.n[1]) - *direction).norm(), rounding);
  }
}

template <class... Geometries>
std::set<std::string> names_of(std::variant<Geometries...>) {
  return {std::string(Geometries::name)...};
}

TEST(Geometries, HaveNamesOfTheirOwn) {
  EXPECT_EQ(names_of(AnyGeometry{}).size(), std::variant_size_v<AnyGeometry>);
}

}  // namespace whirl::geometries_test
