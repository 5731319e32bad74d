// What probes read of unbalance responses, motions and frequency responses, in closed form.

#include <gtest/gtest.h>

#include <cmath>

#include "libdyn/linear/frequency_response.hpp"
#include "libdyn/linear/static_study.hpp"
#include "libdyn/linear/unbalance_study.hpp"
#include "libdyn/motions/run_model.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libdyn/orbits/orbit_measure.hpp"
#include "libdyn/orbits/shooting.hpp"
#include "libdyn/system/model.hpp"
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

// A face on springs against tilts, under an overturning moment about x: theta_x = M / kt at rest,
// and M / (kt - Id w^2 + i ct w) where the moment oscillates. The probe reads r (theta_x sin a -
// theta_y cos a).
TEST(Probes, AxialOnesReadTheTiltsOfAFace) {
  constexpr double kt = 5e3, ct = 3.0, Id = 0.02, M = 7.0, r = 0.15, Omega = 80.0;
  const Station rotor = test::body("rotor");
  Model model;
  Structure& s = model.structure;
  s.bodies = {{.name = "rotor", .m = m, .tilts = true, .Id = Id}};
  BearingCoefficients springs = test::orthotropic(kx, ky, c, c);
  springs.Kt.diagonal().setConstant(kt);
  springs.Ct.diagonal().setConstant(ct);
  s.bearings = {test::bearing(rotor, springs)};
  s.probes = {{.name = "top", .at = rotor, .angle = 0.5 * pi, .face_radius = r},
              {.name = "side", .at = rotor, .angle = 0.0, .face_radius = r},
              {.name = "oblique", .at = rotor, .angle = pi / 6.0, .face_radius = 2.0 * r}};
  model.speed = Omega;
  model.has_speed = true;
  const std::vector<double> seen{r, 0.0, r};  // r sin a

  Force steady{.name = "M", .kind = ForceKind::moment, .at = rotor, .size = M};
  s.forces = {steady};
  const StaticStudy rest = static_study(model, Assembler(s));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(rest.probes[i].mean, seen[i] * M / kt, 1e-15);

  steady.order = 2.0;
  s.forces = {steady};
  const Complex theta = M / Complex(kt - 4.0 * Id * Omega * Omega, 2.0 * ct * Omega);
  const Assembler assembler(s);
  const UnbalanceStudy study = unbalance_study(model, assembler, {.speeds = {Omega}});
  ASSERT_EQ(study.forced_probes.size(), 3u);
  const whirl::Run run =
      run_model(model, {.simulation = {.revolutions = 1, .discard = 200, .samples = 64}});
  const std::vector<ProbeSignal> signals = recorded_motion(run).probes;
  const std::vector<ProbeSummary> told = run_summary(run).probes;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(std::abs(study.forced_probes[i].amplitude(0) - seen[i] * theta),
              1e-12 * std::abs(theta));
    EXPECT_NEAR(signals[i].displacement(0), seen[i] * theta.real(), 1e-7 * r * std::abs(theta));
    EXPECT_NEAR(told[i].peak_to_peak, 2.0 * seen[i] * std::abs(theta), 0.01 * r * std::abs(theta));
  }

  // a force along z on the face at the probe is a moment, so a response from it to itself is r^2 /
  // (...)
  const std::vector<ResponseEnd> top = select_ends(model, assembler, "top");
  const Complex own =
      frequency_response(assembler, Omega, {100.0}, top, top).pairs.at(0).receptance(0);
  const Complex right = r * r / Complex(kt - Id * 1e4, ct * 100.0);
  EXPECT_LT(std::abs(own - right), 1e-11 * std::abs(right));
}

// Of unbalance's tilts at every speed of a curve: theta of the node that the probe is at.
TEST(Probes, AxialOnesFollowTheUnbalanceResponse) {
  Model model;
  model.structure = test::Overhung{}.structure();
  Structure& s = model.structure;
  const Station disk = s.disks.at(0).at;
  s.unbalances = {{.at = disk, .moment = U}};
  s.probes = {{.name = "face", .at = disk, .angle = 0.0, .face_radius = 0.1}};
  const Assembler assembler(s);
  const UnbalanceStudy study =
      unbalance_study(model, assembler, {.speeds = {50.0, 150.0}, .has_given_speeds = true});
  UnbalanceSolver solver(assembler);
  const auto expect = [&](const CVec& told, const std::vector<double>& speeds) {
    ASSERT_EQ(told.size(), std::ssize(speeds));
    for (Eigen::Index i = 0; i < told.size(); ++i) {
      const CVec u = *solver.at(speeds[static_cast<std::size_t>(i)]);
      const Complex theta_y = u(assembler.dofs().full_index(assembler.point(disk), THETA_Y));
      EXPECT_LT(std::abs(told(i) + 0.1 * theta_y), 1e-12 * std::abs(theta_y));
    }
  };
  expect(study.probes[0].amplitude, study.speeds);
  EXPECT_GT(study.curve_speeds.size(), 2u);
  expect(study.probes[0].curve_amplitude, study.curve_speeds);
}

TEST(Probes, AxialOnesNeedTilts) {
  Model model = orthotropic();
  model.structure.probes[0].face_radius = 0.1;
  EXPECT_THROW(Assembler{model.structure}, ModelError);
}

}  // namespace whirl::probes_test
