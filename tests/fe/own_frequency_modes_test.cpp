// Modes whose coefficients depend on their own frequency.

#include "libfe/analyses/own_frequency_modes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "libfe/analyses/campbell.hpp"
#include "libfe/analyses/critical.hpp"
#include "libfe/analyses/unbalance.hpp"
#include "libfe/parts/bearings/table.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::own_frequency_modes_test {

constexpr double own = 1e-12;  // relative distance of a frequency from that of its coefficients

using test::at;

/// A table of coefficients over the whirl frequency, from a function of it.
template <class Function>
AnyBearing over_whirl(double first, double last, int rows, const Function& f) {
  CoefficientTable table;
  for (int i = 0; i < rows; ++i) {
    table.whirl.push_back(first + (last - first) * i / (rows - 1));
    table.rows.push_back(f(table.whirl.back()));
  }
  return TableBearing{table};
}

/// A rotor of steel with an overhung disk on two bearings.
Structure rotor(const AnyBearing& left, const AnyBearing& right, int elements) {
  Structure s;
  s.shaft = {test::cylinder(0.2, 0.05, elements), test::cylinder(0.9, 0.06, 3 * elements),
             test::cylinder(0.3, 0.05, elements)};
  s.disks = {{.name = "overhung", .at = at(1.4), .m = 20.0, .Id = 0.2, .Ip = 0.38},
             {.name = "middle", .at = at(0.65), .m = 30.0, .Id = 0.3, .Ip = 0.5}};
  s.bearings = {test::bearing(at(0.2), left), test::bearing(at(1.1), right)};
  return s;
}

/// Cross-coupled and damped.
BearingCoefficients oil() {
  BearingCoefficients c = test::orthotropic(2e7, 3e7, 2e4, 3e4);
  c.K(0, 1) = 4e6;
  c.K(1, 0) = -5e6;
  c.C(0, 1) = c.C(1, 0) = -3e3;
  return c;
}

/// Every mode is one of the system at its own frequency.
void expect_own(const Assembler& assembler, double Omega, const Modes& modes) {
  constexpr double rounding = 1e-10;  // of the sum of the sizes of its terms
  for (const Mode& m : modes.oscillatory) {
    const System s = assembler.at(Omega, m.frequency());
    const CVec inertia = m.lambda * m.lambda * (s.M * m.shape);
    const CVec damping = m.lambda * (s.D() * m.shape), elastic = s.K * m.shape;
    EXPECT_LE((inertia + damping + elastic).norm(),
              rounding * (inertia.norm() + damping.norm() + elastic.norm()));
  }
}

void expect_same(const Modes& found, const Modes& expected, double tolerance) {
  ASSERT_EQ(found.oscillatory.size(), expected.oscillatory.size());
  for (std::size_t i = 0; i < expected.oscillatory.size(); ++i) {
    const Mode &a = found.oscillatory[i], &b = expected.oscillatory[i];
    EXPECT_LE(std::abs(a.lambda - b.lambda), tolerance * std::abs(b.lambda)) << i;
    EXPECT_EQ(a.whirl, b.whirl) << i;
  }
}

// Small systems, whose modes are found densely, and large ones.
TEST(OwnFrequencyModes, EqualRowsAreConstantCoefficients) {
  const auto equal = [](const BearingCoefficients& c) {
    return over_whirl(0.0, 3000.0, 7, [&](double) { return c; });
  };
  const BearingCoefficients film = oil(), spring = test::isotropic(5e7);
  for (const int elements : {1, 6}) {
    const Assembler table(rotor(equal(film), equal(spring), elements));
    const Assembler constant(rotor(constant_bearing(film), constant_bearing(spring), elements));
    EXPECT_TRUE(table.depends_on_whirl());
    for (const double Omega : {0.0, 400.0}) {
      SCOPED_TRACE(Omega);
      const Modes expected = complex_modes(constant, Omega, 8);
      expect_same(complex_modes(table, Omega, 8), expected, own);
      expect_same(ModeFinder(table).at(Omega, 8), expected, own);
    }
  }
}

// A mass m on k(w) = a + b w, c:  (l^2 m + l c + k) = 0,  l = -c / 2 m + i w:
//   m w^2 - b w - a + c^2 / 4 m = 0
TEST(OwnFrequencyModes, StiffnessThatIsLinearInTheFrequencyAsInClosedForm) {
  const double m = 3.0, a = 4e4, c = 50.0;
  for (const double b : {-200.0, -30.0, 0.0, 90.0, 400.0}) {
    SCOPED_TRACE(b);
    const AnyBearing table = over_whirl(0.0, 500.0, 2, [&](double w) {
      return test::orthotropic(a + b * w, 2.0 * (a + b * w), c, c);
    });
    const Assembler assembler({.bodies = {{.name = "block", .m = m}},
                               .bearings = {test::bearing(test::body("block"), table)}});
    const Modes modes = complex_modes(assembler, 0.0, 4);
    ASSERT_EQ(modes.oscillatory.size(), 2u);
    for (const int k : {1, 2}) {
      const double half = k * b / (2.0 * m);
      const double w = half + std::sqrt(half * half + k * a / m - c * c / (4.0 * m * m));
      const Complex lambda = modes.oscillatory[static_cast<std::size_t>(k - 1)].lambda;
      EXPECT_NEAR(lambda.imag(), w, own * w);
      EXPECT_NEAR(lambda.real(), -c / (2.0 * m), own * w);
    }
  }
}

// A mass of 1 kg on a bearing. Its stiffness is constant up to 52 rad/s and falls above, to 57^2
// N/m at 57 rad/s, which is the own frequency. Its damping is none up to 58 rad/s, and from 58.5
// rad/s on so large that nothing oscillates: a step too far ends there.
TEST(OwnFrequencyModes, AreFoundJustBelowWhereNothingOscillates) {
  const double w = 57.0, k = 1e4, low = k - 6.0 / 5.0 * (k - w * w);
  const AnyBearing table =
      TableBearing{{.rows = {test::isotropic(k), test::isotropic(k), test::isotropic(low),
                             test::isotropic(low, 1e4), test::isotropic(low, 1e4)},
                    .whirl = {0.0, 52.0, 58.0, 58.5, 500.0}}};
  const Assembler assembler({.bodies = {{.name = "block", .m = 1.0}},
                             .bearings = {test::bearing(test::body("block"), table)}});
  const Modes modes = complex_modes(assembler, 0.0, 2);
  ASSERT_EQ(modes.oscillatory.size(), 2u);
  for (const Mode& mode : modes.oscillatory) {
    EXPECT_NEAR(mode.lambda.imag(), w, own * w);
    EXPECT_NEAR(mode.lambda.real(), 0.0, own * w);
  }
}

// k(w) = k0 - m w^2 is an added mass m. Rows every 0.5 rad/s miss the parabola by m h^2 / 8.
TEST(OwnFrequencyModes, FallingDynamicStiffnessIsAnAddedMass) {
  constexpr double fine = 1e-6;  // relative
  const double k0 = 3e7, m = 12.0;
  BearingCoefficients massive = test::isotropic(k0);
  massive.M = m * Mat2::Identity();
  const AnyBearing dynamic =
      over_whirl(0.0, 6000.0, 12001, [&](double w) { return test::isotropic(k0 - m * w * w); });
  for (const int elements : {1, 6}) {
    const Assembler table(rotor(dynamic, dynamic, elements));
    const Assembler mass(rotor(constant_bearing(massive), constant_bearing(massive), elements));
    for (const double Omega : {0.0, 500.0}) {
      SCOPED_TRACE(Omega);
      const Modes found = complex_modes(table, Omega, 8);
      expect_same(found, complex_modes(mass, Omega, 8), fine);
      expect_own(table, Omega, found);
    }
  }
}

// What stands between rotor and ground is a body on springs, or what its forces are at a frequency:
//   k(w) = k1 - k1^2 / (k1 + k2 - m w^2)
// It has an antiresonance, through which the table goes, and the modes of the body, too.
TEST(OwnFrequencyModes, FindsTheModesOfASupportThatIsGivenByItsDynamicStiffness) {
  constexpr double fine = 1e-5;  // relative, of the table's lines between its rows
  const double k1 = 4e7, k2 = 6e7, m = 150.0;
  const AnyBearing other = constant_bearing(test::isotropic(5e7));
  Structure whole = rotor(constant_bearing(test::isotropic(k1)), other, 1);
  whole.bodies = {{.name = "pedestal", .m = m}};
  whole.bearings[0].to = test::body("pedestal");
  whole.bearings.push_back(test::bearing(test::body("pedestal"), test::isotropic(k2)));
  const AnyBearing dynamic = over_whirl(0.0, 3000.0, 12001, [&](double w) {
    return test::isotropic(k1 - k1 * k1 / (k1 + k2 - m * w * w));
  });
  const Assembler table(rotor(dynamic, other, 1));
  const Modes found = complex_modes(table, 300.0, 8);
  expect_same(found, complex_modes(Assembler(whole), 300.0, 8), fine);
  expect_own(table, 300.0, found);
}

// No mode is there twice: shapes of modes with one eigenvalue are independent.
TEST(OwnFrequencyModes, EqualPairsAtRestStayPairs) {
  const AnyBearing soft =
      over_whirl(0.0, 2000.0, 5, [](double w) { return test::isotropic(2e7 + 5e3 * w, 1e3); });
  const Assembler assembler(rotor(soft, soft, 1));
  const Modes modes = complex_modes(assembler, 0.0, 8);
  ASSERT_EQ(modes.oscillatory.size(), 8u);
  const System s = assembler.at(0.0, 0.0);
  for (std::size_t i = 0; i < 8; i += 2) {
    const Mode &a = modes.oscillatory[i], &b = modes.oscillatory[i + 1];
    EXPECT_LE(std::abs(a.lambda - b.lambda), own * std::abs(a.lambda)) << i;
    EXPECT_LE(mac(a.shape, b.shape, s.M), own) << i;  // one moves in x-z, the other in y-z
  }
}

// Campbell diagram, critical speeds and unbalance take the coefficients of the frequency, too.
TEST(OwnFrequencyModes, OtherLinearAnalysesTakeTheSameCoefficients) {
  constexpr double fine = 1e-6;  // relative, of a table with rows every 0.5 rad/s
  const double k0 = 3e7, m = 12.0;
  BearingCoefficients massive = test::orthotropic(k0, 1.3 * k0);
  const AnyBearing dynamic = over_whirl(0.0, 3000.0, 6001, [&](double w) {
    return test::orthotropic(k0 - m * w * w, 1.3 * k0 - m * w * w);
  });
  massive.M = m * Mat2::Identity();
  Structure by_table = rotor(dynamic, dynamic, 1);
  Structure by_mass = rotor(constant_bearing(massive), constant_bearing(massive), 1);
  for (Structure* s : {&by_table, &by_mass}) {
    s->unbalances = {{.at = at(1.4), .moment = 1e-4}};
  }
  const Assembler table(by_table), mass(by_mass);

  for (const double order : {1.0, 2.0}) {
    SCOPED_TRACE(order);
    const CriticalOptions options{.count = 4, .order = order};
    const auto found = critical_speeds(table, options), expected = critical_speeds(mass, options);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_NEAR(found[i].speed, expected[i].speed, fine * expected[i].speed);
      EXPECT_NEAR(found[i].damped_speed, expected[i].damped_speed, fine * expected[i].speed);
    }
  }
  const std::vector<double> speeds{0.0, 100.0, 200.0, 300.0, 400.0};
  const Campbell found = campbell(table, speeds, 6), expected = campbell(mass, speeds, 6);
  ASSERT_EQ(found.branches.size(), expected.branches.size());
  for (std::size_t b = 0; b < expected.branches.size(); ++b) {
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      const double f = expected.branches[b].frequency[i];
      EXPECT_NEAR(found.branches[b].frequency[i], f, fine * f) << b << " " << i;
    }
  }
  const std::vector<Point> points{table.point(at(1.4))};
  const auto x = unbalance_response(table, {250.0}, points).x;
  const auto y = unbalance_response(mass, {250.0}, points).x;
  EXPECT_LE((x - y).norm(), 1e2 * fine * y.norm());
}

}  // namespace whirl::own_frequency_modes_test
