// RK4 in lanes: what RK4 is, for each lane with its own parameters.

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "libdyn/taylor/batch.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::rk4_batch_test {

constexpr int size = 19;  // more than lanes

/// Rotors at different speeds, with exact, smoothed and no friction, some with damped contacts, of
/// different numbers of revolutions.
struct Rotors {
  std::vector<std::unique_ptr<Scene>> scenes;
  std::vector<Trajectory> trajectories;

  Rotors() {
    for (int i = 0; i < size; ++i) {
      test::RotorStator p{.Omega = 130.0 + i, .kC = 20e6, .mu = 0.02 * (i % 5)};
      if (i % 4 == 0) p.cC = 1e3;
      if (i % 3 == 0) p.slip_tolerance = 0.5;
      if (i % 3 == 1) p.slip = Slip::forward;
      scenes.push_back(std::make_unique<Scene>(p.scene()));
      Trajectory t{.system = &scenes.back()->contacts, .revolutions = 4 + i % 3};
      t.state = test::start_of(p.model(), *scenes.back());
      trajectories.push_back(t);
    }
  }
};

// At this tolerance a revolution takes 200 steps, whatever the speed: lock step changes nothing.
// Differences are rounding, which contacts let grow.
TEST(Rk4Batch, GivesEachTrajectoryWhatRk4Gives) {
  constexpr double tolerance = 1e-10 * 5.0 * 5.0 * 5.0 * 5.0, rounding = 1e-11;
  const Rotors rotors;
  std::vector<Trajectory> batch = rotors.trajectories;
  integrate_batch_rk4(batch, {.tolerance = tolerance});
  for (std::size_t i = 0; i < batch.size(); ++i) {
    MotionState state = rotors.trajectories[i].state;
    const Integration alone = test::run(*rotors.scenes[i], state, batch[i].revolutions,
                                        {.tolerance = tolerance, .method = Rk4{}});
    EXPECT_LT(distance(*batch[i].system, batch[i].state.y, state.y), rounding) << i;
    EXPECT_EQ(batch[i].state.contacts, state.contacts) << i;
    EXPECT_EQ(batch[i].state.revolution, state.revolution) << i;
    EXPECT_EQ(batch[i].state.phase, 0.0) << i;
    EXPECT_EQ(batch[i].cost.steps, alone.cost.steps) << i;
  }
}

// All go on from where they are within a revolution.
TEST(Rk4Batch, BeginsWithinARevolution) {
  const Rotors rotors;
  Trajectory t = rotors.trajectories[0];
  t.state.phase = 2.0;
  MotionState state = t.state;
  integrate_batch_rk4({&t, 1}, {.fixed_step = 1e-4});
  test::run(*rotors.scenes[0], state, t.revolutions, {.fixed_step = 1e-4, .method = Rk4{}});
  EXPECT_LT(distance(*t.system, t.state.y, state.y), 1e-11);
}

// A state that is no number ends its own lane only, and is said.
TEST(Rk4Batch, EndsOneTrajectoryWithoutTheOthers) {
  const Rotors rotors;
  std::vector<Trajectory> batch = rotors.trajectories;
  batch[3].state.y(0) = std::numeric_limits<double>::quiet_NaN();
  integrate_batch_rk4(batch, {.tolerance = 1e-6});
  for (std::size_t i = 0; i < batch.size(); ++i) {
    EXPECT_EQ(batch[i].outcome, i == 3 ? Outcome::not_finite : Outcome::reached_end) << i;
  }
  EXPECT_NE(batch[3].failure.text().find("no finite numbers"), std::string::npos);
}

TEST(Rk4Batch, OfNothingIsNothing) {
  integrate_batch_rk4({}, {});
}

}  // namespace whirl::rk4_batch_test
