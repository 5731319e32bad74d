// Which modes the multipliers of an orbit belong to: known without contact.

#include "libdyn/multiplier_modes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "libdyn/contact_flow.hpp"
#include "libdyn/shooting.hpp"
#include "libfe/modes.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::multiplier_modes_test {

constexpr double solves = 1e-8;  // eigenvalues of a monodromy matrix whose steps are good to 1e-13

/// The rotor within its stator, too far from it to touch, on springs that make four pairs of
/// eigenvalues: their directions are unique, and cross-coupling makes them complex.
Scene apart() {
  Model model = test::RotorStator{.Omega = 110.0, .gap = 50e-3}.model();
  Mat2 K, C;
  K << 1.0e6, 2.0e5, -5.0e4, 1.6e6;
  C << 400.0, 0.0, 0.0, 900.0;
  model.structure.bearings[0].coefficients = ConstantBearing{{.K = K, .C = C}};
  K << 14.0e6, 0.0, 0.0, 19.0e6;
  C << 2700.0, 0.0, 0.0, 3500.0;
  model.structure.bearings[1].coefficients = ConstantBearing{{.K = K, .C = C}};
  return make_scene(model);
}

// Where nothing touches, the multipliers are exp(lambda T) of the modes, and their directions are
// the states (eta, lambda eta) of those modes: MAC = 1.
TEST(MultiplierModes, AreTheModesThemselvesWithoutContact) {
  const Scene scene = apart();
  const PeriodicOrbit orbit = find_orbit(flow_of(scene.contacts), Vec::Zero(8), {});
  ASSERT_TRUE(orbit.is_good()) << orbit.failure;
  const std::vector<Mode> modes = complex_modes(scene.system, 4).oscillatory;
  ASSERT_EQ(modes.size(), 4u);
  const std::vector<MultiplierMode> found = modes_of_multipliers(scene, orbit);
  ASSERT_EQ(found.size(), 8u);
  std::vector<int> count(5, 0);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Complex mu = orbit.multipliers(static_cast<Eigen::Index>(i));
    ASSERT_GE(found[i].mode, 1);
    ASSERT_LE(found[i].mode, 4);
    const Complex lambda = modes[static_cast<std::size_t>(found[i].mode - 1)].lambda;
    const Complex expected = std::exp(lambda * scene.contacts.period());
    EXPECT_LT(std::min(std::abs(mu - expected), std::abs(std::conj(mu) - expected)), solves) << i;
    EXPECT_NEAR(found[i].mac, 1.0, solves) << i;
    ++count[static_cast<std::size_t>(found[i].mode)];
  }
  EXPECT_EQ(count, (std::vector<int>{0, 2, 2, 2, 2}));  // a pair of each
}

TEST(MultiplierModes, NeedTangents) {
  const Scene scene = apart();
  PeriodicOrbit orbit;
  orbit.multipliers = CVec::Zero(8);
  for (const MultiplierMode& m : modes_of_multipliers(scene, orbit)) {
    EXPECT_EQ(m.mode, 0);
    EXPECT_EQ(m.mac, 0.0);
  }
}

}  // namespace whirl::multiplier_modes_test
