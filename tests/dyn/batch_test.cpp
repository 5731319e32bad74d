// A batch of trajectories: each is what it would be alone, bit by bit.

#include "libdyn/taylor/batch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "libbase/error.hpp"
#include "tests/support/trajectories.hpp"

namespace whirl::batch_test {

using test::RotorStator;

/// Trajectories of rotors with random speeds, contacts and friction: free, bouncing, rubbing,
/// rolling (the soft corner with much friction); with damped or Hertz contacts on request.
test::Trajectories random_rotors(int size, bool are_damped = false, bool are_hertz = false) {
  test::Trajectories sample;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit;
  for (int i = 0; i < size; ++i) {
    RotorStator p{.Omega = 120.0 + 50.0 * unit(random), .mu = 0.3 * unit(random)};
    p.kC = 2e6 * std::pow(100.0, unit(random));
    if (are_damped) p.cC = 1e3 * unit(random), p.alpha = 1e-3 * p.cC;
    if (are_hertz) p.kH = 100.0 * p.kC;
    sample.add(p, 20 + static_cast<long>(20.0 * unit(random)));
  }
  return sample;
}

bool is_same(const std::vector<ContactTimes>& a, const std::vector<ContactTimes>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.in_touch == y.in_touch && x.sticking == y.sticking && x.impacts == y.impacts &&
           x.max_normal == y.max_normal && x.max_tangential == y.max_tangential;
  });
}

bool is_same(const Trajectory& a, const Trajectory& b) {
  return a.state.y == b.state.y && a.state.revolution == b.state.revolution &&
         a.state.phase == b.state.phase && a.state.contacts == b.state.contacts &&
         a.outcome == b.outcome && a.cost.steps == b.cost.steps && a.cost.events == b.cost.events &&
         a.sections == b.sections && is_same(a.contacts, b.contacts) &&
         a.exponents == b.exponents && a.tangent == b.tangent;
}

void expect_same_as_alone(const test::Trajectories& sample, const BatchOptions& options) {
  std::vector<Trajectory> batch = sample.all;
  integrate_batch(batch, options);
  int events = 0;
  for (std::size_t i = 0; i < batch.size(); ++i) {
    Trajectory alone = sample.all[i];
    integrate_single(alone, options);
    EXPECT_EQ(alone.outcome, Outcome::reached_end) << alone.failure;
    EXPECT_TRUE(is_same(batch[i], alone)) << i;
    events += static_cast<int>(alone.cost.events);
  }
  EXPECT_GT(events, 1000);
}

TEST(Batch, GivesEachTrajectoryWhatItIsAlone) {
  expect_same_as_alone(random_rotors(40), {.sections = true});
}
TEST(Batch, GivesEachTrajectoryWhatItIsAloneWithDampedContacts) {
  expect_same_as_alone(random_rotors(24, true), {.tolerance = 1e-8});
}
TEST(Batch, GivesEachTrajectoryWhatItIsAloneWithHertzContacts) {
  expect_same_as_alone(random_rotors(24, false, true), {.sections = true});
}
TEST(Batch, GivesEachTrajectoryWhatItIsAloneWithDampedHertzContacts) {
  expect_same_as_alone(random_rotors(24, true, true), {.tolerance = 1e-8, .sections = true});
}
TEST(Batch, GivesEachTrajectoryItsExponents) {
  expect_same_as_alone(random_rotors(20), {.tolerance = 1e-8, .exponents = true});
}

// Rolling, sliding and smoothly sliding lanes side by side compute their forces in different ways.
TEST(Batch, GivesEachTrajectoryWhatItIsAloneAmongSlidingAndStickingOnes) {
  test::Trajectories sample;
  for (int i = 0; i < 18; ++i) {
    RotorStator p{.kC = 30e6, .mu = i % 2 == 0 ? 0.05 : 0.5, .R = 0.01};
    if (i % 3 == 0) p.slip_tolerance = 0.05;
    Trajectory& t = sample.add(p, 20 + i);
    const double backward = p.Omega * p.R;  // velocity without slip
    t.state = test::state_of((Vec(8) << p.gap + 2e-4, 0, 0, 0, 0, -backward, 0, 0).finished());
  }
  std::vector<Trajectory> batch = sample.all;
  integrate_batch(batch, {.measures = true});
  const auto sticks = [](const Trajectory& t) { return t.contacts[0].sticking > 0.0; };
  const auto sticking = std::count_if(batch.begin(), batch.end(), sticks);
  EXPECT_GT(sticking, 3);
  EXPECT_LT(sticking, 13);
  expect_same_as_alone(sample, {.sections = true, .measures = true});
  expect_same_as_alone(sample, {.tolerance = 1e-8, .exponents = true});
}

/// A rotor whose bearing is stiffer along y than along x.
struct AnisotropicRotor : RotorStator {
  Model model() const {
    Model m = RotorStator::model();
    m.structure.bearings[0] =
        test::bearing(test::body("rotor"), test::orthotropic(kr, 1.5 * kr, cr, cr));
    return m;
  }
};

// Isotropic rotors, others, and such with damped contacts are computed in different ways each, that
// of a batch being the most general one that any of its rotors needs.
TEST(Batch, GivesEachTrajectoryWhatItIsAloneAmongOnesThatNeedMore) {
  for (const bool are_hertz : {false, true}) {
    const test::Trajectories plain = random_rotors(12, false, are_hertz);
    test::Trajectories odd, damped = random_rotors(4, true, are_hertz);
    for (int i = 0; i < 4; ++i) {
      AnisotropicRotor p{{.Omega = 130.0 + 10.0 * i, .kC = 30e6}};
      if (are_hertz) p.kH = 100.0 * p.kC;
      odd.add(p, 20);
    }
    std::vector<Trajectory> among_odd = plain.all, among_damped = plain.all;
    among_odd.insert(among_odd.end(), odd.all.begin(), odd.all.end());
    among_damped.insert(among_damped.end(), damped.all.begin(), damped.all.end());
    integrate_batch(among_odd, {.threads = 1, .sections = true});
    integrate_batch(among_damped, {.threads = 1, .sections = true});
    for (std::size_t i = 0; i < plain.all.size(); ++i) {
      Trajectory alone = plain.all[i];
      integrate_single(alone, {.sections = true});
      EXPECT_TRUE(is_same(among_odd[i], alone)) << i;
      EXPECT_TRUE(is_same(among_damped[i], alone)) << i;
    }
  }
}

TEST(Batch, DoesNotDependOnTheOrderOfTrajectoriesNorOnThreads) {
  const test::Trajectories sample = random_rotors(50);
  std::vector<Trajectory> forward = sample.all;
  integrate_batch(forward, {.threads = 1, .sections = true});
  std::vector<std::size_t> order(forward.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  for (const int threads : {1, 2, 3, 7}) {
    std::vector<Trajectory> shuffled;
    for (const std::size_t i : order) shuffled.push_back(sample.all[i]);
    integrate_batch(shuffled, {.threads = threads, .sections = true});
    for (std::size_t i = 0; i < order.size(); ++i) {
      EXPECT_TRUE(is_same(shuffled[i], forward[order[i]])) << threads << " " << i;
    }
  }
}

// Two methods that share nothing but the equations of motion.
TEST(Batch, AgreesWithDop853) {
  const test::Trajectories sample = random_rotors(12);
  std::vector<Trajectory> batch = sample.all;
  integrate_batch(batch, {.tolerance = 1e-13});
  for (std::size_t i = 0; i < batch.size(); ++i) {
    MotionState state = sample.all[i].state;
    const Integration result = test::run(*sample.scenes[i], state, sample.all[i].revolutions,
                                         {.tolerance = 1e-13, .method = Dop853{}});
    EXPECT_EQ(result.cost.events, batch[i].cost.events) << i;
    EXPECT_LT(distance(*batch[i].system, batch[i].state.y, state.y), 1e-9) << i;
  }
}

TEST(Batch, MeasuresContactsAsTheMeterDoes) {
  constexpr double sampling = 1e-4;  // of a maximum, by parabolas through points of other steps
  test::Trajectories sample = random_rotors(8);
  for (Trajectory& t : sample.all) t.revolutions = 10;
  std::vector<Trajectory> batch = sample.all;
  integrate_batch(batch, {.measures = true});
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const ContactSystem& system = *batch[i].system;
    ContactMeter meter(system);
    MotionState state = sample.all[i].state;
    test::run(*sample.scenes[i], state, 10, {}, [&](const Step& step) {
      meter.add(step);
      return true;
    });
    const ContactMeasure expected = meter.measures()[0];
    const ContactTimes& m = batch[i].contacts[0];
    EXPECT_NEAR(m.in_touch / (10.0 * system.period()), expected.duty, 1e-12);
    EXPECT_NEAR(m.sticking / (10.0 * system.period()), expected.sticking, 1e-12);
    EXPECT_EQ(m.impacts, expected.impacts);
    EXPECT_NEAR(m.max_normal, expected.max_normal, sampling * expected.max_normal);
    EXPECT_NEAR(m.max_tangential, expected.max_tangential, sampling * expected.max_tangential);
  }
}

TEST(Batch, EndsOneTrajectoryWithoutTheOthers) {
  const test::Trajectories sample = random_rotors(12);
  std::vector<Trajectory> batch = sample.all;
  batch[3].state.y(2) = std::numeric_limits<double>::quiet_NaN();
  batch[7].state.y(6) = std::numeric_limits<double>::infinity();
  integrate_batch(batch, {});
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const bool is_bad = i == 3 || i == 7;
    EXPECT_EQ(batch[i].outcome, is_bad ? Outcome::not_finite : Outcome::reached_end) << i;
    EXPECT_EQ(!batch[i].failure, !is_bad);
    if (is_bad) continue;
    Trajectory alone = sample.all[i];
    integrate_single(alone, {});
    EXPECT_TRUE(is_same(batch[i], alone)) << i;
  }
}

// Where the rotor can never touch again the rest is closed form: a million revolutions in a handful
// of steps, and the same sections as step by step.
TEST(Batch, FliesOnInClosedFormWhereNothingCanHappen) {
  RotorStator p{.Omega = 100.0};  // 2.1 mm of unbalance response, 5 mm of sag within 6 mm
  p.gap = 12e-3;
  const Scene scene = p.scene();
  Trajectory t{.system = &scene.contacts, .state = test::start_of(p.model(), scene)};
  t.state.y(0) += 1e-3;
  Trajectory stepped = t;
  t.revolutions = 100;
  integrate_single(t, {.sections = true});
  stepped.revolutions = 100;
  integrate_single(stepped, {.tolerance = 1e-13, .sections = true},
                   [](const Step&) { return true; });
  EXPECT_LT(t.cost.steps, 100);
  EXPECT_GT(stepped.cost.steps, 400);
  ASSERT_EQ(t.sections.size(), stepped.sections.size());
  for (std::size_t i = 0; i < t.sections.size(); i += 8) {
    const Eigen::Map<const Vec> a(&t.sections[i], 8), b(&stepped.sections[i], 8);
    EXPECT_LT(distance(scene.contacts, a, b), 1e-8) << i / 8;  // of the steps before
  }
  Trajectory far = t;
  far.cost = {};
  far.revolutions = 1'000'000;
  integrate_single(far, {});
  EXPECT_LT(far.cost.steps, 50);
  EXPECT_EQ(far.state.revolution, 1'000'100);
  EXPECT_LT(distance(scene.contacts, far.state.y, t.state.y), 1e-8);  // steady since long
}

TEST(Batch, RefusesSystemsOfDifferentShape) {
  const Scene one = test::P1.scene(), other = test::MassInRing{}.scene();
  std::vector<Trajectory> batch(2);
  batch[0].system = &one.contacts;
  batch[1].system = &other.contacts;
  EXPECT_THROW(integrate_batch(batch, {}), NumericalError);
}

TEST(Batch, OfNothingIsNothing) {
  integrate_batch({}, {});
}

}  // namespace whirl::batch_test
