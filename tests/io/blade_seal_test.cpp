// models/blade_seal.toml: what "Dynamic response and stability of a blade rotor with coupled
// rubbing in the labyrinth seal and tip seal" tells in words, and numbers of independent programs
// of ours, as its own stand in figures.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>

#include "libdyn/motions/start.hpp"
#include "libdyn/studies/classify.hpp"
#include "libdyn/system/scene.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libfe/analyses/critical.hpp"
#include "libio/model/model_file.hpp"

namespace whirl::blade_seal_test {

constexpr double rpm = std::numbers::pi / 30.0;
constexpr double never = 1.0;  // a clearance [m]

Model bundled(double speed) {
  Model model = read_model(std::filesystem::path(WHIRL_SOURCE_DIR) / "models/blade_seal.toml");
  model.speed = speed * rpm;
  return model;
}
Model tips_alone(double speed) {
  Model model = bundled(speed);
  model.contacts.at(0).clearance = never;
  return model;
}
Model labyrinth_alone(double speed) {
  Model model = bundled(speed);
  model.contacts.at(1).clearance = never;
  return model;
}

Classification classified(const Model& model) {
  const Scene scene = make_scene(model);
  return classify(scene.contacts, start_state(model, scene, nullptr),
                  {.discard = 400, .revolutions = 150, .tolerance = 1e-9});
}

/// Influence of a force at a on the deflection at x of a simply supported beam, x <= a.
double influence(double x, double a, double L, double EI) {
  return (L - a) * x * (L * L - (L - a) * (L - a) - x * x) / (6.0 * EI * L);
}

/// Stiffness per plane of (x1, x2, slope of the blade disk), by closed forms of a beam between
/// supports with spans 360, 60 and 330 mm.
Mat stiffness() {
  const double L = 0.75, a = 0.36, b = 0.42,
               EI = 2e11 * std::numbers::pi * std::pow(0.04, 4) / 64.0;
  Mat F(3, 3);
  F(0, 0) = influence(a, a, L, EI);
  F(0, 1) = F(1, 0) = influence(a, b, L, EI);
  F(1, 1) = influence(b, b, L, EI);
  // slopes at b: by the force at a (right of it, mirrored) and at b itself
  const double m = L - b;  // from the right end, where b is left of the mirrored force
  F(0, 2) = F(2, 0) = -a * (L * L - a * a - 3.0 * m * m) / (6.0 * EI * L);
  F(1, 2) = F(2, 1) = (L - b) * (L * L - (L - b) * (L - b) - 3.0 * b * b) / (6.0 * EI * L);
  F(2, 2) = (b * b - b * m + m * m) / (3.0 * EI * L);
  return F.inverse();
}

// The condensed shaft of an independent program, to its seven digits.
TEST(BladeSeal, HasTheShaftOfAnIndependentProgram) {
  const Mat K = stiffness();
  EXPECT_NEAR(K(0, 0), 4.927143e8, 50.0);
  EXPECT_NEAR(K(0, 1), -4.783495e8, 50.0);
  EXPECT_NEAR(K(0, 2), 2.352962e7, 5.0);
  EXPECT_NEAR(K(1, 1), 4.675192e8, 50.0);
  EXPECT_NEAR(K(1, 2), -2.257869e7, 5.0);
  EXPECT_NEAR(K(2, 2), 1.531659e6, 0.5);
}

// Forward critical speed 5186 rpm, of an independent program, the fourth digit rounded.
TEST(BladeSeal, HasTheCriticalSpeedOfAnIndependentProgram) {
  const Assembler assembler(bundled(5000.0).structure);
  bool found = false;
  for (const Critical& c : critical_speeds(assembler, {.count = 3})) {
    found = found || (c.whirl == Whirl::forward && std::abs(c.speed / rpm - 5186.0) < 0.5);
  }
  EXPECT_TRUE(found);
}

// Labyrinth and tips, against the equations term by term at random states: x1 y1 x2 y2, slopes.
TEST(BladeSeal, HasTheForcesOfItsEquations) {
  const Model model = bundled(5100.0);
  const Scene scene = make_scene(model);
  ASSERT_EQ(scene.contacts.coordinates(), 6);
  const Mat full = scene.displacement_map();
  const double w = model.speed, m1 = 2.0, m2 = 8.0, Jt = 0.07, Jp = 0.14, clearance = 1e-4, f = 0.1;
  // (x1, y1, x2, y2, tx, ty) with tx = dx/dz = theta_y, ty = dy/dz = -theta_x
  Mat map(6, 6);
  map << full.row(4), full.row(5), full.row(8), full.row(9), full.row(11), -full.row(10);
  const Mat inverse = map.inverse(), K = stiffness();
  const double cb = 2.755e-13, kh = 4.628e10, kl = 2.333e10, Rt = 0.118;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int touching = 0;
  for (int i = 0; i < 200; ++i) {
    Vec q(6), v(6);
    for (int k = 0; k < 6; ++k) {
      q(k) = 1.2 * clearance * any(random) * (k < 4 ? 1.0 : 10.0);
      v(k) = 0.05 * any(random);
    }
    const double phase = 3.0 * any(random);
    Vec y(12), a(6);
    y << inverse * q, inverse * v;
    scene.contacts.acceleration(phase, y.data(), a.data());
    const Vec found = map * a;

    Vec force(6);
    for (const int plane : {0, 1}) {
      const Eigen::Vector3d qs(q(plane), q(2 + plane), q(4 + plane)),
          vs(v(plane), v(2 + plane), v(4 + plane));
      const Eigen::Vector3d elastic = -K * (qs + 1e-4 * vs);
      for (int k = 0; k < 3; ++k) force(2 * k + plane) = elastic(k);
    }
    force(1) -= m1 * 9.8;
    force(3) -= m2 * 9.8;
    force(2) += m2 * 8e-6 * w * w * std::cos(phase);
    force(3) += m2 * 8e-6 * w * w * std::sin(phase);
    force(4) -= Jp * w * v(5);
    force(5) += Jp * w * v(4);
    const double r1 = std::hypot(q(0), q(1)),
                 N1 = r1 > clearance ? kl * std::pow(r1 - clearance, 1.5) : 0.0;
    force(0) -= N1 * (q(0) - f * q(1)) / r1;
    force(1) -= N1 * (q(1) + f * q(0)) / r1;
    for (int blade = 0; blade < 20; ++blade) {
      const double angle = phase + 2.0 * std::numbers::pi * blade / 20.0;
      const Vec2 D = q.segment(2, 2) + Rt * Vec2(std::cos(angle), std::sin(angle));
      const double d = D.norm() - Rt - clearance;
      if (d <= 0.0) continue;
      ++touching;
      double N = kh * std::pow(d, 1.5);  // Newton's method on d = (N / kh)^(2/3) + cb N^2
      for (int n = 0; n < 60; ++n) {
        N -= (std::pow(N / kh, 2.0 / 3.0) + cb * N * N - d) /
             (2.0 / 3.0 * std::pow(N / kh, 2.0 / 3.0) / N + 2.0 * cb * N);
      }
      const Vec2 n = D / D.norm();
      force(2) -= N * (n(0) - f * n(1));
      force(3) -= N * (n(1) + f * n(0));
    }
    const Vec mass = (Vec(6) << m1, m1, m2, m2, Jt, Jt).finished();
    const Vec expected = force.cwiseQuotient(mass);
    for (const int k : {0, 2, 4}) {  // cb has four digits
      EXPECT_LT((found - expected).segment(k, 2).norm(), 2e-4 * expected.segment(k, 2).norm());
    }
  }
  EXPECT_GT(touching, 200);
}

// Just below 5000 rpm rub begins, with the revolution (in words, period 1; the speed is an
// independent program's): none at 4950, tips and labyrinth each alone and both at 5000.
TEST(BladeSeal, BeginsToRubWithPeriodOneJustBelow5000Rpm) {
  const Classification free = classified(bundled(4950.0));
  EXPECT_EQ(free.contacts.at(0).duty + free.contacts.at(1).duty, 0.0);
  for (const Model& model : {bundled(5000.0), tips_alone(5000.0), labyrinth_alone(5000.0)}) {
    const Classification rub = classified(model);
    EXPECT_EQ(rub.kind, MotionKind::periodic);
    EXPECT_EQ(rub.period, 1);
    EXPECT_GT(rub.contacts.at(0).duty + rub.contacts.at(1).duty, 0.02);
  }
}

// Run-down, the state carried from speed to speed: contact comes back by a jump near 5400 rpm, as
// an independent program has it. On run-up it had lasted.
TEST(BladeSeal, ComesBackToRubByAJumpNear5400Rpm) {
  MotionState state;
  const auto duty_at = [&](double speed) {
    const Model model = bundled(speed);
    const Scene scene = make_scene(model);
    Trajectory t{.system = &scene.contacts, .state = state, .revolutions = 300};
    if (t.state.y.size() == 0) t.state = start_state(model, scene, nullptr);
    t.state.contacts.clear();  // as they follow from the motion
    integrate_single(t, {.tolerance = 1e-9});
    t.revolutions = 50;
    integrate_single(t, {.tolerance = 1e-9, .measures = true});
    EXPECT_EQ(t.outcome, Outcome::reached_end) << t.failure;
    state = t.state;
    return std::max(t.contacts.at(0).in_touch, t.contacts.at(1).in_touch);
  };
  EXPECT_EQ(duty_at(5600.0), 0.0);
  EXPECT_EQ(duty_at(5450.0), 0.0);
  EXPECT_GT(duty_at(5400.0), 0.0);
  EXPECT_GT(duty_at(5450.0), 0.0);
  EXPECT_GT(duty_at(5500.0), 0.0);
}

TEST(BladeSeal, MovesChaoticallyOnItsTipsAlone) {
  const Classification rub = classified(tips_alone(5200.0));
  EXPECT_TRUE(rub.kind == MotionKind::chaotic || rub.kind == MotionKind::hyperchaotic);
  EXPECT_GT(rub.contacts.at(1).duty, 0.05);
}

TEST(BladeSeal, MovesPeriodicallyInTheLabyrinthAlone) {
  for (const double speed : {5200.0, 5400.0}) {
    const Classification rub = classified(labyrinth_alone(speed));
    EXPECT_EQ(rub.kind, MotionKind::periodic) << speed;
    EXPECT_GT(rub.contacts.at(0).duty, 0.2) << speed;
  }
}

}  // namespace whirl::blade_seal_test
