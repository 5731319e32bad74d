// Forces that do not follow from the motion: their loads and the steady responses to them, against
// closed forms.

#include "libfe/assembly/excitations.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "libfe/analyses/bending.hpp"
#include "libfe/analyses/static.hpp"
#include "libfe/analyses/unbalance.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::excitations_test {

using namespace test;

constexpr double m = 2.0, k = 2e4, c = 40.0;
constexpr double rounding = 1e-12;  ///< relative, of a solver on few dofs

/// A mass on an isotropic spring and damper, which tilts, with forces.
Structure mass_on_spring(std::vector<Force> forces) {
  Structure s;
  s.bodies.push_back({.name = "rotor", .m = m, .spins = true, .tilts = true, .Id = 0.02});
  BearingCoefficients spring = isotropic(k, c);
  spring.Kt.diagonal().setConstant(300.0);
  s.bearings.push_back(bearing(body("rotor"), spring));
  s.forces = std::move(forces);
  return s;
}

const std::vector<Point> rotor{{Point::Kind::body, 0}};

void expect_near(Complex found, Complex expected) {
  EXPECT_LT(std::abs(found - expected), rounding * std::max(1e-12, std::abs(expected)))
      << found << " " << expected;
}

/// 1 / (k - m w^2 + i c w)
Complex receptance(double w) {
  return 1.0 / Complex(k - m * w * w, c * w);
}

// A constant force F at angle a moves a mass by F / k along it; a moment turns it by M / k_t.
TEST(Excitations, ConstantOnesAreInTheStaticEquilibrium) {
  const Structure s = mass_on_spring({{.at = body("rotor"), .size = 30.0, .angle = 0.4},
                                      {.kind = ForceKind::moment,
                                       .at = body("rotor"),
                                       .size = 6.0,
                                       .angle = std::numbers::pi / 2}});
  const StaticEquilibrium at_rest = static_equilibrium(Assembler(s), 50.0);
  EXPECT_NEAR(at_rest.displacement(0), 30.0 * std::cos(0.4) / k, 1e-17);
  EXPECT_NEAR(at_rest.displacement(1), 30.0 * std::sin(0.4) / k, 1e-17);
  EXPECT_NEAR(at_rest.displacement(2), 0.0, 1e-17);
  EXPECT_NEAR(at_rest.displacement(3), 6.0 / 300.0, 1e-16);
  EXPECT_NEAR(at_rest.bearings[0].fx(), 30.0 * std::cos(0.4), 1e-12);
}

// A base that accelerates by g along +y for good is gravity: sag, loads and the line of the shaft.
TEST(Excitations, AConstantAccelerationOfTheBaseIsGravity) {
  Structure heavy = two_disk(orthotropic(2e7, 3e7, 4e3, 5e3)), shaken = heavy;
  heavy.gravity = 9.81;
  shaken.forces = {
      {.kind = ForceKind::base_acceleration, .size = 9.81, .angle = std::numbers::pi / 2}};
  const Assembler a(heavy), b(shaken);
  const StaticEquilibrium one = static_equilibrium(a, 100.0), other = static_equilibrium(b, 100.0);
  const double size = one.displacement.norm();
  EXPECT_LT((one.displacement - other.displacement).norm(), 1e-12 * size);
  const BendingLine line = bending_line(a, 100.0, one.displacement),
                    same = bending_line(b, 100.0, other.displacement);
  EXPECT_LT((line.moment - same.moment).norm(), 1e-9 * line.moment.norm());
  EXPECT_LT((line.shear - same.shear).norm(), 1e-9 * line.shear.norm());
}

// Along a direction (F cos a, F sin a) e^(i p) H(Omega); forward (1, -i) e^(i p), backward (1, i)
// e^(-i p).
TEST(Excitations, OfOrderOneAreInTheResponseToUnbalance) {
  constexpr double Omega = 70.0, F = 5.0, p = 0.7, U = 3e-4;
  const Complex H = receptance(Omega), i(0.0, 1.0);
  const auto response = [&](Force force) {
    force.at = body("rotor");
    force.size = F;
    force.order = 1.0;
    force.phase = p;
    Structure s = mass_on_spring({force});
    s.unbalances = {{.at = body("rotor"), .moment = U}};
    return unbalance_response(Assembler(s), {Omega}, rotor);
  };
  const Complex unbalance = U * Omega * Omega;
  const UnbalanceResponse along = response({.angle = 0.3});
  expect_near(along.x(0, 0), H * (F * std::cos(0.3) * std::polar(1.0, p) + unbalance));
  expect_near(along.y(0, 0), H * (F * std::sin(0.3) * std::polar(1.0, p) - i * unbalance));
  const UnbalanceResponse forward = response({.turning = Turning::forward});
  expect_near(forward.y(0, 0), -i * forward.x(0, 0));
  expect_near(forward.x(0, 0), H * (F * std::polar(1.0, p) + unbalance));
  const UnbalanceResponse backward = response({.turning = Turning::backward});
  expect_near(backward.x(0, 0), H * (F * std::polar(1.0, -p) + unbalance));
  expect_near(backward.y(0, 0), H * i * (F * std::polar(1.0, -p) - unbalance));
}

// Without speed a force of order 1 stands still: at an unbalance response of 0 rpm it bends as one.
TEST(Excitations, OfOrderOneAtRestAreStatic) {
  const Assembler a(mass_on_spring({{.at = body("rotor"), .size = 8.0, .order = 1.0}}));
  expect_near(unbalance_response(a, {0.0}, rotor).x(0, 0), 8.0 / k);
}

// F / (k - m w^2 + i c w) with w = 2 Omega, half of it, or that of a shaker.
TEST(Excitations, OfOtherFrequenciesHaveResponsesOfTheirOwn) {
  const Structure s = mass_on_spring({{.at = body("rotor"), .size = 4.0, .frequency = 250.0},
                                      {.at = body("rotor"), .size = 2.0, .order = 2.0},
                                      {.at = body("rotor"), .size = 1.0, .order = 0.5},
                                      {.at = body("rotor"), .size = 1.0, .order = 2.0},
                                      {.at = body("rotor"), .size = 7.0}});
  const Assembler a(s);
  const std::vector<Excitation> loads = other_excitations(a);
  ASSERT_EQ(loads.size(), 3u);
  EXPECT_EQ(loads[0].label(), "0.5x");
  EXPECT_EQ(loads[1].label(), "2x");
  EXPECT_EQ(loads[2].label(), "39.7887 Hz");
  const double sizes[] = {1.0, 3.0, 4.0};
  for (std::size_t l = 0; l < 3; ++l) {
    const std::vector<double> speeds{30.0, 80.0};
    const UnbalanceResponse found = oscillating_response(a, loads[l], speeds, rotor);
    for (Eigen::Index i = 0; i < 2; ++i) {
      expect_near(found.x(0, i),
                  sizes[l] * receptance(loads[l].frequency_at(speeds[static_cast<size_t>(i)])));
      expect_near(found.y(0, i), 0.0);
    }
  }
  EXPECT_EQ(highest_frequency(s, 200.0), 400.0);
}

// The base moves as u_0 = A cos(w t), a = -w^2 A: relative to it the mass moves by
// m w^2 A / (k - m w^2 + i c w).
TEST(Excitations, AShakenBaseMovesAMassOnASpringAsInClosedForm) {
  constexpr double A = 1e-3, w = 130.0;
  const Assembler a(
      mass_on_spring({{.kind = ForceKind::base_acceleration, .size = -w * w * A, .frequency = w}}));
  const UnbalanceResponse found = oscillating_response(a, other_excitations(a).at(0), {0.0}, rotor);
  expect_near(found.x(0, 0), m * w * w * A * receptance(w));
}

// Beyond an undamped resonance all is finite; at it nothing is.
TEST(Excitations, AtAnUndampedResonanceHaveNoResponse) {
  Structure s;
  s.bodies.push_back({.name = "rotor", .m = 1.0, .spins = true});
  s.bearings.push_back(bearing(body("rotor"), isotropic(1e4, 0.0)));
  s.forces = {{.at = body("rotor"), .size = 1.0, .order = 2.0}};
  const Assembler a(s);
  const UnbalanceResponse found =
      oscillating_response(a, other_excitations(a).at(0), {50.0, 60.0}, rotor);
  EXPECT_TRUE(std::isnan(found.x(0, 0).real()));
  EXPECT_TRUE(std::isfinite(found.x(0, 1).real()));
}

// One list has all of them, those of one frequency together; unbalance grows with the speed.
TEST(Excitations, AreOneListOfExcitations) {
  constexpr double U = 3e-4, Omega = 70.0, g = 9.81;
  Structure s = mass_on_spring({{.at = body("rotor"), .size = 4.0, .frequency = 250.0},
                                {.at = body("rotor"), .size = 7.0},
                                {.at = body("rotor"), .size = 5.0, .order = 1.0},
                                {.at = body("rotor"), .size = 2.0, .order = 0.5}});
  s.gravity = g;
  s.unbalances = {{.at = body("rotor"), .moment = U}};
  const std::vector<Excitation> all = excitations_at(Assembler(s), Omega);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_TRUE(all[0].is_constant());
  expect_near(all[0].amplitude(0), 7.0);
  expect_near(all[0].amplitude(1), -m * g);
  EXPECT_TRUE(all[1].is_synchronous());
  expect_near(all[1].amplitude(0), 5.0 + U * Omega * Omega);
  expect_near(all[1].amplitude(1), Complex(0.0, -U * Omega * Omega));
  EXPECT_EQ(all[2].order, 0.5);
  EXPECT_EQ(all[3].frequency, 250.0);
  const std::vector<Excitation> none = excitations_at(Assembler(mass_on_spring({})), Omega);
  ASSERT_EQ(none.size(), 2u);
  for (const Excitation& e : none) EXPECT_TRUE(e.amplitude.isZero(0.0));
}

}  // namespace whirl::excitations_test
