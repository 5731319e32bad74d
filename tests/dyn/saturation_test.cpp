// Currents and voltages of magnetic bearings that saturate.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "libdyn/motions/run_model.hpp"
#include "libdyn/motions/simulate.hpp"
#include "libdyn/system/support_limits.hpp"
#include "libdyn/taylor/batch.hpp"
#include "tests/support/law_proofs.hpp"
#include "tests/support/saturated_magnet.hpp"

namespace whirl::saturation_test {

using test::InMagneticBearing;

Vec disk_of(const Scene& scene, const MotionState& state) {
  const FullState full = full_state(scene, state);
  Vec disk(4);
  disk << full.displacement.head(2), full.velocity.head(2);
  return disk;
}

MotionState rest(const Scene& scene) {
  return {.y = Vec::Zero(scene.contacts.size())};
}

TEST(Saturation, MovesAsItsEquationsSay) {
  for (const InMagneticBearing& rotor : test::saturated_magnets()) {
    const Scene scene = rotor.scene();
    std::vector<Trajectory> one{
        {.system = &scene.contacts, .state = rest(scene), .revolutions = 8}};
    integrate_batch(one, {.tolerance = 1e-12, .measures = true});
    ASSERT_EQ(one[0].outcome, Outcome::reached_end) << one[0].failure;
    EXPECT_GT(one[0].contacts.at(0).impacts, 8);
    const Vec expected = rotor.end_after(8), found = disk_of(scene, one[0].state);
    EXPECT_LT((found - expected).norm(), 1e-8 * expected.norm()) << found.transpose() << "\n"
                                                                 << expected.transpose();
  }
}

class SaturationByMethod : public ::testing::TestWithParam<std::pair<const char*, double>> {};
INSTANTIATE_TEST_SUITE_P(Methods, SaturationByMethod,
                         ::testing::Values(std::pair("dop853", 1e-6),
                                           std::pair("cvode_adams", 1e-3),
                                           std::pair("arkode", 1e-5)),
                         [](const auto& member) { return member.param.first; });

TEST_P(SaturationByMethod, MovesAsInQuadruplePrecision) {
  const auto [name, accuracy] = GetParam();
  for (const InMagneticBearing& rotor : test::saturated_magnets()) {
    const Scene scene = rotor.scene();
    const test::Stretch s{scene, rest(scene), 1, 4};
    test::expect_end_by(name, s, test::exact_end(s, 1e-18), accuracy);
  }
}

TEST(Saturation, ErrorFollowsTheTolerance) {
  for (const InMagneticBearing& rotor : test::saturated_magnets()) {
    const Scene scene = rotor.scene();
    const test::Stretch s{scene, rest(scene), 1, 4};
    test::expect_error_follows_tolerance(s, test::exact_end(s, 1e-20));
  }
}

TEST(Saturation, InABatchIsBitwiseTheSameAsAlone) {
  for (const InMagneticBearing& like : test::saturated_magnets()) {
    std::vector<Scene> scenes;
    std::vector<MotionState> starts;
    for (int i = 0; i < 11; ++i) {
      InMagneticBearing rotor = like;
      rotor.Omega = 300.0 + 9.0 * i;
      rotor.limits.current_limit *= 1.0 + 0.05 * i;
      rotor.limits.voltage_limit *= 1.0 + 0.05 * i;
      scenes.push_back(rotor.scene());
      starts.push_back(rest(scenes.back()));
    }
    test::expect_same_alone(scenes, starts, 1e-8, 50);
  }
}

TEST(Saturation, HasTangentsThatAreLimitsOfDifferences) {
  for (const InMagneticBearing& rotor : test::saturated_magnets()) {
    const Scene scene = rotor.scene();
    MotionState start = rest(scene);
    test::run(scene, start, 3, {.tolerance = 1e-12});
    test::expect_tangent_of_differences({scene, start, 1, 4}, 1e-5, 1e-6);
  }
}

TEST(Saturation, HasTheDivergenceOfItsTangent) {
  for (InMagneticBearing rotor : test::saturated_magnets()) {
    if (rotor.amplifier > 0.0) rotor.filter = 400.0, rotor.amplifier = 300.0;  // that leave digits
    const Scene scene = rotor.scene();
    MotionState start = rest(scene);
    test::run(scene, start, 3, {.tolerance = 1e-12});
    test::expect_divergence({scene, start, 1, 4});
  }
}

TEST(Saturation, MovesByRk4AsByTaylorSeries) {
  for (const InMagneticBearing& rotor : test::saturated_magnets()) {
    const Scene scene = rotor.scene();
    MotionState exact = rest(scene);
    test::run(scene, exact, 2, {.tolerance = 1e-13});
    const double h = scene.contacts.period() / 60000.0;
    std::vector<Trajectory> lanes(
        3, {.system = &scene.contacts, .state = rest(scene), .revolutions = 2});
    integrate_batch_rk4(lanes, {.fixed_step = h});
    EXPECT_LT(distance(scene.contacts, lanes[2].state.y, exact.y), 1e-5);
  }
}

// What does not get to its limit moves as if there were none.
TEST(Saturation, IsNotThereBelowItsLimit) {
  for (InMagneticBearing rotor : test::saturated_magnets()) {
    rotor.U *= 0.01;
    MotionState with = rest(rotor.scene()), without;
    const Scene scene = rotor.scene();
    test::run(scene, with, 5, {.tolerance = 1e-12});
    rotor.limits.current_limit = rotor.limits.voltage_limit = 0.0;
    const Scene free = rotor.scene();
    without = rest(free);
    EXPECT_EQ(free.contacts.contacts().size(), 0u);
    test::run(free, without, 5, {.tolerance = 1e-12});
    const Vec a = disk_of(scene, with), b = disk_of(free, without);
    EXPECT_LT((a - b).norm(), 1e-9 * b.norm());
  }
}

// The bearing does not push harder than its largest current does.
TEST(Saturation, LimitsTheForceOfTheBearing) {
  const InMagneticBearing rotor = test::saturated_magnets()[1];
  const auto run =
      run_model(rotor.model(), {.simulation = {.revolutions = 4, .discard = 4, .samples = 256}});
  const Mat& forces =
      run.simulation.recording.on_supports;  // of the spring -ks, then of the magnet
  ASSERT_EQ(forces.rows(), 4);
  const double largest = forces.bottomRows(2).cwiseAbs().maxCoeff();
  EXPECT_NEAR(largest, rotor.ki * rotor.limits.current_limit, 1e-6 * largest);  // of a float
}

}  // namespace whirl::saturation_test
