// Rolling bearings: loads of their elements in closed form, motions over many of them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "libbase/error.hpp"
#include "libbase/numerics/spectrum.hpp"
#include "libdyn/motions/simulate.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libdyn/system/running_bearing.hpp"
#include "libdyn/taylor/batch.hpp"
#include "tests/support/law_proofs.hpp"
#include "tests/support/rotor_in_bearing.hpp"

namespace whirl::rolling_bearing_test {

using test::RotorInBearing;

constexpr double digits = 1e-8;  // of reference numbers with nine digits, relative

/// A bearing under a downward force, at rest.
RunningBearing loaded(const RollingBearing& bearing, double force) {
  const RotorInBearing rotor{
      .Omega = 0.0, .m = 1.0, .U = 0.0, .gravity = force, .bearing = bearing};
  const auto rest = FilmEquilibrium(rotor.model()).at(0.0);
  EXPECT_NEAR(rest->rolling.at(0).load(1), -force, 1e-9 * force);
  return rest->rolling.at(0);
}

RollingBearing row(int elements, bool one_is_below, double clearance = 0.0) {
  RollingBearing b = RotorInBearing::balls();
  b.elements = elements;
  b.clearance = clearance;
  b.cage_angle = -0.5 * std::numbers::pi + (one_is_below ? 0.0 : std::numbers::pi / b.elements);
  return b;
}

// Sums over few balls: Q_max / F = 1 / sum cos^2.5, in closed form.
TEST(RollingBearings, ShareALoadAmongFewBalls) {
  struct Row {
    int elements;
    bool one_is_below;
    double largest, by_shift;
  };
  for (const Row& r :
       {Row{8, true, .54321362, 1.840896415}, Row{8, false, .48737819, 1.822035913},
        Row{9, true, .48724534, 2.052354176}, Row{9, false, .44101153, 2.065517031}}) {
    const RunningBearing b = loaded(row(r.elements, r.one_is_below), 1000.0);
    EXPECT_NEAR(b.largest / 1000.0, r.largest, digits);
    const double shift = -b.place(1);
    EXPECT_NEAR(1000.0 / (1e10 * std::pow(shift, 1.5)), r.by_shift, digits * r.by_shift);
    EXPECT_NEAR(b.stiffness(1, 1), 1.5 * 1000.0 / shift, 1e-7 * b.stiffness(1, 1));
    EXPECT_NEAR(b.place(0), 0.0, 1e-9 * shift);
  }
}

TEST(RollingBearings, ShareALoadBeyondTheirClearance) {
  const RunningBearing below = loaded(row(8, true, 20e-6), 1000.0);
  EXPECT_NEAR(-below.place(1), 26.16039512e-6, digits * 26e-6);
  EXPECT_EQ(below.loaded, 3);
  EXPECT_NEAR(below.elements[0], 649.647786, 1e-6);
  EXPECT_NEAR(below.elements[1], 247.736426, 1e-6);
  EXPECT_NEAR(below.elements[7], 247.736426, 1e-6);
  const RunningBearing between = loaded(row(8, false, 20e-6), 1000.0);
  EXPECT_NEAR(-between.place(1), 26.30906049e-6, digits * 26e-6);
  EXPECT_EQ(between.loaded, 4);
  EXPECT_NEAR(between.largest, 541.122583, 1e-6);
  EXPECT_NEAR(between.elements[1], .177485, 1e-6);
}

// Very many elements have the integrals over the load zone of Harris' tables.
TEST(RollingBearings, HaveTheLoadZonesOfManyElements) {
  struct Zone {
    double factor, ball, roller;  // load factor, radial integrals
  };
  for (const Zone& z : {Zone{.5, .2288279, .2447986}, Zone{.8, .2559024, .2654923},
                        Zone{1.0, .2546479, .2525301}}) {
    for (const bool is_ball : {true, false}) {
      RollingBearing b = is_ball ? RotorInBearing::balls() : RotorInBearing::rollers();
      b.elements = 200;
      const double shift = 20e-6, play = (1.0 - 2.0 * z.factor) * shift;
      b.clearance = 2.0 * std::max(play, 0.0);
      b.preload = 2.0 * std::max(-play, 0.0);
      const RunningBearing found = running_bearing(contact_of(b, {}, {}), Vec2(shift, 0.0), {});
      const double integral = found.load(0) / (b.elements * found.largest);
      EXPECT_NEAR(integral, is_ball ? z.ball : z.roller, 2e-5) << z.factor;
    }
  }
}

TEST(RollingBearings, TurnTheirCagesAndPassTheirRaces) {
  RollingBearing b;
  b.elements = 9;
  b.element_diameter = 7.94e-3;
  b.pitch_diameter = 39.04e-3;
  BearingFrequencies f = bearing_frequencies(b);
  EXPECT_NEAR(f.cage, .3983094, 5e-8);
  EXPECT_NEAR(f.outer, 3.5847848, 5e-8);
  EXPECT_NEAR(f.inner, 5.4152152, 5e-8);
  EXPECT_NEAR(f.spin, 2.3567477, 5e-8);
  b.elements = 8;
  b.element_diameter = 12e-3;
  b.pitch_diameter = 52e-3;
  b.contact_angle = 15.0 * std::numbers::pi / 180.0;
  f = bearing_frequencies(b);
  EXPECT_NEAR(f.cage, .3885470, 5e-8);
  EXPECT_NEAR(f.outer, 3.1083762, 5e-8);
  EXPECT_NEAR(f.inner, 4.8916238, 5e-8);
  EXPECT_NEAR(f.spin, 2.0590114, 5e-8);
}

// Ball on plane: k = 4/3 E* R^(1/2). Ellipses: within the accuracy of the formulas of Brewe and
// Hamrock, which need no integrals.
TEST(RollingBearings, AreAsStiffAsHertzSays) {
  constexpr double E = 207e9, nu = 0.3, D = 0.02;
  const double reduced = E / (2.0 * (1.0 - nu * nu));
  const double flat = 4.0 / 3.0 * reduced * std::sqrt(0.5 * D);
  EXPECT_NEAR(ball_on_race(D, 1e-9, 1e9, E, nu), flat, 1e-6 * flat);
  for (const double conformity : {0.515, 0.52, 0.54}) {
    const double groove = conformity * D, along = 2.0 / D * 0.25;
    const double rx = 1.0 / (2.0 / D + along), ry = 1.0 / (2.0 / D - 1.0 / groove);
    const double ratio = ry / rx, R = 1.0 / (1.0 / rx + 1.0 / ry);
    const double k = 1.0339 * std::pow(ratio, 0.636);
    const double first = 1.5277 + 0.6023 * std::log(ratio), second = 1.0003 + 0.5968 / ratio;
    const double expected =
        std::numbers::pi * k * 2.0 * reduced * std::sqrt(R * second / (4.5 * std::pow(first, 3)));
    EXPECT_NEAR(ball_on_race(D, along, groove, E, nu), expected, 0.03 * expected);
  }
}

// 300 random states and instants.
TEST(RollingBearings, AddTheForcesOfTheirEquations) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (const RotorInBearing& rotor : test::rotors_in_bearings()) {
    const Scene scene = rotor.scene();
    int pressed = 0;
    for (int i = 0; i < 300; ++i) {
      const Vec2 u = 1e-5 * Vec2(any(random), any(random)),
                 v = 0.01 * Vec2(any(random), any(random));
      const Instant at(3.0 + 3.0 * any(random), i);
      Vec y(4), a(2);
      y << u, v;
      scene.contacts.acceleration(at, y.data(), a.data());
      const double turned = at.phase + 2.0 * std::numbers::pi * i;
      const Vec2 expected = rotor.acceleration(turned, u, v);
      EXPECT_LT((a - expected).norm(), 1e-8 * expected.norm());
      for (const ContactState& c : scene.contacts.classify(at, y.data())) {
        pressed += c.in_touch() ? 1 : 0;
      }
    }
    EXPECT_GT(pressed, 200);
  }
}

MotionState settled(const RotorInBearing& rotor, const Scene& scene, long revolutions) {
  MotionState state = test::start_of(rotor.model(), scene);
  const Integration run = test::run(scene, state, revolutions, {.tolerance = 1e-12});
  EXPECT_EQ(run.outcome, Outcome::reached_end) << run.failure;
  return state;
}

class BearingsByMethod : public ::testing::TestWithParam<std::pair<const char*, double>> {};
INSTANTIATE_TEST_SUITE_P(Methods, BearingsByMethod,
                         ::testing::Values(std::pair("dop853", 1e-6),
                                           std::pair("cvode_adams", 1e-3),
                                           std::pair("arkode", 1e-5)),
                         [](const auto& member) { return member.param.first; });

TEST_P(BearingsByMethod, MoveAsInQuadruplePrecision) {
  const auto [name, accuracy] = GetParam();
  for (const RotorInBearing& rotor : test::rotors_in_bearings()) {
    const Scene scene = rotor.scene();
    const test::Stretch s{scene, settled(rotor, scene, 10), 1, 4};
    test::expect_end_by(name, s, test::exact_end(s, 1e-18), accuracy);
  }
}

TEST(RollingBearings, ErrorFollowsTheTolerance) {
  for (const RotorInBearing& rotor : test::rotors_in_bearings()) {
    const Scene scene = rotor.scene();
    const test::Stretch s{scene, settled(rotor, scene, 10), 1, 4};
    test::expect_error_follows_tolerance(s, test::exact_end(s, 1e-20));
  }
}

TEST(RollingBearings, InABatchAreBitwiseTheSameAsAlone) {
  for (const RotorInBearing& like : test::rotors_in_bearings()) {
    std::vector<Scene> scenes;
    std::vector<MotionState> starts;
    for (int i = 0; i < 11; ++i) {
      RotorInBearing rotor = like;
      rotor.Omega = i == 5 ? 0.0 : 430.0 + 9.0 * i;  // one stands still
      rotor.bearing.clearance *= 1.0 + 0.02 * i;
      rotor.bearing.cage_ratio += 0.001 * i;
      rotor.gravity = i % 4 == 0 ? 0.0 : 30.0;
      scenes.push_back(rotor.scene());
      starts.push_back(test::start_of(rotor.model(), scenes.back()));
    }
    test::expect_same_alone(scenes, starts, 1e-8, 100);
  }
}

TEST(RollingBearings, HaveTangentsThatAreLimitsOfDifferences) {
  for (const RotorInBearing& rotor : test::rotors_in_bearings()) {
    const Scene scene = rotor.scene();
    test::expect_tangent_of_differences({scene, settled(rotor, scene, 10), 1, 4}, 1e-5);
    test::expect_divergence({scene, settled(rotor, scene, 10), 1, 4});
  }
}

TEST(RollingBearings, MoveByRk4AsByTaylorSeries) {
  for (const RotorInBearing& rotor : test::rotors_in_bearings()) {
    const Scene scene = rotor.scene();
    const MotionState start = settled(rotor, scene, 10);
    MotionState exact = start;
    test::run(scene, exact, 2, {.tolerance = 1e-13});
    const double h = scene.contacts.period() / 20000.0;
    std::vector<Trajectory> lanes(3, {.system = &scene.contacts, .state = start, .revolutions = 2});
    integrate_batch_rk4(lanes, {.fixed_step = h});
    EXPECT_LT(distance(scene.contacts, lanes[2].state.y, exact.y), 1e-5);
    MotionState alone = start;
    test::run(scene, alone, 2, {.fixed_step = h, .method = Rk4{}});
    EXPECT_LT(distance(scene.contacts, lanes[2].state.y, alone.y), 1e-9);
  }
}

// Turned so slowly that it is at rest at every instant, a bearing has the loads of both places of
// its balls, and moves once for each of them that passes below.
TEST(RollingBearings, MoveAsTheirBallsPass) {
  RotorInBearing rotor{.Omega = 0.02,
                       .m = 1.0,
                       .c = 2e4,
                       .U = 0.0,
                       .gravity = 1000.0,
                       .bearing = row(8, true, 20e-6)};
  const Scene scene = rotor.scene();
  constexpr int samples = 1024;
  const Recording seen = simulate(scene, test::start_of(rotor.model(), scene),
                                  {.revolutions = 8, .discard = 1, .samples = samples / 8})
                             .recording;
  const Vec below = -(scene.contacts.contacts()[0].U * seen.eta).row(1).transpose();
  EXPECT_NEAR(below.minCoeff(), 26.16039512e-6, 1e-6 * 26e-6);
  EXPECT_NEAR(below.maxCoeff(), 26.30906049e-6, 1e-6 * 26e-6);
  // 8 revolutions are 3 of the cage, in which 24 balls pass
  double largest = 0.0;
  int at = 0;
  for (int k = 1; k < 100; ++k) {
    Complex sum = 0.0;
    for (Eigen::Index j = 0; j < seen.eta.cols(); ++j) {
      sum += below(j) *
             std::polar(1.0, -2.0 * std::numbers::pi * k * double(j) / double(seen.eta.cols()));
    }
    if (std::abs(sum) <= largest) continue;
    largest = std::abs(sum);
    at = k;
  }
  EXPECT_EQ(at, 24);
}

// The whole repeats when the elements are where others were: of eight that turn by 3/8 in each
// revolution, every time.
TEST(RollingBearings, RepeatWithTheirElements) {
  RotorInBearing rotor;
  EXPECT_EQ(rotor.scene().contacts.repeats_after(), 1);
  rotor.waves = {{.race = Race::outer, .order = 9.0, .height = 0.5e-6}};
  EXPECT_EQ(rotor.scene().contacts.repeats_after(), 1);
  rotor.bearing.cage_ratio = 0.4;
  EXPECT_EQ(rotor.scene().contacts.repeats_after(), 5);
  rotor.bearing.cage_ratio = 0.3983094;
  EXPECT_EQ(rotor.scene().contacts.repeats_after(), 0);
}

// Linear analyses have the stiffness about the place of rest: small motions are theirs.
TEST(RollingBearings, AreLinearAboutTheirPlaceOfRest) {
  const RotorInBearing rotor{.Omega = 0.0, .U = 0.0, .gravity = 500.0};
  const Model model = rotor.model();
  const Modes modes = linear_modes(model, make_scene(model), 2);
  const RunningBearing rest = FilmEquilibrium(model).at(0.0)->rolling.at(0);
  ASSERT_EQ(modes.oscillatory.size(), 2u);
  const double w = modes.oscillatory[0].frequency();
  EXPECT_NEAR(w,
              std::sqrt(std::min(rest.stiffness(0, 0), rest.stiffness(1, 1)) / rotor.m -
                        std::pow(0.5 * rotor.c / rotor.m, 2)),
              1e-9 * w);
}

}  // namespace whirl::rolling_bearing_test
