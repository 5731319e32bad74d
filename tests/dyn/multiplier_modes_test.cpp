// Modes of multipliers: without contact each multiplier is e^(lambda T) of one mode, and its
// direction is that mode.

#include "libdyn/orbits/multiplier_modes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "libdyn/orbits/contact_flow.hpp"
#include "libfe/analyses/modes.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::multiplier_modes_test {

constexpr double rounding = 1e-8;  ///< of multipliers, after a revolution at a tolerance of 1e-10

/// Two masses between springs that differ in both planes, so that no two modes are alike.
Model two_masses() {
  Model m = test::RotorStator{.Omega = 140.0}.model();
  m.contacts.clear();
  m.structure.bearings = {
      test::bearing(test::body("rotor"), test::orthotropic(9e5, 1.3e6, 300.0, 500.0)),
      test::bearing(test::body("stator"), test::orthotropic(4e6, 7e6, 900.0, 2000.0)),
      test::connect(test::body("rotor"), test::body("stator"), test::isotropic(2e5, 40.0))};
  return m;
}

TEST(MultiplierModes, AreTheModesThemselvesWithoutContact) {
  const Model model = two_masses();
  const Scene scene = make_scene(model);
  const PeriodicOrbit orbit =
      find_orbit(flow_of(scene.contacts), Vec(Vec::Zero(scene.contacts.size())), {});
  ASSERT_TRUE(orbit.is_good()) << orbit.failure;
  const std::vector<Mode> modes = complex_modes(scene.system, 4).oscillatory;
  const std::vector<MultiplierMode> found = modes_of_multipliers(scene, orbit);
  ASSERT_EQ(found.size(), 8u);
  std::vector<int> times(modes.size(), 0);
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_GE(found[i].mode, 1);
    const Mode& mode = modes.at(static_cast<std::size_t>(found[i].mode - 1));
    ++times[static_cast<std::size_t>(found[i].mode - 1)];
    EXPECT_NEAR(found[i].mac, 1.0, rounding);
    const double size = std::abs(orbit.multipliers(static_cast<Eigen::Index>(i)));
    EXPECT_NEAR(size, std::exp(mode.lambda.real() * scene.contacts.period()), rounding);
  }
  EXPECT_EQ(times, (std::vector<int>{2, 2, 2, 2}));  // each with its conjugate
}

TEST(MultiplierModes, AreNoneWithoutTangents) {
  const Scene scene = make_scene(two_masses());
  PeriodicOrbit orbit;
  orbit.multipliers = CVec::Ones(8);
  for (const MultiplierMode& m : modes_of_multipliers(scene, orbit)) EXPECT_EQ(m.mode, 0);
}

}  // namespace whirl::multiplier_modes_test
