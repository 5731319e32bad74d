// Published motions of a two-disk rotor that rubs against a ring: "Nonlinear rotordynamics of a
// MDOF rotor-stator contact system subjected to frictional and gravitational effects". Numbers of
// the paper are called `paper`; what it does not state (bearing nodes, shear coefficient, bearing
// stiffness of its friction-free section) is fitted as docs/validation.md says.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "libdyn/motions/identify.hpp"
#include "libdyn/motions/simulate.hpp"
#include "libfe/analyses/modes.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::two_disk_mac_test {

using test::rpm;
using test::TwoDiskRub;

constexpr double degree = test::pi / 180.0;

// ---- linear -------------------------------------------------------------------------------------

/// Frequency of a mode of all 52 dofs, numbered from 1 [rpm].
double frequency_of_mode(double speed, int number, Whirl whirl) {
  const Scene scene = TwoDiskRub{.speed = speed * rpm, .contact_nodes = {}}.scene();
  const Mode mode =
      complex_modes(scene.system, number).oscillatory.at(static_cast<std::size_t>(number - 1));
  EXPECT_EQ(mode.whirl, whirl);
  return mode.frequency() / rpm;
}

TEST(TwoDiskRub, HasThePublishedFrequencies) {
  struct Case {
    double speed;  // [rpm]
    int mode;
    Whirl whirl;
    double paper;  // [rpm], printed without decimals
  };
  constexpr double tolerance = 1e-3;  // relative: one unit of the last printed digit, and the fits
  for (const Case& c : {Case{2210.0, 2, Whirl::forward, 2119.0},   //
                        Case{4430.0, 1, Whirl::backward, 1652.0},  //
                        Case{4430.0, 2, Whirl::forward, 2254.0},   //
                        Case{7250.0, 1, Whirl::backward, 1454.0},  //
                        Case{7250.0, 4, Whirl::forward, 6888.0}}) {
    EXPECT_NEAR(frequency_of_mode(c.speed, c.mode, c.whirl), c.paper, tolerance * c.paper)
        << "mode " << c.mode << " at " << c.speed << " rpm";
  }
}

// The bearings are damped so strongly that modes at rest cannot follow the second forward mode:
// eight put it 2.3 % too low (6725 rpm for 6884 rpm). The static shapes of the four damper forces
// repair that.
TEST(TwoDiskRub, NeedsTheShapesOfItsDampersForTheSecondForwardMode) {
  Model model = TwoDiskRub{.speed = 7250.0 * rpm, .contact_nodes = {}}.model();
  model.structure.unbalances.clear();  // its shapes would be added too
  const auto second_forward = [&](ReductionMethod method, int size) {
    model.reduction.method = method;
    const Scene scene = make_scene(model);
    EXPECT_EQ(scene.reduced.size(), size);
    const double exact = complex_modes(scene.system, 4).oscillatory.at(3).frequency();
    for (const ReductionError::Pair& pair : scene.error.pairs) {
      const bool is_it = std::abs(pair.full.imag() - exact) < 1e-6 * exact;
      if (is_it) return std::pair(exact / rpm, pair.reduced.imag() / rpm);
    }
    ADD_FAILURE() << "the mode is not in the band";
    return std::pair(0.0, 0.0);
  };
  const auto [full, modal] = second_forward(ReductionMethod::modal, 8);
  EXPECT_NEAR(modal, 6725.0, 1.0);
  EXPECT_NEAR(1.0 - modal / full, 0.023, 5e-4);  // digits of the claim
  const auto [same, residual] = second_forward(ReductionMethod::modal_residual, 12);
  EXPECT_NEAR(residual, same, 1e-4 * same);
}

// ---- rubbing ------------------------------------------------------------------------------------

struct Motion {
  std::vector<ContactMeasure> rings;
  Identification found;
  const IdentifiedPeak& strongest() const { return found.peaks.at(0); }
  /// The peak next to a signed frequency [rpm].
  const IdentifiedPeak& near(double frequency) const {
    return *std::min_element(found.peaks.begin(), found.peaks.end(), [&](auto& a, auto& b) {
      return std::abs(a.frequency - frequency * rpm) < std::abs(b.frequency - frequency * rpm);
    });
  }
};

/// What the rotor ends up doing: revolutions to settle, then as many recorded as resolve 0.2 % of
/// the spin, unless a test needs less.
Motion motion_of(const TwoDiskRub& rotor, const SimulationOptions& how = {}) {
  const Model model = rotor.model();
  const Scene scene = make_scene(model);
  const Simulation simulation = simulate(scene, test::start_of(model, scene), how);
  EXPECT_EQ(simulation.integration.outcome, Outcome::reached_end) << simulation.integration.failure;
  return {simulation.recording.contacts, identify(model, scene, simulation.recording, {})};
}

/// Lines of the paper's spectra are 6 rpm apart.
constexpr double paper_bin = 6.0;
/// A shape is that of one mode.
constexpr double same_shape = 0.99;

// Paper: peaks seen from the rotor at 2052 and 6168 rpm, internal resonance 3:1 of the first
// backward and forward modes; its MAC names modes 1 and 2.
TEST(TwoDiskRub, BouncesInThreeToOneResonance) {
  const Motion motion =
      motion_of({.k = 8e6, .mu = 0.0, .start = {{.mode = 1, .amplitude = 4e-3}, {2, 3e-3, 0.0}}});
  EXPECT_EQ(motion.rings[0].regime(), Regime::intermittent);
  ASSERT_TRUE(motion.found.resonance);
  EXPECT_EQ(motion.found.resonance->p, 3);
  EXPECT_EQ(motion.found.resonance->q, 1);
  EXPECT_LT(motion.found.resonance->error, 1e-4);  // locked: only interpolation of peaks is left
  EXPECT_NEAR(motion.found.resonance->low / rpm, 2052.0, paper_bin);
  EXPECT_NEAR(motion.found.resonance->high / rpm, 6168.0, 2.0 * paper_bin);  // 3 x 2052 is 6156
  const IdentifiedPeak &backward = motion.found.peaks.at(0), &forward = motion.found.peaks.at(1);
  EXPECT_LT(backward.frequency, 0.0);
  EXPECT_GT(forward.frequency, 0.0);
  EXPECT_GT(backward.mac.at(0), same_shape);
  EXPECT_GT(forward.mac.at(1), same_shape);
}

// Paper: 2:1, peaks seen from the rotor at 4104 and 8208 rpm. The ratio is locked; where the peaks
// are depends on the amplitude, and they come out 0.8 % below. The start is near the motion: from
// farther away a chaotic transient leads here or out of contact, as rounding decides.
TEST(TwoDiskRub, BouncesInTwoToOneResonance) {
  const Motion motion =
      motion_of({.speed = 6590.0 * rpm,
                 .k = 8e6,
                 .mu = 0.0,
                 .start = {{1, 3.12e-3, 143.0 * degree}, {2, 1.93e-3, 56.0 * degree}}});
  EXPECT_EQ(motion.rings[0].regime(), Regime::intermittent);
  const double backward = motion.near(-1555.0).frequency / rpm - 6590.0;  // seen from the rotor
  const double forward = motion.near(2517.0).frequency / rpm - 6590.0;
  EXPECT_NEAR(backward / forward, 2.0, 2e-4);  // locked
  EXPECT_NEAR(backward, -8208.0, 0.01 * 8208.0);
  EXPECT_NEAR(forward, -4104.0, 0.01 * 4104.0);
  EXPECT_GT(motion.near(-1555.0).mac.at(0), same_shape);
  EXPECT_GT(motion.near(2517.0).mac.at(1), same_shape);
}

// Paper: friction-induced asynchronous partial contact at 2210 rpm: seen from outside two peaks,
// the spin and a backward one; seen from the rotor one, at the sum of both.
TEST(TwoDiskRub, RubsAsynchronouslyByFriction) {
  const Motion motion =
      motion_of({.speed = 2210.0 * rpm, .start = {{.mode = 2, .amplitude = 2e-3}}});
  EXPECT_EQ(motion.rings[0].regime(), Regime::intermittent);
  ASSERT_EQ(motion.found.peaks.size(), 2u);
  EXPECT_NEAR(motion.strongest().frequency / rpm, 2210.0, 0.01);
  EXPECT_GT(motion.strongest().mac.at(1), same_shape);  // forward, forced
  EXPECT_LT(motion.found.peaks[1].frequency, 0.0);
  EXPECT_GT(motion.found.peaks[1].mac.at(0), same_shape);  // backward
}

/// Whirls in permanent contact are reached soon and have two lines far from one another.
const SimulationOptions brief{.revolutions = 240, .discard = 200};
/// Dense output at the tolerance of the integration, as a velocity [m/s].
constexpr double no_slip = 1e-9;

// Paper: backward whirl of high amplitude in permanent contact, close to rolling, at 7250 rpm;
// modes 1 and 4 in the MAC. Here it rolls: friction sticks all the time. Frequency and radius are
// those of an independent prototype; without a slip velocity in the friction law the whirl would
// grow forever.
TEST(TwoDiskRub, RollsBackwardInPermanentContact) {
  const Motion motion = motion_of(
      {.speed = 7250.0 * rpm, .start = {{.mode = 1, .amplitude = 5e-3}, {2, 5e-3, 0.0}}}, brief);
  EXPECT_EQ(motion.rings[0].regime(), Regime::permanent);
  EXPECT_EQ(motion.rings[0].sticking, 1.0);
  EXPECT_LT(std::abs(motion.rings[0].mean_slip), no_slip);
  EXPECT_NEAR(motion.strongest().frequency / rpm, -4941.0, 1.0);
  EXPECT_NEAR(motion.strongest().amplitude, 16.4e-3, 0.05e-3);
  const auto& mac = motion.strongest().mac;
  EXPECT_EQ(std::max_element(mac.begin(), mac.end()), mac.begin());  // mode 1, backward
  EXPECT_GT(motion.near(7250.0).mac.at(3), 0.9);                     // mode 4, second forward
}

// Contacts at both disks with gravity at 6110 rpm. The paper shows 3:1 bouncing there, which was
// not found; these are the motions with contact that were (docs/validation.md).
TEST(TwoDiskRub, WithTwoRingsWhirlsBackwardOrBouncesOnOneOfThem) {
  const TwoDiskRub hard{.speed = 6110.0 * rpm,
                        .start = {{.mode = 1, .amplitude = 6e-3}, {2, 6e-3, 0.0}},
                        .contact_nodes = {4, 9},
                        .gravity = 9.81};
  const Motion whirling = motion_of(hard, brief);
  EXPECT_EQ(whirling.rings[0].regime(), Regime::permanent);
  EXPECT_EQ(whirling.rings[1].regime(), Regime::permanent);
  EXPECT_NEAR(whirling.strongest().frequency / rpm, -4590.0, 1.0);
  EXPECT_NEAR(whirling.strongest().amplitude, 23.4e-3, 0.1e-3);

  TwoDiskRub soft = hard;
  soft.start = {{.mode = 1, .amplitude = 5e-3}, {2, 2e-3, 0.0}};
  const Motion bouncing = motion_of(soft, brief);
  EXPECT_EQ(bouncing.rings[0].regime(), Regime::none);
  EXPECT_EQ(bouncing.rings[1].regime(), Regime::intermittent);
  EXPECT_NEAR(bouncing.strongest().frequency / rpm, -1743.0, 1.0);
  EXPECT_NEAR(bouncing.near(-9597.0).frequency / rpm, -9597.0, 1.0);
}

}  // namespace whirl::two_disk_mac_test
