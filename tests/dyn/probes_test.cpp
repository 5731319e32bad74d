// What probes read of unbalance responses, motions and frequency responses, in closed form.

#include <gtest/gtest.h>

#include <cmath>

#include "libdyn/motions/frequency_response.hpp"
#include "libdyn/motions/run_model.hpp"
#include "libdyn/motions/unbalance_study.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libdyn/orbits/orbit_measure.hpp"
#include "libdyn/orbits/shooting.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::probes_test {

using test::pi;
constexpr double m = 2.0, kx = 2e4, ky = 3e4, c = 40.0, U = 2e-4, g = 9.81;
constexpr double solves = 1e-11;  // relative, of solvers on two dofs

/// A mass on springs that differ, with probes at 45 and 135 degrees, in um and in mil.
Model orthotropic() {
  const Station rotor = test::body("rotor");
  Model model;
  Structure& s = model.structure;
  s.bodies = {{.name = "rotor", .m = m, .spins = true}};
  s.bearings = {test::bearing(rotor, test::orthotropic(kx, ky, c, c))};
  s.unbalances = {{.at = rotor, .moment = U}};
  s.probes = {{.name = "right", .at = rotor, .angle = 0.25 * pi},
              {.name = "left", .at = rotor, .angle = 0.75 * pi, .unit = "mil"}};
  s.gravity = g;
  model.speed = 60.0;
  model.has_speed = true;
  return model;
}

/// U Omega^2 / (k - m Omega^2 + i c Omega)
Complex along_axis(double k, double Omega) {
  return U * Omega * Omega / Complex(k - m * Omega * Omega, c * Omega);
}

/// X cos a + Y sin a, where the force along y lags by a quarter turn.
Complex reading(double angle, double Omega) {
  return std::cos(angle) * along_axis(kx, Omega) -
         Complex(0.0, 1.0) * std::sin(angle) * along_axis(ky, Omega);
}

TEST(Probes, ReadTheUnbalanceResponseAlongTheirDirections) {
  const Model model = orthotropic();
  const Assembler assembler(model.structure);
  const UnbalanceStudy study =
      unbalance_study(model, assembler,
                      {.speeds = {20.0, 100.0, 180.0},
                       .has_given_speeds = true,
                       .stations = select_points(model, assembler, "all")});
  ASSERT_EQ(study.probes.size(), 2u);
  for (const ProbeResponse& probe : study.probes) {
    for (Eigen::Index i = 0; i < 3; ++i) {
      const Complex R = reading(probe.angle, study.speeds[static_cast<std::size_t>(i)]);
      EXPECT_LT(std::abs(probe.amplitude(i) - R), solves * std::abs(R));
      EXPECT_NEAR(probe.peak_to_peak()(i), 2.0 * std::abs(R), solves * std::abs(R));
      EXPECT_NEAR(probe.phase_deg()(i), std::arg(R) * 180.0 / pi, 1e-8);
    }
    ASSERT_EQ(probe.curve_amplitude.size(), std::ssize(study.curve_speeds));
    const Complex last = reading(probe.angle, 180.0);
    EXPECT_LT(std::abs(probe.curve_amplitude.tail(1)(0) - last), solves * std::abs(last));
  }
  EXPECT_EQ(study.probes[1].unit, "mil");
}

// The largest of |R(Omega)|, by steps of 0.01 rad/s, whose own error is below 1e-6 of the size.
TEST(Probes, HavePeaksOfTheirOwn) {
  constexpr double of_steps = 1e-6;
  const Model model = orthotropic();
  const Assembler assembler(model.structure);
  const UnbalanceStudy study = unbalance_study(
      model, assembler, {.speeds = {0.0, 200.0}, .stations = select_points(model, assembler, "")});
  for (const ProbeResponse& probe : study.probes) {
    double top = 0.0, at = 0.0;
    for (double Omega = 10.0; Omega < 200.0; Omega += 0.01) {
      const double size = std::abs(reading(probe.angle, Omega));
      if (size > top) top = size, at = Omega;
    }
    EXPECT_NEAR(probe.largest.amplitude, top, of_steps * top);
    EXPECT_NEAR(probe.largest.speed, at, 0.01);
    ASSERT_FALSE(probe.peaks.empty());
  }
  // both read the same motion from directions that are mirrored: their sizes differ
  EXPECT_GT(std::abs(study.probes[0].largest.amplitude - study.probes[1].largest.amplitude),
            0.01 * study.probes[0].largest.amplitude);
}

// The steady motion: mean -m g / ky sin a, peak to peak 2 |R| but for where samples lie.
TEST(Probes, ReadMotions) {
  const Model model = orthotropic();
  RunOptions options{.simulation = {.revolutions = 4, .discard = 100, .samples = 64}};
  const whirl::Run run = run_model(model, options);
  const std::vector<ProbeSummary> probes = run_summary(run).probes;
  const MotionRecord record = recorded_motion(run);
  ASSERT_EQ(probes.size(), 2u);
  ASSERT_EQ(record.probes.size(), 2u);
  const double between_samples = std::cos(pi / 64.0);
  for (std::size_t i = 0; i < 2; ++i) {
    const double a = probes[i].angle, exact = 2.0 * std::abs(reading(a, 60.0));
    EXPECT_NEAR(probes[i].mean, -m * g / ky * std::sin(a), 1e-9 * m * g / ky);
    EXPECT_LE(probes[i].peak_to_peak, exact * (1.0 + 1e-7));
    EXPECT_GE(probes[i].peak_to_peak, exact * between_samples);
    const Vec& d = record.probes[i].displacement;
    ASSERT_EQ(d.size(), 4 * 64);
    EXPECT_DOUBLE_EQ(d.maxCoeff() - d.minCoeff(), probes[i].peak_to_peak);
    const double at_start = reading(a, 60.0).real() - m * g / ky * std::sin(a);  // phase 0
    EXPECT_NEAR(d(0), at_start, 1e-7 * exact);
  }
}

// 2 |R| of the periodic orbit, but for where its instants lie: ten a step of about a radian.
TEST(Probes, ReadOrbits) {
  const Model model = orthotropic();
  const Scene scene = make_scene(model);
  const PeriodicOrbit orbit =
      find_orbit(flow_of(scene.contacts), Vec::Zero(scene.contacts.size()), {});
  ASSERT_TRUE(orbit.is_good()) << orbit.failure;
  const auto found = measure_orbit(scene, {}, orbit.states[0], 1.0).probe_peak_to_peak;
  ASSERT_EQ(found.size(), 2u);
  for (const std::size_t i : {0u, 1u}) {
    const double angle = model.structure.probes[i].angle;
    const double exact = 2.0 * std::abs(reading(angle, model.speed));
    EXPECT_LE(found[i], exact * (1.0 + solves));
    EXPECT_GE(found[i], exact * std::cos(0.1));
  }
}

// cos a (1 / (kx - m w^2 + i c w)) by a force along x, and the same by one along the probe of a
// motion along x
TEST(Probes, AreEndsOfFrequencyResponses) {
  const Model model = orthotropic();
  const Assembler assembler(model.structure);
  const auto x = select_ends(model, assembler, "rotor:x");
  const auto probe = select_ends(model, assembler, "right");
  ASSERT_EQ(probe.size(), 1u);
  EXPECT_EQ(probe[0].label(), "right");
  const double w = 90.0;
  const Complex H = std::cos(pi / 4.0) / Complex(kx - m * w * w, c * w);
  for (const auto& [from, to] : {std::pair(x, probe), std::pair(probe, x)}) {
    const FrequencyResponse found = frequency_response(assembler, 0.0, {w}, from, to);
    EXPECT_LT(std::abs(found.pairs.at(0).receptance(0) - H), solves * std::abs(H));
  }
}

}  // namespace whirl::probes_test
