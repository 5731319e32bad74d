// Several contacts at one station that stick at once: only the sum of their friction is determined.
// It is shared in proportion to mu N, and the motion is that of one contact as stiff as all.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "libbase/numerics/quadrature.hpp"
#include "libdyn/motions/simulate.hpp"
#include "tests/support/trajectories.hpp"

namespace whirl::redundant_friction_test {

using test::MassInRing;

/// A ring beside others.
struct Ring {
  double k = 1e7;           ///< [N/m]
  double clearance = 2e-4;  ///< [m]
  double mu = 0.1;
  double R = 25e-3;            ///< [m]
  Vec2 center = Vec2::Zero();  ///< [m]
};

/// A rotor that friction drives into backward whirl, until it rolls and slips in turns.
struct RotorInRings {
  std::vector<Ring> rings;
  double damping = 50.0, unbalance = 1e-3;  ///< [N.s/m], [kg.m]

  Model model() const {
    Model m = MassInRing{.Omega = 136.0, .m = 10.0, .k = 1e5, .c = damping, .U = unbalance}.model();
    const Contact ring = m.contacts[0];
    m.contacts.clear();
    for (const Ring& r : rings) {
      m.contacts.push_back(ring);
      Contact& c = m.contacts.back();
      c.name = "ring " + std::to_string(m.contacts.size());
      c.law = Radial<>{.k = r.k};
      c.clearance = r.clearance;
      c.offset = r.center;
      c.friction = {.mu = r.mu, .radius = r.R};
    }
    return m;
  }
};

/// Nearly rolling backward, 1 mm out, at nearly Omega R.
MotionState whirling() {
  return test::state_of({1e-3, 0.0}, {0.0, -3.2});
}

/// Where a motion is after some revolutions, and how much of them its first contact stuck.
struct Result {
  MotionState end;
  double sticking = 0.0;
};
Result moved(const RotorInRings& rotor, long revolutions, const test::RunOptions& how) {
  const Scene scene = make_scene(rotor.model());
  Result result{whirling()};
  ContactMeter meter(scene.contacts);
  const Integration run = test::run(scene, result.end, revolutions, how, [&](const Step& step) {
    meter.add(step);
    return true;
  });
  EXPECT_EQ(run.outcome, Outcome::reached_end) << name_of_method(how.method) << run.failure;
  result.sticking = meter.measures().at(0).sticking;
  return result;
}

constexpr long revolutions = 2;
constexpr double accuracy = 1e-7;  ///< of the state after them, in scales, between different steps

/// Tolerance near the rounding of motions that are ten clearances large; collocation solves an
/// equation in every step, whose rounding comes on top.
double finest(const AnyMethod& method) {
  return std::holds_alternative<Collocation>(method) ? 1e-11 : 1e-12;
}

TEST(RedundantFriction, OfEqualContactsMovesTheRotorAsOneOfAllTheirStiffness) {
  const RotorInRings one{{{.k = 2e7}}}, two{{{}, {}}}, three{{{.k = 5e6}, {.k = 1e7}, {.k = 5e6}}};
  const Scene scene = make_scene(one.model());
  for (const AnyMethod& method :
       {AnyMethod(Taylor{}), AnyMethod(Dop853{}), AnyMethod(Collocation{}), AnyMethod(CvodeAdams{}),
        AnyMethod(Arkode{})}) {
    const Result reference = moved(one, revolutions, {.method = method});
    EXPECT_GT(reference.sticking, 0.1);
    EXPECT_LT(reference.sticking, 1.0);
    for (const RotorInRings& rotor : {two, three}) {
      const Result result = moved(rotor, revolutions, {.method = method});
      EXPECT_LT(distance(scene.contacts, result.end.y, reference.end.y), accuracy)
          << name_of_method(method) << " " << rotor.rings.size();
      EXPECT_NEAR(result.sticking, reference.sticking, accuracy);
      for (const ContactState& c : result.end.contacts) {
        EXPECT_EQ(c, reference.end.contacts[0]) << name_of_method(method);
      }
    }
  }
}

// One ring is touched after the other, and each may be the first: methods agree, and friction takes
// and gives what its work says, sum of T_i (Omega R - v_t) over both.
TEST(RedundantFriction, OfUnequalContactsIsTheSameInEveryMethodAndKeepsTheEnergy) {
  constexpr double relative = 1e-8;  // of the work: steps of an error of 1e-13
  const Quadrature gauss = Quadrature::gauss(8);
  for (const bool is_reversed : {false, true}) {
    RotorInRings rotor{{{}, {.k = 1e6, .clearance = 2.5e-4, .mu = 0.2}}, 0.0, 0.0};
    if (is_reversed) std::swap(rotor.rings[0], rotor.rings[1]);
    const Scene scene = make_scene(rotor.model());
    const auto energy = [&](const Vec& y) {
      double sum = 0.5 * 10.0 * y.tail(2).squaredNorm() + 0.5 * 1e5 * y.head(2).squaredNorm();
      for (const Ring& r : rotor.rings) {
        const double depth = std::max(0.0, y.head(2).norm() - r.clearance);
        sum += 0.5 * r.k * depth * depth;
      }
      return sum;
    };
    const MotionState start = whirling();
    MotionState state = start;
    double lost = 0.0, given = 0.0, stuck = 0.0;
    Vec y(4);
    std::vector<ContactForces> forces;
    const Integration run =
        test::run(scene, state, revolutions, {.tolerance = 1e-13}, [&](const Step& step) {
          const bool both_stick = step.contacts[0].touch == Touch::sticking &&
                                  step.contacts[1].touch == Touch::sticking;
          if (both_stick) stuck += step.h;
          for (Eigen::Index i = 0; i < gauss.x.size(); ++i) {
            step.at(gauss.x(i), y.data());
            scene.contacts.forces(step.angle(gauss.x(i)), y.data(), step.contacts, forces);
            for (std::size_t c = 0; c < 2; ++c) {
              if (!step.contacts[c].in_touch()) continue;
              const double weight = gauss.w(i) * step.h * forces[c].friction;
              lost += weight * forces[c].slip;
              given += weight * scene.contacts.contacts()[c].rim_speed;
            }
          }
          return true;
        });
    ASSERT_EQ(run.outcome, Outcome::reached_end) << run.failure;
    EXPECT_GT(stuck, 0.01 * scene.contacts.period());
    EXPECT_GT(lost, 0.01 * energy(start.y));
    EXPECT_NEAR(energy(state.y), energy(start.y) + given - lost,
                relative * (lost + std::abs(given)));
    for (const AnyMethod& method : {AnyMethod(Dop853{}), AnyMethod(Collocation{})}) {
      MotionState other = start;
      const Integration again =
          test::run(scene, other, revolutions, {.tolerance = finest(method), .method = method});
      ASSERT_EQ(again.outcome, Outcome::reached_end) << name_of_method(method) << again.failure;
      EXPECT_LT(distance(scene.contacts, other.y, state.y), accuracy) << name_of_method(method);
    }
  }
}

// Shares are in proportion to mu N, so that none slips before the others; together they hold what
// one contact would have to.
TEST(RedundantFriction, IsSharedInProportionToWhatEachCanHold) {
  constexpr double rounding = 1e-12;
  const RotorInRings rotor{{{.mu = 0.3}, {.k = 4e6, .clearance = 1.8e-4}, {.clearance = 1e-3}}};
  const Scene scene = make_scene(rotor.model());
  Vec y(4);
  y << 2.6e-4, 1.1e-4, 0.2, -3.0;
  const ContactStates stick{{Touch::sticking, 1.0}, {Touch::sticking, 1.0}, {}};
  scene.contacts.remove_slip(y.data(), stick);
  std::vector<ContactForces> f;
  scene.contacts.forces(0.4, y.data(), stick, f);
  const double first = 0.3 * f[0].normal, second = 0.1 * f[1].normal;
  ASSERT_GT(second, 0.0);
  EXPECT_NEAR(f[0].friction / first, f[1].friction / second,
              rounding * std::abs(f[0].friction / first));
  EXPECT_EQ(f[2].friction, 0.0);

  const Hold hold = scene.contacts.hold(0.4, y.data(), stick, 1);
  EXPECT_NEAR(hold.force, f[0].friction + f[1].friction, rounding * std::abs(hold.force));
  EXPECT_NEAR(hold.limit, first + second, rounding * hold.limit);
  const RotorInRings alone{{{.mu = 0.3}}};  // N of the other differs, but not what holds the slip
  const Scene single = make_scene(alone.model());
  EXPECT_NEAR(single.contacts.hold(0.4, y.data(), {{Touch::sticking, 1.0}}, 0).force, hold.force,
              rounding * std::abs(hold.force));
}

// Contacts at one radius stick together. At radii that differ they cannot: one slides while the
// other sticks, and as the difference vanishes the motion becomes that of equal radii.
TEST(RedundantFriction, IsTheLimitOfRadiiThatBecomeEqual) {
  constexpr double growth = 2e4;  // of a small difference over the motion: 1.13e4 in all methods
  const Scene scene = make_scene(RotorInRings{{{}, {}}}.model());
  const Result equal = moved({{{}, {}}}, revolutions, {.tolerance = 1e-12});
  for (const AnyMethod& method :
       {AnyMethod(Taylor{}), AnyMethod(Dop853{}), AnyMethod(Collocation{})}) {
    for (const double apart : {1e-12, 1e-8, 1e-4}) {
      const RotorInRings rotor{{{}, {.R = 25e-3 * (1.0 + apart)}}};
      const Result near =
          moved(rotor, revolutions, {.tolerance = finest(method), .method = method});
      EXPECT_LT(distance(scene.contacts, near.end.y, equal.end.y), growth * apart + accuracy)
          << name_of_method(method) << " " << apart;
    }
  }
}

// Rings about different centers slip in different directions: what each holds is determined.
TEST(RedundantFriction, IsNoneBetweenRingsAboutDifferentCenters) {
  const Scene scene = make_scene(RotorInRings{{{}, {.center = {1e-5, 0.0}}}}.model());
  EXPECT_FALSE(scene.contacts.slip_alike(0, 1));
  const Scene smooth = [] {
    Model m = RotorInRings{{{}, {}}}.model();
    m.contacts[1].friction.tolerance = 1e-3;
    return make_scene(m);
  }();
  EXPECT_FALSE(smooth.contacts.slip_alike(0, 1));  // this one never sticks
}

// Lanes of a batch do what each motion does alone, to the last digit, whether or not their contacts
// slip alike.
TEST(RedundantFriction, InLanesIsThatOfEachMotionAlone) {
  test::Trajectories together, alone;
  for (int i = 0; i < 11; ++i) {
    const double R = i % 4 == 3 ? 30e-3 : 25e-3;
    const RotorInRings rotor{{{.mu = 0.08 + 0.01 * i}, {.k = 4e6, .clearance = 2.5e-4, .R = R}}};
    together.add(rotor, revolutions).state = whirling();
    alone.add(rotor, revolutions).state = whirling();
  }
  integrate_batch(together.all, {.measures = true});
  double stuck = 0.0;
  for (std::size_t i = 0; i < together.all.size(); ++i) {
    Trajectory& one = alone.all[i];
    const Trajectory& lane = together.all[i];
    integrate_single(one, {.measures = true});
    ASSERT_EQ(lane.outcome, Outcome::reached_end) << i << lane.failure;
    EXPECT_EQ(lane.state.y, one.state.y) << i;
    for (const std::size_t c : {0u, 1u}) {
      EXPECT_EQ(lane.contacts[c].sticking, one.contacts[c].sticking) << i;
      EXPECT_EQ(lane.contacts[c].max_tangential, one.contacts[c].max_tangential) << i;
      stuck = std::max(stuck, lane.contacts[c].sticking);
    }
  }
  EXPECT_GT(stuck, 0.0);
}

// The friction that a batch measures is the share that forces() says: never more than mu N.
TEST(RedundantFriction, IsMeasuredAsItsShare) {
  constexpr double parabola = 1e-3;  // of a largest value between samples
  const RotorInRings rotor{{{}, {.k = 4e6, .clearance = 2.5e-4, .mu = 0.2}}};
  test::Trajectories batch;
  Trajectory& t = batch.add(rotor, revolutions);
  t.state = whirling();
  integrate_single(t, {.measures = true});
  const Scene scene = make_scene(rotor.model());
  const Simulation simulated =
      simulate(scene, whirling(), {.revolutions = revolutions, .discard = 0});
  const std::vector<ContactMeasure>& metered = simulated.recording.contacts;
  ASSERT_GT(metered[0].sticking, 0.0);
  for (const std::size_t c : {0u, 1u}) {
    EXPECT_NEAR(t.contacts[c].max_tangential, metered[c].max_tangential,
                parabola * metered[c].max_tangential);
    EXPECT_LE(t.contacts[c].max_tangential,
              (1.0 + parabola) * rotor.rings[c].mu * t.contacts[c].max_normal);
  }
}

TEST(RedundantFriction, HasTheTangentOfOneContactOfAllTheirStiffness) {
  constexpr double relative = 1e-6;
  test::Trajectories all;
  for (const RotorInRings& rotor : {RotorInRings{{{.k = 2e7}}}, RotorInRings{{{}, {}}}}) {
    Trajectory& t = all.add(rotor, revolutions);
    t.state = whirling();
    integrate_single(t, {.tolerance = 1e-13, .tangent = true});
    ASSERT_EQ(all.all.back().outcome, Outcome::reached_end);
  }
  const Mat &one = all.all[0].tangent, &two = all.all[1].tangent;
  EXPECT_LT((two - one).norm(), relative * one.norm());
}

}  // namespace whirl::redundant_friction_test
