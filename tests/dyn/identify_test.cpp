// MAC tables: pure modes are found as themselves, and ratios of frequencies by small numbers.

#include "libdyn/motions/identify.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "libfe/analyses/campbell.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::identify_test {

using test::rpm;
using test::TwoDiskRub;

/// All dofs, so that modes are motions of the scene exactly.
Model two_disks() {
  return TwoDiskRub{.speed = 4430.0 * rpm, .modes = 0}.model();
}

/// A steady motion of one mode's shape and frequency, as if it were not damped.
Recording pure_mode(const Scene& scene, const Mode& mode, double amplitude, long revolutions) {
  Recording r{.samples = 32, .revolutions = revolutions, .clock = scene.contacts.clock()};
  r.eta.resize(scene.contacts.coordinates(), revolutions * r.samples);
  for (Eigen::Index j = 0; j < r.eta.cols(); ++j) {
    const double t = static_cast<double>(j) * r.spacing();
    r.eta.col(j) = (std::polar(amplitude, mode.frequency() * t) * mode.shape).real();
  }
  return r;
}

TEST(Identify, FindsAPureModeAsItself) {
  const Model model = two_disks();
  const Scene scene = make_scene(model);
  const std::vector<Mode> modes = complex_modes(scene.system, 6).oscillatory;
  for (const bool mass_weighted : {false, true}) {
    for (const bool rotations : {false, true}) {
      for (int i = 0; i < 4; ++i) {
        const Mode& mode = modes[static_cast<std::size_t>(i)];
        const Identification found =
            identify(model, scene, pure_mode(scene, mode, 1e-3, 120),
                     {.modes = 6, .rotations = rotations, .mass_weighted = mass_weighted});
        ASSERT_GE(found.peaks.size(), 1u);
        const IdentifiedPeak& peak = found.peaks[0];
        EXPECT_EQ(peak.mode, i);
        EXPECT_NEAR(peak.mac.at(static_cast<std::size_t>(i)), 1.0, 1e-6);  // leakage of the window
        EXPECT_NEAR(peak.shift, 0.0, 1e-4);
        EXPECT_NEAR(peak.amplitude, 1e-3, 1e-3 * 1e-3);
        EXPECT_EQ(peak.frequency > 0.0, mode.whirl == Whirl::forward);
      }
    }
  }
}

// With every dof the reduced rotor is the whole one; with few modes its own modes are what it moves
// in.
TEST(Identify, ComparesWithTheModesOfTheReducedRotor) {
  const Model whole = two_disks();
  const Scene scene = make_scene(whole);
  const std::vector<Mode> exact = complex_modes(scene.system, 6).oscillatory;
  const auto compared = [](const Model& model, const Scene& at, const Mode& mode) {
    const CVec coordinates = NearestCoordinates(at).matrix() * mode.shape;
    Mode moved = mode;
    moved.shape = coordinates;
    return identify(model, at, pure_mode(at, moved, 1e-3, 60), {.modes = 6, .reduced = true}).modes;
  };
  const std::vector<Mode> same = compared(whole, scene, exact[0]);
  ASSERT_EQ(same.size(), exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i) {
    EXPECT_NEAR(same[i].frequency(), exact[i].frequency(), 1e-8 * exact[i].frequency());
  }
  const Model few = TwoDiskRub{.speed = 4430.0 * rpm, .modes = 4}.model();
  const std::vector<Mode> own = compared(few, make_scene(few), exact[0]);
  ASSERT_FALSE(own.empty());
  const double off = std::abs(own[0].frequency() / exact[0].frequency() - 1.0);
  EXPECT_GT(off, 1e-9);
  EXPECT_LT(off, 0.05);
}

// Two forward circles, 6 bins above and 18 below the spin: seen from the rotor they turn with 1 : 3
// of a slow frequency, and both of them do turn.
TEST(Identify, SeesResonancesOfSlowMotionsInTheRotatingFrame) {
  const Model model = two_disks();
  const Scene scene = make_scene(model);
  const Mode* forward = nullptr;
  const std::vector<Mode> modes = complex_modes(scene.system, 6).oscillatory;
  for (const Mode& m : modes) {
    if (!forward && m.whirl == Whirl::forward) forward = &m;
  }
  ASSERT_NE(forward, nullptr);
  constexpr long revolutions = 120;
  const double spin = scene.system.Omega, bin = spin / revolutions;
  Recording r = pure_mode(scene, *forward, 0.0, revolutions);
  for (const double frequency : {spin + 6.0 * bin, spin - 18.0 * bin}) {
    Mode turning = *forward;
    turning.lambda = Complex(0.0, frequency);
    r.eta += pure_mode(scene, turning, 1e-3, revolutions).eta;
  }
  const auto resonance = identify(model, scene, r, {.modes = 6}).resonance;
  ASSERT_TRUE(resonance);
  EXPECT_EQ(resonance->p, 3);
  EXPECT_EQ(resonance->q, 1);
  constexpr double between_bins = 1e-3;  // of a bin: what is left of the window
  EXPECT_NEAR(resonance->low, 6.0 * bin, between_bins * bin);
  EXPECT_NEAR(resonance->high, 18.0 * bin, between_bins * bin);
}

// Undamped modes at rest are orthogonal by the mass matrix: their MAC table is the identity. In
// complex shapes x and y count together, so one plane is enough.
TEST(Mac, WeightedByMassIsTheIdentityForUndampedModes) {
  Model model = TwoDiskRub{.speed = 0.0, .c = 0.0, .modes = 0}.model();
  model.has_speed = true;
  for (Connection& b : model.structure.bearings) {  // planes apart, so that modes are simple
    b.coefficients = constant_bearing(test::orthotropic(4e6, 3e6));
  }
  const Scene scene = make_scene(model);
  const std::vector<Mode> modes = complex_modes(scene.system, 8).oscillatory;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    for (std::size_t j = 0; j < modes.size(); ++j) {
      EXPECT_NEAR(mac(modes[i].shape, modes[j].shape, scene.system.M), i == j ? 1.0 : 0.0, 1e-10)
          << i << " " << j;
    }
  }
}

TEST(Mac, DoesNotDependOnScaleAndPhase) {
  const Scene scene = make_scene(two_disks());
  const std::vector<Mode> modes = complex_modes(scene.system, 3).oscillatory;
  const Sparse W = mac_weights(scene.system.dofs, 0.6);
  const CVec turned = std::polar(7.0, 1.1) * modes[1].shape;
  EXPECT_NEAR(mac(modes[1].shape, turned, W), 1.0, 1e-12);
  EXPECT_NEAR(mac(modes[2].shape, turned, W), mac(modes[2].shape, modes[1].shape, W), 1e-12);
  EXPECT_EQ(mac(CVec::Zero(turned.size()), turned, W), 0.0);
}

// The weights count translations once and tilts by the square of a length.
TEST(Mac, WeightsTranslationsAndTilts) {
  const Scene scene = make_scene(two_disks());
  const DofMap& dofs = scene.system.dofs;
  const Mat W = mac_weights(dofs, 0.5);
  const Vec x = dofs.row({Point::Kind::node, 3}, X),
            tilt = dofs.row({Point::Kind::node, 3}, THETA_X);
  EXPECT_NEAR(x.dot(W * x), 1.0, 1e-12);
  EXPECT_NEAR(tilt.dot(W * tilt), 0.25, 1e-12);
  EXPECT_NEAR(tilt.dot(Mat(mac_weights(dofs, 0.0)) * tilt), 0.0, 1e-12);
}

// A closed contact adds its stiffness at its station, and modes rise.
TEST(Stiffened, HasTheStiffnessOfItsContacts) {
  const Model model = two_disks();
  const Scene scene = make_scene(model);
  const Vec at_ring = scene.system.dofs.row({Point::Kind::node, 6}, Y);
  const Mat added = Mat(stiffened(model, scene).K) - Mat(scene.system.K);
  EXPECT_NEAR(at_ring.dot(added * at_ring), 4e6, 1e-6 * 4e6);
  EXPECT_NEAR(added.norm(), std::sqrt(2.0) * 4e6, 1e-6 * 4e6);  // x and y, nothing else
  EXPECT_GT(complex_modes(stiffened(model, scene), 1).oscillatory[0].frequency(),
            1.1 * complex_modes(scene.system, 1).oscillatory[0].frequency());
}

// A closed face holds the tilts of its disk, by its radius squared, and no displacement.
TEST(Stiffened, HoldsTheTiltsAtAFace) {
  constexpr double k = 1e7, radius = 0.12;
  Model model = two_disks();
  model.contacts[0].friction = {};
  model.contacts[0].law = Face<>{.k = k, .radius = radius};
  const Scene scene = make_scene(model);
  const Mat added = Mat(stiffened(model, scene).K) - Mat(scene.system.K);
  const DofMap& dofs = scene.system.dofs;
  const Vec across = dofs.row({Point::Kind::node, 6}, X),
            tilt = dofs.row({Point::Kind::node, 6}, THETA_Y);
  EXPECT_NEAR(across.dot(added * across), 0.0, 1e-12 * k);
  EXPECT_NEAR(tilt.dot(added * tilt), k * radius * radius, 1e-6 * k * radius * radius);
}

// ---- ratios -------------------------------------------------------------------------------------

TEST(RatioOf, FindsSmallNumbers) {
  for (int p = 1; p <= 9; ++p) {
    for (int q = 1; q <= p; ++q) {
      if (std::gcd(p, q) != 1) continue;
      const FrequencyRatio r = ratio_of(100.0 * p, 100.0 * q);
      EXPECT_NEAR(static_cast<double>(r.p) / r.q, static_cast<double>(p) / q, 0.01 * p / q);
      const bool has_smaller_neighbor = r.p + r.q < p + q;  // within a percent of it
      if (!has_smaller_neighbor) {
        EXPECT_EQ(r.p, p);
        EXPECT_EQ(r.q, q);
        EXPECT_LT(r.error, 1e-15);
      }
    }
  }
  const FrequencyRatio near = ratio_of(3.006, 1.0);
  EXPECT_EQ(near.p, 3);
  EXPECT_EQ(near.q, 1);
  EXPECT_NEAR(near.error, 0.002, 1e-12);
  EXPECT_EQ(near.high, 3.006);
  EXPECT_EQ(near.low, 1.0);
}

}  // namespace whirl::identify_test
