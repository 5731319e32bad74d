// Shafts under axial force and torque: the loads at which they buckle, and strings.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>

#include "libbase/numerics/dense.hpp"
#include "libfe/analyses/modes.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::buckling_test {

using test::pi;

constexpr double discretization = 1e-8;  // eight elements, three pairs of internal functions
constexpr double length = 1.2, diameter = 0.03;

Segment shaft(Theory theory = Theory::euler_bernoulli) {
  Segment s = test::cylinder(length, diameter, 8, theory);
  s.internal_functions = 3;
  return s;
}

Structure clamped_at_both_ends(const Segment& s) {
  return {.shaft = {s},
          .bearings = {test::clamped(test::at(0.0)), test::clamped(test::at(length))}};
}

struct Buckling {
  double factor = std::numeric_limits<double>::infinity();  ///< of the load
  Vec shape;
  System system;
};

/// Smallest positive factor of a load at which K loses its regularity: K_0 u = -factor K_load u.
Buckling buckling(const Structure& without, const Structure& with) {
  Buckling lowest;
  lowest.system = assemble(without, 0.0);
  const Mat K0 = lowest.system.K, K_load = Mat(assemble(with, 0.0).K) - K0;
  const auto modes = general_modes(DenseLu<Mat>(K0).solve(-K_load));
  if (!modes) throw NumericalError("no buckling modes");
  for (Eigen::Index i = 0; i < K0.rows(); ++i) {
    const Complex inverse = modes->values(i);
    const bool is_real = std::abs(inverse.imag()) < 1e-6 * std::abs(inverse.real());
    if (!is_real || inverse.real() <= 0.0 || 1.0 / inverse.real() > lowest.factor) continue;
    lowest.factor = 1.0 / inverse.real();
    lowest.shape = modes->vectors.col(i).real();
  }
  return lowest;
}

// ---- axial force --------------------------------------------------------------------------------

// Euler: P = pi^2 E I / L^2 between pins, pi^2 E I / (4 L^2) with one end clamped and one free.
TEST(Buckling, ColumnsBuckleAtEulersLoads) {
  const double euler = pi * pi * test::EI(shaft()) / (length * length);
  Segment pressed = shaft();
  pressed.axial_force = -euler;
  EXPECT_NEAR(buckling(test::pinned(shaft()), test::pinned(pressed)).factor, 1.0, discretization);
  EXPECT_NEAR(buckling(test::cantilever(shaft()), test::cantilever(pressed)).factor, 0.25,
              discretization);
}

// With shear: P = P_E / (1 + P_E / (kappa G A)). [Engesser1891]
TEST(Buckling, ShearLowersTheLoadAsEngesserSays) {
  constexpr double shear_discretization = 1e-7;  // larger: the order with shear is lower by two
  const Segment s = shaft(Theory::timoshenko);
  const double euler = pi * pi * test::EI(s) / (length * length);
  const double kGA = shear_coefficient({}, s.left, s.material.nu) * s.material.G * s.left.A();
  Segment pressed = s;
  pressed.axial_force = -euler;
  const double engesser = 1.0 / (1.0 + euler / kGA);
  EXPECT_LT(engesser, 1.0 - 1e-4);  // shear is seen
  EXPECT_NEAR(buckling(test::pinned(s), test::pinned(pressed)).factor, engesser,
              shear_discretization);
}

// At Euler's load the frequency is zero, at half of it omega^2 is half:
//   omega_n^2 = (k^2 / rho A) (N + E I k^2),  k = n pi / L
// which for a large tension is a string.
TEST(Buckling, TensionRaisesFrequenciesUpToThoseOfAString) {
  const double EI = test::EI(shaft()), rho_A = shaft().material.rho * shaft().left.A();
  const double euler = pi * pi * EI / (length * length);
  for (const double N : {-0.5 * euler, 0.0, 3.0 * euler, 3000.0 * euler}) {
    Segment s = shaft();
    s.axial_force = N;
    s.elements = 24;  // a string bends sharply at its ends
    const Modes modes = complex_modes(assemble(test::pinned(s), 0.0), 6);
    ASSERT_GE(modes.oscillatory.size(), 6u);
    for (int n = 1; n <= 3; ++n) {
      const double k2 = std::pow(n * pi / length, 2);
      const double exact = std::sqrt(k2 / rho_A * (N + EI * k2));
      const auto i = static_cast<std::size_t>(2 * n - 1);
      EXPECT_NEAR(modes.oscillatory[i].frequency(), exact, discretization * exact) << N;
    }
  }
  const double string = std::sqrt(3000.0 * euler / rho_A) * pi / length;
  EXPECT_NEAR(std::sqrt((3000.0 * euler + EI * pi * pi / (length * length)) / rho_A) * pi / length,
              string, 2e-4 * string);  // the last of them is one
}

// ---- torque -------------------------------------------------------------------------------------

// Greenhill: pinned ends that may tilt, torque along z, compression P:
//   T^2 / (4 (E I)^2) + P / (E I) = pi^2 / L^2
// [Greenhill1883]; [TimoshenkoGere1961], ch. 2
TEST(Buckling, PinnedShaftUnderTorqueAndThrustBucklesAtGreenhillsLoads) {
  const double EI = test::EI(shaft());
  const double euler = pi * pi * EI / (length * length);
  for (const double P : {0.0, 0.3 * euler, 0.9 * euler, -2.0 * euler}) {
    for (const double sense : {+1.0, -1.0}) {
      Segment pressed = shaft();
      pressed.axial_force = -P;
      Segment twisted = pressed;
      twisted.torque = sense * 2.0 * EI * std::sqrt((euler - P) / EI);
      EXPECT_NEAR(buckling(test::pinned(pressed), test::pinned(twisted)).factor, 1.0,
                  discretization)
          << "P / P_E = " << P / euler << ", torque " << sense;
    }
  }
}

// Both ends clamped: tan(x) = x with x = T L / (2 E I), x = 4.493409457909064.
// [TimoshenkoGere1961], ch. 2
TEST(Buckling, ClampedShaftUnderTorqueBucklesAtItsClosedForm) {
  Segment twisted = shaft();
  twisted.torque = 2.0 * 4.493409457909064 * test::EI(shaft()) / length;
  EXPECT_NEAR(buckling(clamped_at_both_ends(shaft()), clamped_at_both_ends(twisted)).factor, 1.0,
              discretization);
}

// E I z'' = i T z' with z = x + i y: a pinned shaft buckles into the helix e^(i T s / E I) - 1,
// right-handed for T > 0, that makes one turn.
TEST(Buckling, TheHelixTurnsWithTheTorque) {
  for (const double sense : {+1.0, -1.0}) {
    Segment twisted = shaft();
    twisted.torque = sense * 2.0 * pi * test::EI(shaft()) / length;
    const Buckling b = buckling(test::pinned(shaft()), test::pinned(twisted));
    const Vec full = b.system.dofs.T * b.shape;
    const Complex middle(full(4 * 4), full(4 * 4 + 1));  // node 5 of 9: e^(i pi) - 1 = -2
    for (int n = 0; n < 9; ++n) {
      const Complex z(full(4 * n), full(4 * n + 1));
      const Complex helix = std::polar(1.0, sense * 2.0 * pi * n / 8.0) - 1.0;
      EXPECT_LT(std::abs(z - middle * helix / -2.0), 1e-6 * std::abs(middle)) << "node " << n + 1;
    }
  }
}

}  // namespace whirl::buckling_test
