// Critical speeds of shafts with speeds of their own, in closed form.

#include "libfe/analyses/excited_modes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/assembly/assemble.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::excited_modes_test {

constexpr double Id = 0.01, Ip = 0.006, kt = 900.0;  ///< of a body that tilts
constexpr double solves = 1e-10;                     // relative, on four coordinates

/// A body that turns with a further shaft and tilts on springs; x and y are stiff. Tilts obey
///
///   Id theta'' - i Ip w theta' + kt theta = 0,   theta = theta_x + i theta_y
Structure tilting(std::vector<double> lead, std::vector<double> own, double damping = 0.0) {
  Structure s;
  s.bodies = {
      {.name = "rotor", .m = 1.0, .spins = true, .rotor = "hp", .tilts = true, .Id = Id, .Ip = Ip}};
  s.rotors = {{.name = "hp", .lead = std::move(lead), .own = std::move(own)}};
  BearingCoefficients springs = test::isotropic(1e9);
  springs.Kt.diagonal().setConstant(kt);
  springs.Ct.diagonal().setConstant(damping);
  s.bearings = {test::bearing(test::body("rotor"), springs)};
  return s;
}

/// Natural frequency of whirl where the body turns with w, forward 1, backward -1.
double natural(double w, double sense) {
  const double half = sense * 0.5 * Ip * w / Id;
  return half + std::sqrt(half * half + kt / Id);
}

// The first shaft excites at its speed: Omega is the natural frequency of the constant speed.
TEST(ExcitedModes, OfAConstantSpeedAreThoseOfTheBody) {
  for (const double own : {250.0, -250.0}) {
    const auto found = critical_speeds(Assembler(tilting({0.0}, {own})), {.count = 2});
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(found[0].speed, natural(250.0, -1.0), solves * found[0].speed);
    EXPECT_NEAR(found[1].speed, natural(250.0, 1.0), solves * found[1].speed);
    EXPECT_NEAR(found[1].damped_speed, found[1].speed, solves * found[1].speed);
  }
}

// w = a + b Omega meets its own backward and forward mode: Id w^2 -+ Ip w^2 = kt.
TEST(ExcitedModes, ATableMeetsTheModesOfItsOwnSpeed) {
  constexpr double a = 100.0, b = 0.5, last = 4000.0;
  const Assembler rotor(tilting({0.0, last}, {a, a + b * last}));
  const auto found = critical_speeds(rotor, {.count = 4, .by = "hp"});
  ASSERT_EQ(found.size(), 2u);
  for (const auto& [i, inertia] : {std::pair(0u, Id + Ip), {1u, Id - Ip}}) {
    const double expected = (std::sqrt(kt / inertia) - a) / b;
    EXPECT_NEAR(found[i].speed, expected, solves * expected);
    EXPECT_NEAR(found[i].damped_speed, expected, solves * expected);
    EXPECT_EQ(found[i].excitation(), "speed of hp");
  }
}

// All shafts excite one after the other; an order but one is of the first shaft alone.
TEST(ExcitedModes, OfAllShaftsComeShaftByShaft) {
  const Assembler rotor(tilting({0.0, 4000.0}, {100.0, 2100.0}));
  const CriticalOptions options{.count = 2, .has_damped = false};
  const auto first = critical_speeds(rotor, options), all = critical_speeds_by_all(rotor, options);
  ASSERT_EQ(all.size(), first.size() + 2);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].shaft, i < first.size() ? "shaft" : "hp");
    if (i < first.size()) {
      EXPECT_EQ(all[i].speed, first[i].speed);
    }
  }
  CriticalOptions twice = options;
  twice.order = 2.0;
  for (const Critical& c : critical_speeds_by_all(rotor, twice)) EXPECT_EQ(c.excitation(), "2x");
}

// A table that rises, falls and stays: it is critical each time its speed passes
// sqrt(kt / (Id + Ip)).
TEST(ExcitedModes, ATableMayPassAModeMoreThanOnce) {
  const double critical = std::sqrt(kt / (Id + Ip));
  const std::vector<double> lead{0.0, 100.0, 200.0, 300.0},
      own{0.0, 1.2 * critical, 0.8 * critical, 0.8 * critical};
  const auto found =
      critical_speeds(Assembler(tilting(lead, own)), {.count = 6, .has_damped = false, .by = "hp"});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].speed, 100.0 / 1.2, solves * found[0].speed);
  EXPECT_NEAR(found[1].speed, 150.0, solves * found[1].speed);
}

// Damped: |Im lambda| of Id l^2 + (c - i Ip w) l + kt = 0 is the speed.
TEST(ExcitedModes, DampedOnesMeetTheDampedFrequency) {
  constexpr double own = 250.0, c = 0.4;
  const auto found = critical_speeds(Assembler(tilting({0.0}, {own}, c)), {.count = 2});
  ASSERT_EQ(found.size(), 2u);
  const Complex half = Complex(c, -Ip * own) / (2.0 * Id);
  const Complex root = std::sqrt(half * half - kt / Id);
  const Complex first = -half + root, second = -half - root;
  const double slow = std::min(std::abs(first.imag()), std::abs(second.imag()));
  const double fast = std::max(std::abs(first.imag()), std::abs(second.imag()));
  EXPECT_NEAR(found[0].damped_speed, slow, 1e-9 * slow);
  EXPECT_NEAR(found[1].damped_speed, fast, 1e-9 * fast);
}

// The own speed along the path, the first shaft at any speed, at rest too: w of Id w^2 -+ Ip w^2 =
// kt.
TEST(ExcitedModes, APathMayBeThatOfTheOwnSpeed) {
  for (const double Omega : {0.0, 500.0}) {
    ExcitedModes modes(
        [&](double own) {
          return ExcitedRotor{tilting({0.0}, {own}), Omega, own};
        },
        4);
    const auto found = modes.places({1.0, 150.0, 300.0, 600.0});
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(found[0].s, std::sqrt(kt / (Id + Ip)), solves * found[0].s);
    EXPECT_NEAR(found[1].s, std::sqrt(kt / (Id - Ip)), solves * found[1].s);
    EXPECT_EQ(found[0].critical.speed, Omega);
  }
}

}  // namespace whirl::excited_modes_test
