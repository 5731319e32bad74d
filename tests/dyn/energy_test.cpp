// Energy: kept without damping and friction, otherwise given to friction and drive; damped
// contacts never pull.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "libbase/numerics/quadrature.hpp"
#include "libdyn/system/contact_measures.hpp"
#include "libdyn/taylor/batch.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::energy_test {

using test::MassInRing;
using test::RotorStator;

/// Kinetic, elastic and potential energy of rotor and stator, and of the contact's spring [J].
double energy(const RotorStator& p, const Vec& y) {
  const double depth = (y.segment<2>(0) - y.segment<2>(2) - p.offset).norm() - p.gap;
  const double contact = depth > 0.0 ? 0.5 * p.kC * depth * depth : 0.0;
  return 0.5 * p.mr * y.segment<2>(4).squaredNorm() + 0.5 * p.ms * y.segment<2>(6).squaredNorm() +
         0.5 * p.kr * y.segment<2>(0).squaredNorm() + 0.5 * p.ks * y.segment<2>(2).squaredNorm() +
         p.gravity * (p.mr * y(1) + p.ms * y(3)) + contact;
}

/// No damping, no unbalance.
RotorStator conservative(double mu) {
  return {.mu = mu, .cr = 0.0, .cs = 0.0, .e = 0.0, .gravity = 9.81, .offset = {2e-4, -1e-4}};
}

/// Far out and moving to the side, so that the rotor goes on hitting the ring.
Vec vigorous() {
  return (Vec(8) << 5e-3, 1e-3, 0.0, 0.0, 0.3, -0.8, 0.0, 0.1).finished();
}

TEST(Energy, StaysOverHundredsOfImpacts) {
  constexpr double drift = 1e-9;  // of 10 000 steps of an error of 1e-13 each
  const RotorStator p = conservative(0.0);
  const Scene scene = p.scene();
  MotionState state = test::state_of(vigorous());
  const double before = energy(p, state.y);
  double worst = 0.0;
  long impacts = 0;
  for (int revolution = 0; revolution < 100; ++revolution) {
    impacts += test::run(scene, state, 1, {.tolerance = 1e-13}).cost.events / 2;
    worst = std::max(worst, std::abs(energy(p, state.y) - before) / before);
  }
  EXPECT_GT(impacts, 200);
  EXPECT_LT(worst, drift);
}

// The contact's power on both bodies is -N d' - T t.d' with t.d' = v_t - Omega R: friction takes T
// v_t and the drive, which holds Omega, gives T Omega R. Energy at the end = at the start +
// integral of T (Omega R - v_t).
TEST(Energy, IsLostToFrictionAsItsWorkSays) {
  constexpr double relative = 1e-9;  // of the work: tolerance 1e-13, quadrature exact to degree 15
  const Quadrature gauss = Quadrature::gauss(8);
  for (const double R : {0.1, 0.0}) {  // without a rim the slip is that of the whirl alone
    RotorStator p = conservative(0.05);
    p.R = R;
    const Scene scene = p.scene();
    MotionState state = test::state_of(vigorous());
    const double before = energy(p, state.y);
    double lost = 0.0, given = 0.0;
    Vec y(8);
    std::vector<ContactForces> forces;
    const Integration result =
        test::run(scene, state, 20, {.tolerance = 1e-13}, [&](const Step& step) {
          if (!step.contacts[0].in_touch()) return true;
          for (Eigen::Index i = 0; i < gauss.x.size(); ++i) {
            step.at(gauss.x(i), y.data());
            scene.contacts.forces(step.angle(gauss.x(i)), y.data(), step.contacts, forces);
            const double weight = gauss.w(i) * step.h * forces[0].friction;
            lost += weight * forces[0].slip;
            given += weight * scene.contacts.contacts()[0].rim_speed;
          }
          return true;
        });
    ASSERT_EQ(result.outcome, Outcome::reached_end);
    EXPECT_GT(result.cost.events, 50);
    EXPECT_GT(lost, 0.05 * before);
    EXPECT_NEAR(energy(p, state.y), before + given - lost, relative * lost) << R;
    if (R == 0.0) {
      EXPECT_EQ(given, 0.0);
    }
  }
}

// ---- damped contacts ----------------------------------------------------------------------------

// N = k d + c d' would pull while the surfaces part: there the contact recedes without force. N
// becomes zero at the end of touching up to the tolerance of the step.
TEST(DampedContact, NeverPulls) {
  RotorStator p = test::P1;
  p.cC = 2e4;
  const Scene scene = p.scene();
  MotionState state = test::start_of(p.model(), scene);
  Vec y(8);
  std::vector<ContactForces> forces;
  double largest = 0.0, smallest = 1e300;
  int receding = 0, impacts = 0;
  Touch before = Touch::apart;
  test::run(scene, state, 40, {.tolerance = 1e-13}, [&](const Step& step) {
    const Touch now = step.contacts[0].touch;
    if (now == Touch::receding) ++receding;
    if (now == Touch::sliding && before == Touch::apart) ++impacts;
    before = now;
    for (double s = 0.0; s <= 1.0; s += 0.125) {
      step.at(s, y.data());
      scene.contacts.forces(step.angle(s), y.data(), step.contacts, forces);
      if (now == Touch::sliding) {
        largest = std::max(largest, forces[0].normal);
        smallest = std::min(smallest, forces[0].normal);
        EXPECT_GT(forces[0].depth, -1e-12 * p.gap);
      } else if (now == Touch::receding) {
        EXPECT_LT(forces[0].normal, 1e-9 * largest);  // it would pull
      }
    }
    return true;
  });
  EXPECT_GT(impacts, 50);
  EXPECT_GE(receding, impacts);
  EXPECT_GT(smallest, -1e-9 * largest);
}

// A damped contact whose force lets go and presses again while the rotor stays beyond the surface
// has not come to touch again: impacts are touches, of the meter and of lanes alike.
TEST(DampedContact, CountsTouchesAsImpactsAndNoForcesThatPressAgain) {
  long touches = 0, retouches = 0;
  for (const double U : {1e-3, 1.5e-3, 2e-3}) {
    const MassInRing p{.k = 1e3, .c = 1.0, .U = U, .kC = 1e5, .cC = 5e3, .gravity = 20.0};
    const Scene scene = p.scene();
    MotionState state = test::start_of(p.model(), scene);
    test::run(scene, state, 50, {});
    ContactMeter meter(scene.contacts);
    Trajectory lane{.system = &scene.contacts, .state = state, .revolutions = 20};
    integrate_single(lane, {.measures = true});
    long own = 0;
    std::optional<Touch> before;
    test::run(scene, state, 20, {}, [&](const Step& step) {
      meter.add(step);
      const Touch now = step.contacts[0].touch;
      if (before && now == Touch::sliding) {
        own += *before == Touch::apart;
        retouches += *before == Touch::receding;
      }
      before = now;
      return true;
    });
    EXPECT_EQ(meter.measures()[0].impacts, static_cast<double>(own)) << U;
    EXPECT_NEAR(lane.contacts[0].impacts, static_cast<double>(own), 1.0) << U;  // at an end
    touches += own;
  }
  EXPECT_GT(touches, 20);
  EXPECT_GT(retouches, 20);
}

// A free mass on a stop with m d'' + c d' + k d = 0, d(0) = 0, d'(0) = v:
//
//   d = v / w_d e^(-delta t) sin(w_d t),  delta = zeta w_0,  w_d = w_0 sqrt(1 - zeta^2)
//
// The force k d + c d' = -m d'' vanishes where tan(w_d t) = 2 delta w_d / (delta^2 - w_d^2), that
// is w_d t = 2 acos(zeta), for delta + i w_d = w_0 e^(i acos(zeta)). There
//
//   d' = v e^(-2 zeta acos(zeta) / sqrt(1 - zeta^2)) (cos 2a - cot a sin 2a) = -v e^(...), a =
//   acos(zeta) d  = -c d' / k > 0: the surfaces part later, without a force
TEST(DampedContact, ReleasesAFreeMassAtTheVelocityOfItsClosedForm) {
  constexpr double accurate = 1e-11;  // of the velocity, at a tolerance of 1e-13
  const double v = 0.5;
  for (const double zeta : {0.02, 0.2, 0.7, 0.95}) {
    MassInRing p{.Omega = 0.0, .m = 2.0, .k = 0.0, .kC = 2e6};
    const double w0 = std::sqrt(p.kC / p.m);
    p.cC = 2.0 * zeta * p.m * w0;
    const Scene scene = p.scene();
    MotionState state = test::state_of(Vec2(0.0, 0.0), Vec2(v, 0.0));
    std::vector<Touch> touches{Touch::apart};
    double duration = 0.0, release = 0.0;
    Vec y(4);
    // until it is halfway back
    const Integration result =
        test::run(scene, state, 1, {.tolerance = 1e-13}, [&](const Step& step) {
          const Touch now = step.contacts[0].touch;
          if (now != touches.back()) touches.push_back(now);
          step.at(1.0, y.data());
          if (now == Touch::sliding) {
            duration += step.h;
            release = y(0) - p.clearance;
          }
          return touches.size() < 4;
        });
    EXPECT_EQ(result.outcome, Outcome::stopped_by_observer);
    EXPECT_EQ(touches, (std::vector{Touch::apart, Touch::sliding, Touch::receding, Touch::apart}));
    const double root = std::sqrt(1.0 - zeta * zeta),
                 exit = v * std::exp(-2.0 * zeta * std::acos(zeta) / root);
    EXPECT_NEAR(y(2), -exit, accurate * v) << zeta;
    EXPECT_NEAR(duration, 2.0 * std::acos(zeta) / (w0 * root), accurate / w0 * 100.0) << zeta;
    EXPECT_NEAR(release, p.cC * exit / p.kC, accurate * v / w0 * 100.0) << zeta;
  }
}

}  // namespace whirl::energy_test
