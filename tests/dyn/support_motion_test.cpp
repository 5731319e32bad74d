// Motions of rotors on supports with states and in magnetic bearings, with rub.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "libfe/analyses/craig_bampton.hpp"
#include "libfe/parts/transfer_function.hpp"
#include "tests/support/trajectories.hpp"

namespace whirl::support_motion_test {

using namespace test;

/// What carries the rotor.
enum class On { pedestal_body, pedestal_states, pedestal_matrices, spring, controller };

/// A body with unbalance that rubs in a ring.
struct Rubbing {
  On on = On::pedestal_states;
  double mu = 0.1;
  double Omega = 260.0;

  static constexpr double mp = 4.0, kp = 4e6, cp = 500.0, kb = 1e6;
  static constexpr double P = 1e4, D = 4.0, ki = 200.0, ks = 1e6;

  Model model() const {
    Model all;
    all.speed = Omega;
    all.has_speed = true;
    Structure& s = all.structure;
    s.bodies = {{.name = "disk", .m = 10.0, .spins = true}};
    s.unbalances = {{.at = body("disk"), .moment = 0.01}};
    const std::vector<InterfaceCoordinate> both{{.at = body("disk"), .x = 1.0, .y = 0.0},
                                                {.at = body("disk"), .x = 0.0, .y = 1.0}};
    const auto add = [&](const StateSpace& law) {
      s.supports.push_back(
          {.name = "support", .sees = both, .acts_on = both, .law = law.repeated(2)});
    };
    switch (on) {
      case On::pedestal_body:
        s.bodies.push_back({.name = "pedestal", .m = mp});
        s.links = {connect(body("disk"), body("pedestal"), isotropic(kb))};
        s.bearings = {bearing(body("pedestal"), isotropic(kp, cp))};
        break;
      case On::pedestal_states:
        add(state_space(TransferFunction{{kb * mp, kb * cp, kb * kp}, {mp, cp, kp + kb}}));
        break;
      case On::pedestal_matrices: {
        Mat M = Mat::Zero(2, 2), C = Mat::Zero(2, 2), K(2, 2);
        M(1, 1) = mp;
        C(1, 1) = cp;
        K << kb, -kb, -kb, kb + kp;
        for (const InterfaceCoordinate& along : both) {
          Support& support = s.supports.emplace_back();
          support.sees = support.acts_on = {along};
          set_law(support, craig_bampton({M.sparseView(), C.sparseView(), K.sparseView()}, {0}, 1));
        }
        break;
      }
      case On::spring:
        s.bearings = {bearing(body("disk"), isotropic(ki * P - ks, ki * D))};
        break;
      case On::controller:
        s.bearings = {bearing(body("disk"), isotropic(-ks))};
        add(state_space(TransferFunction{{ki * D, ki * P}, {1.0}}));
        break;
    }
    all.contacts = {{.name = "ring",
                     .at = body("disk"),
                     .clearance = on == On::spring || on == On::controller ? 5e-4 : 2e-3,
                     .friction = {.mu = mu, .radius = 0.05},
                     .law = Radial<>{.k = 2e7}}};
    all.reduction.method = ReductionMethod::none;
    return all;
  }
  Scene scene() const { return make_scene(model()); }
};

/// Where the rotor is after some revolutions, and how often it has touched.
struct End {
  Vec disk;  ///< displacement and velocity
  double impacts = 0;
};

End end_of(const Rubbing& rubbing, long revolutions) {
  Trajectories one;
  one.add(rubbing, revolutions);
  integrate_batch(one.all, {.tolerance = 1e-12, .measures = true});
  const Trajectory& found = one.all.front();
  EXPECT_EQ(found.outcome, Outcome::reached_end) << found.failure;
  const FullState state = full_state(*one.scenes.front(), found.state);
  Vec disk(4);
  disk << state.displacement.head(2), state.velocity.head(2);
  return {disk, found.contacts.front().impacts};
}

void expect_same_motion(On a, On b, double Omega) {
  const End first = end_of({.on = a, .Omega = Omega}, 12),
            second = end_of({.on = b, .Omega = Omega}, 12);
  EXPECT_GT(first.impacts, 3);
  EXPECT_EQ(first.impacts, second.impacts);
  EXPECT_LT((first.disk - second.disk).norm(), 1e-8 * first.disk.norm());
}

TEST(SupportMotion, OnAPedestalIsThatOnItsBody) {
  expect_same_motion(On::pedestal_body, On::pedestal_states, 260.0);
  expect_same_motion(On::pedestal_body, On::pedestal_matrices, 260.0);
}

// acceptance: proportional-derivative control is a spring and a damper, also with rub
TEST(SupportMotion, UnderProportionalDerivativeControlIsThatOnASpring) {
  expect_same_motion(On::spring, On::controller, 330.0);
}

// Each lane has the bits that its trajectory has alone.
TEST(SupportMotion, HasTheSameBitsInAllLanes) {
  Trajectories many;
  for (int i = 0; i < 12; ++i) {
    many.add(Rubbing{.mu = 0.02 * i, .Omega = 250.0 + 3.0 * i}, 15);
  }
  std::vector<Trajectory> batch = many.all;
  integrate_batch(batch, {.measures = true, .exponents = true});
  double impacts = 0;
  for (std::size_t i = 0; i < batch.size(); ++i) {
    Trajectory alone = many.all[i];
    integrate_single(alone, {.measures = true, .exponents = true});
    EXPECT_EQ(batch[i].outcome, Outcome::reached_end) << batch[i].failure;
    EXPECT_EQ(batch[i].state.y, alone.state.y) << i;
    EXPECT_EQ(batch[i].exponents, alone.exponents) << i;
    impacts += alone.contacts.front().impacts;
  }
  EXPECT_GT(impacts, 50);
}

}  // namespace whirl::support_motion_test
