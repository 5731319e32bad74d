// Tips of blades against a ring: contact points that turn with the rotor.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "libbase/error.hpp"
#include "libcontact/blade.hpp"
#include "libdyn/motions/simulate.hpp"
#include "libdyn/taylor/batch.hpp"
#include "tests/support/law_proofs.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::blade_tip_test {

/// A bladed disk on a spring, coordinates x, y; critical speed 500 rad/s.
struct BladedDisk {
  double Omega = 450.0;
  double m = 2.0, k = 5e5, c = 300.0, U = 3e-5, phase = 0.0, gravity = 25.0;
  int blades = 5;
  double Rt = 0.1, gap = 1e-4, kh = 1e10, EI = 20.0;
  double mu = 0.1;
  Slip slip = Slip::forward;
  double tolerance = 0.0;
  bool has_seal = false;  ///< a ring of Hertz contact beside, with the same clearance

  BladeTip<> law() const {
    return {.blades = blades,
            .tip_radius = Rt,
            .blade_length = 0.04,
            .bending_stiffness = EI,
            .line_density = 0.5,
            .k = kh};
  }
  Model model() const {
    Model s;
    s.speed = Omega;
    s.has_speed = true;
    s.structure.bodies = {{.name = "disk", .m = m, .spins = true}};
    s.structure.bearings = {test::bearing(test::body("disk"), test::isotropic(k, c))};
    s.structure.unbalances = {{.at = test::body("disk"), .moment = U, .phase = phase}};
    s.structure.gravity = gravity;
    s.contacts = {{.name = "tips",
                   .at = test::body("disk"),
                   .clearance = gap,
                   .friction = {.mu = mu, .slip = slip, .tolerance = tolerance},
                   .law = law()}};
    if (has_seal) {
      s.contacts.push_back({.name = "seal",
                            .at = test::body("disk"),
                            .clearance = gap,
                            .friction = {.mu = 0.1, .slip = Slip::forward},
                            .law = Hertz<>{.k = 5e9}});
    }
    return s;
  }
  Scene scene() const { return make_scene(model()); }

  /// N of d = (N / k)^(2/3) + c_b N^2, by bisection.
  double normal(double d) const {
    if (d <= 0.0) return 0.0;
    const double cb = blade_shortening(law(), mu, Omega);
    double low = 0.0, high = kh * std::pow(d, 1.5);
    for (int i = 0; i < 100; ++i) {
      const double N = 0.5 * (low + high);
      (std::pow(N / kh, 2.0 / 3.0) + cb * N * N < d ? low : high) = N;
    }
    return low;
  }
  /// Accelerations, blade by blade, with D = u + Rt e of the tip.
  Vec2 acceleration(double angle, const Vec2& u, const Vec2& v) const {
    Vec2 f = U * Omega * Omega * Vec2(std::cos(angle + phase), std::sin(angle + phase)) - k * u -
             c * v - Vec2(0.0, m * gravity);
    for (int i = 0; i < blades; ++i) {
      const double a = angle + 2.0 * std::numbers::pi * i / blades;
      const Vec2 e(std::cos(a), std::sin(a)), D = u + Rt * e, n = D / D.norm(), t(-n(1), n(0));
      const Vec2 tip_velocity = v + Omega * Rt * Vec2(-e(1), e(0));
      const double N = normal(D.norm() - Rt - gap);
      const double share = slip == Slip::forward ? 1.0 : std::tanh(t.dot(tip_velocity) / tolerance);
      f -= N * n + mu * share * N * t;
    }
    return f / m;
  }
};

const BladedDisk rubbing;
BladedDisk without_gravity() {
  BladedDisk p;
  p.gravity = 0.0;
  p.U = 1.5e-4;
  return p;
}
/// Blades that bend so far that they shorten more than their tips are indented.
BladedDisk with_soft_blades() {
  BladedDisk p;
  p.EI = 0.2;
  return p;
}
BladedDisk smoothed(double tolerance) {
  BladedDisk p;
  p.slip = Slip::actual;
  p.tolerance = tolerance;
  return p;
}
BladedDisk in_a_seal() {
  BladedDisk p;
  p.has_seal = true;
  return p;
}

MotionState settled(const BladedDisk& p, const Scene& scene, long revolutions) {
  MotionState state = test::start_of(p.model(), scene);
  const Integration run = test::run(scene, state, revolutions, {.tolerance = 1e-12});
  EXPECT_EQ(run.outcome, Outcome::reached_end) << run.failure;
  return state;
}

// 300 random states and angles, most of them with a blade or two in touch.
TEST(BladeTips, AddTheForcesOfTheirEquations) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (const BladedDisk& p : {rubbing, smoothed(30.0)}) {
    const Scene scene = p.scene();
    int touching = 0;
    for (int i = 0; i < 300; ++i) {
      const Vec2 u = 1.2 * p.gap * Vec2(any(random), any(random));
      const Vec2 v = 0.05 * Vec2(any(random), any(random));
      const double angle = 3.0 * any(random);
      Vec y(4), a(2);
      y << u, v;
      scene.contacts.acceleration(angle, y.data(), a.data());
      const Vec2 expected = p.acceleration(angle, u, v);
      EXPECT_LT((a - expected).norm(), 1e-9 * expected.norm());  // 1e-17 m of a depth of 1e-6 m
      for (const ContactState& c : scene.contacts.classify(angle, y.data())) {
        touching += c.in_touch() ? 1 : 0;
      }
    }
    EXPECT_GT(touching, 80);
  }
}

class BladesByMethod : public ::testing::TestWithParam<std::pair<const char*, double>> {};
INSTANTIATE_TEST_SUITE_P(Methods, BladesByMethod,
                         ::testing::Values(std::pair("dop853", 1e-7),
                                           std::pair("cvode_adams", 1e-4),
                                           std::pair("arkode", 1e-6)),
                         [](const auto& member) { return member.param.first; });

// Through impacts of several blades, against quadruple precision.
TEST_P(BladesByMethod, MoveAsInQuadruplePrecision) {
  const auto [name, accuracy] = GetParam();
  for (const BladedDisk& p : {rubbing, smoothed(30.0), in_a_seal(), with_soft_blades()}) {
    const Scene scene = p.scene();
    const test::Stretch s{scene, settled(p, scene, 30), 1, 4};
    test::expect_end_by(name, s, test::exact_end(s, 1e-18), accuracy);
  }
}

TEST(BladeTips, ErrorFollowsTheTolerance) {
  const Scene scene = rubbing.scene();
  const test::Stretch s{scene, settled(rubbing, scene, 30), 2, 7};
  test::expect_error_follows_tolerance(s, test::exact_end(s, 1e-20));
}

TEST(BladeTips, InABatchAreBitwiseTheSameAsAlone) {
  std::vector<Scene> scenes;
  std::vector<MotionState> starts;
  for (int i = 0; i < 21; ++i) {
    BladedDisk p = i % 3 == 0 ? smoothed(10.0 + i) : rubbing;
    p.Omega = i == 5 ? 0.0 : 430.0 + 3.0 * i;  // one stands still
    p.gap *= 1.0 + 0.01 * i;
    p.mu = i % 4 == 0 ? 0.0 : 0.1;
    p.has_seal = true;
    scenes.push_back(p.scene());
    starts.push_back(test::start_of(p.model(), scenes.back()));
  }
  test::expect_same_alone(scenes, starts, 1e-8, 300);
}

TEST(BladeTangent, IsTheLimitOfDifferences) {
  constexpr double accurate = 1e-5;  // relative, as of other contacts that are as stiff
  for (const BladedDisk& p : {rubbing, smoothed(30.0), in_a_seal()}) {
    const Scene scene = p.scene();
    test::expect_tangent_of_differences({scene, settled(p, scene, 30), 1, 4}, accurate);
  }
}

// A single blade without friction in line with the unbalance: the disk turns round with it, pressed
// for good; in the turning frame at rest:
//
//   U Omega^2 + m u Omega^2 = k u + N(u - c)
TEST(BladeTips, PressAsInClosedFormWhileTheDiskTurnsWithThem) {
  BladedDisk p = without_gravity();
  p.blades = 1;
  p.mu = 0.0;
  p.c = 0.0;
  const double W2 = p.Omega * p.Omega;
  double low = p.gap, high = 2.0 * p.gap;
  for (int i = 0; i < 200; ++i) {
    const double u = 0.5 * (low + high);
    (p.U * W2 + p.m * u * W2 - p.k * u - p.kh * std::pow(u - p.gap, 1.5) > 0.0 ? low : high) = u;
  }
  const Scene scene = p.scene();
  MotionState state = test::state_of(Vec2(low, 0.0), Vec2(0.0, p.Omega * low));
  ContactMeter meter(scene.contacts);
  const Integration run = test::run(scene, state, 3, {.tolerance = 1e-13}, [&](const Step& step) {
    meter.add(step);
    return true;
  });
  ASSERT_EQ(run.outcome, Outcome::reached_end) << run.failure;
  EXPECT_EQ(run.cost.events, 0);
  EXPECT_NEAR(state.y(0), low, 1e-10 * low);
  EXPECT_NEAR(state.y(1), 0.0, 1e-10 * low);
  const double N = p.kh * std::pow(low - p.gap, 1.5);
  EXPECT_NEAR(meter.measures().at(0).max_normal, N, 1e-8 * N);
  EXPECT_EQ(meter.measures().at(0).regime(), Regime::permanent);
}

// Without spin blades stand still: the disk comes to rest on the one below, m g = k u + N.
TEST(BladeTips, StandStillWithoutSpin) {
  BladedDisk p;
  p.Omega = 0.0;
  p.blades = 4;
  p.mu = 0.0;
  p.gravity = 50.0 * 9.81;
  p.c = 400.0;
  const Scene scene = p.scene();
  MotionState state = test::state_of(Vec2(0.0, 0.0), Vec2(0.0, 0.0));
  const Integration run = test::run(scene, state, 1, {});
  ASSERT_EQ(run.outcome, Outcome::reached_end) << run.failure;
  const double u = -state.y(1);
  EXPECT_GT(u, p.gap);
  EXPECT_NEAR(p.k * u + p.normal(u - p.gap), p.m * p.gravity, 1e-6 * p.m * p.gravity);
}

// Start and unbalance turned by the pitch of the blades: the end is turned by it.
TEST(BladeTips, AreAllAlike) {
  const BladedDisk p = without_gravity();
  BladedDisk turned = p;
  const double pitch = 2.0 * std::numbers::pi / p.blades;
  turned.phase = pitch;
  Eigen::Matrix2d R;
  R << std::cos(pitch), -std::sin(pitch), std::sin(pitch), std::cos(pitch);
  const Scene one = p.scene(), other = turned.scene();
  const Vec2 u(5e-5, -8e-5), v(0.02, 0.03);
  MotionState a = test::state_of(u, v), b = test::state_of(R * u, R * v);
  const Integration run = test::run(one, a, 3, {.tolerance = 1e-13});
  test::run(other, b, 3, {.tolerance = 1e-13});
  EXPECT_GT(run.cost.events, 6);
  EXPECT_LT((b.y.head(2) - R * a.y.head(2)).norm(), 1e-8 * p.gap);
}

// One contact of the model is one line of results: time with any blade in touch, impacts of all,
// the largest force on one; of the batch and of an observer alike.
TEST(BladeTips, AreMeasuredAsOneContact) {
  const BladedDisk p = in_a_seal();
  const Scene scene = p.scene();
  const MotionState start = settled(p, scene, 30);
  Trajectory t{.system = &scene.contacts, .state = start, .revolutions = 4};
  integrate_single(t, {.measures = true});
  ContactMeter meter(scene.contacts);
  double any = 0.0;
  MotionState state = start;
  test::run(scene, state, 4, {}, [&](const Step& step) {
    meter.add(step);
    const auto blades = step.contacts.begin() + p.blades;
    if (std::any_of(step.contacts.begin(), blades, [](auto c) { return c.in_touch(); }))
      any += step.h;
    return true;
  });
  const auto measures = meter.measures();
  ASSERT_EQ(measures.size(), 2u);
  ASSERT_EQ(t.contacts.size(), 2u);
  EXPECT_EQ(measures[0].name, "tips");
  EXPECT_EQ(measures[1].name, "seal");
  const double time = 4.0 * scene.contacts.period();
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_NEAR(measures[i].duty, t.contacts[i].in_touch / time, 1e-9);
    EXPECT_GT(measures[i].duty, 0.01);
    EXPECT_NEAR(measures[i].max_normal, t.contacts[i].max_normal, 1e-9 * t.contacts[i].max_normal);
    EXPECT_NEAR(measures[i].impacts, t.contacts[i].impacts, 1.0);
  }
  EXPECT_NEAR(measures[0].duty, any / time, 1e-12);
}

// What is recorded of a row of blades is the sum over all that touch: slipping forward, the
// friction is mu times the normal force, also while several press.
TEST(BladeTips, AreRecordedTogether) {
  constexpr double rounding = 1e-12;  // relative, of a sum over few blades
  BladedDisk p;
  p.blades = 40;
  const Scene scene = p.scene();
  constexpr int samples = 64;
  const Recording seen = simulate(scene, test::start_of(p.model(), scene),
                                  {.revolutions = 2, .discard = 20, .samples = samples})
                             .recording;
  int several = 0;
  for (Eigen::Index j = 0; j < seen.eta.cols(); ++j) {
    const double N = seen.normal(0, j);
    EXPECT_NEAR(seen.friction(0, j), p.mu * N, rounding * N);
    const Vec2 u = scene.contacts.contacts()[0].U * seen.eta.col(j);
    int pressing = 0;
    for (int i = 0; i < p.blades; ++i) {
      const double a = 2.0 * std::numbers::pi *
                       (static_cast<double>(j % samples) / samples + i / double(p.blades));
      pressing += (u + p.Rt * Vec2(std::cos(a), std::sin(a))).norm() > p.Rt + p.gap ? 1 : 0;
    }
    several += pressing > 1 ? 1 : 0;
  }
  EXPECT_GT(several, 0);
}

// Off the ring for good: the certificate sends it to its end in closed form, and rightly.
TEST(BladeTips, FlyOnWhereNoneCanTouchAgain) {
  BladedDisk p;
  p.U = 1e-6;
  p.gravity = 0.0;
  const Scene scene = p.scene();
  const MotionState start = test::state_of(Vec2(5e-5, 0.0), Vec2(0.0, 0.0));
  MotionState certified = start, stepped = start;
  const Integration jumped = test::run(scene, certified, 400, {.tolerance = 1e-12});
  const Integration watched =
      test::run(scene, stepped, 400, {.tolerance = 1e-12}, [](const Step&) { return true; });
  EXPECT_EQ(watched.cost.events, 0);
  EXPECT_LT(jumped.cost.steps, watched.cost.steps / 10);
  EXPECT_LT(distance(scene.contacts, certified.y, stepped.y), 1e-9);
}

// Fourth order per step while the same blade presses; lanes as alone.
TEST(BladeTips, MoveByRk4AloneAndInLanes) {
  BladedDisk p;
  p.blades = 1;
  p.mu = 0.05;
  p.gravity = 0.0;
  p.U = 2e-4;
  const Scene scene = p.scene();
  const MotionState start = settled(p, scene, 200);
  ASSERT_TRUE(start.contacts[0].in_touch());
  MotionState exact = start;
  test::run(scene, exact, 1, {.tolerance = 1e-14});
  std::vector<double> number, error;
  for (const double n : {1600.0, 3200.0, 6400.0}) {
    const double h = scene.contacts.period() / n;
    MotionState alone = start;
    test::run(scene, alone, 1, {.fixed_step = h, .method = Rk4{}});
    number.push_back(n);
    error.push_back(distance(scene.contacts, alone.y, exact.y));
    std::vector<Trajectory> lanes(3, {.system = &scene.contacts, .state = start, .revolutions = 1});
    integrate_batch_rk4(lanes, {.fixed_step = h});
    EXPECT_LT(distance(scene.contacts, lanes[2].state.y, alone.y), 1e-9);
  }
  EXPECT_NEAR(test::order_of(number, error), 4.0, 0.1);
}

// All geometries at one disk: against quadruple precision, and the tangent against differences.
TEST(BladeTips, RubBesideARingAndAFace) {
  Model model;
  model.speed = 450.0;
  model.has_speed = true;
  const Station end = test::node(2);
  model.structure = test::cantilever(test::massless_cylinder(0.2, 0.02, 1));
  model.structure.disks = {{.name = "disk", .at = end, .m = 2.0, .Id = 0.01, .Ip = 0.015}};
  model.structure.unbalances = {{.at = end, .moment = 3e-5}};
  model.structure.damping.stiffness = 5e-4;
  model.structure.gravity = 30.0;
  model.contacts = {{.name = "ring",
                     .at = end,
                     .clearance = 1.05e-4,
                     .friction = {.mu = 0.1, .radius = 0.02},
                     .law = Radial<>{.k = 1e6}},
                    {.name = "tips",
                     .at = end,
                     .clearance = 1e-4,
                     .friction = {.mu = 0.1, .slip = Slip::forward},
                     .law = rubbing.law()},
                    {.name = "face",
                     .at = end,
                     .clearance = 6e-5,
                     .friction = {.mu = 0.1, .slip = Slip::actual, .tolerance = 10.0},
                     .law = Face<>{.k = 1e6, .radius = 0.08}}};
  const Scene scene = make_scene(model);
  const ContactSystem& system = scene.contacts;
  MotionState start = test::start_of(model, scene);
  ContactMeter meter(system);
  const Integration run = test::run(scene, start, 20, {.tolerance = 1e-12}, [&](const Step& step) {
    meter.add(step);
    return true;
  });
  ASSERT_EQ(run.outcome, Outcome::reached_end) << run.failure;
  for (const ContactMeasure& m : meter.measures()) EXPECT_EQ(m.regime(), Regime::intermittent);
  const auto end_of = [&](const MotionState& from, double tolerance, bool tangent) {
    Trajectory t{.system = &system, .state = from, .revolutions = 1};
    integrate_single(t, {.tolerance = tolerance, .tangent = tangent});
    return t;
  };
  Trajectory exact{.system = &system, .state = start, .revolutions = 1};
  integrate_quad(exact, {.tolerance = 1e-18});
  ASSERT_EQ(exact.outcome, Outcome::reached_end) << exact.failure;
  EXPECT_GT(exact.cost.events, 6);
  const Trajectory t = end_of(start, 1e-13, true);
  EXPECT_LT(distance(system, t.state.y, exact.state.y), 1e-10);
  const Vec& scale = system.state_scale();
  constexpr double h = 1e-7;
  for (int i = 0; i < system.size(); ++i) {
    MotionState up = start, down = start;
    up.y(i) += h * scale(i);
    down.y(i) -= h * scale(i);
    const Vec change = end_of(up, 1e-14, false).state.y - end_of(down, 1e-14, false).state.y;
    const Vec column = t.tangent.col(i) * scale(i);
    const Vec left = (change / (2.0 * h) - column).cwiseQuotient(scale);
    EXPECT_LT(left.cwiseAbs().maxCoeff(), 1e-5 * std::max(1.0, column.cwiseQuotient(scale).norm()));
  }
}

TEST(BladeTips, AreNothingForCollocation) {
  const Scene scene = rubbing.scene();
  EXPECT_FALSE(prefers_collocation(scene.contacts));
  MotionState state = test::start_of(rubbing.model(), scene);
  EXPECT_THROW(test::run(scene, state, 1, {.method = Collocation{}}), ModelError);
}

// Systems of a batch share the number of blades.
TEST(BladeTips, OfOneBatchAreAsMany) {
  BladedDisk p = in_a_seal(), q = p;
  q.blades = 4;
  const Scene a = p.scene(), b = q.scene();
  std::vector<Trajectory> batch;
  for (const Scene* s : {&a, &b}) {
    batch.push_back(
        {.system = &s->contacts, .state = test::state_of(Vec::Zero(4)), .revolutions = 1});
  }
  EXPECT_THROW(integrate_batch(batch, {}), NumericalError);
}

}  // namespace whirl::blade_tip_test
