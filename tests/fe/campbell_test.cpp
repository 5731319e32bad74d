// Modes followed over speed, and where they meet an excitation line.

#include "libfe/analyses/campbell.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/analyses/critical.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::campbell_test {

using test::at;
using test::node;

constexpr double solves = 1e-9;  // relative; eigenvalues of a condensed shaft

std::vector<double> speeds_to(double last, int steps) {
  std::vector<double> speeds;
  for (int i = 0; i <= steps; ++i) speeds.push_back(last * i / steps);
  return speeds;
}

/// Disk amid a massless shaft between pins, held by springs kx, ky as well; bounce and tilt apart:
///
///   w^2 = (48 E I / L^3 + kx) / m, likewise y;   Id w^2 -+ Ip Omega w - 12 E I / L = 0
struct Decoupled {
  double m = 6.0, Id = 0.06, Ip = 0.11, L = 0.8, d = 0.03, kx = 4e4, ky = 9e4;

  Structure structure() const {
    Structure s = test::pinned(test::massless_cylinder(L, d, 2));
    s.disks.push_back({.at = node(2), .m = m, .Id = Id, .Ip = Ip});
    s.bearings.push_back(test::bearing(node(2), test::orthotropic(kx, ky)));
    return s;
  }
  double EI() const { return test::EI(test::massless_cylinder(L, d, 1)); }
  double tilt_stiffness() const { return 12.0 * EI() / L; }
  double bounce(double k) const { return std::sqrt((48.0 * EI() / (L * L * L) + k) / m); }
  double tilt(double Omega, int sense) const {
    const double mean = 0.5 * Ip * Omega / Id;
    return std::sqrt(mean * mean + tilt_stiffness() / Id) + sense * mean;
  }
  /// Speed at which backward tilt has the frequency w.
  double meets(double w) const { return (tilt_stiffness() - Id * w * w) / (Ip * w); }
};

// ---- following ----------------------------------------------------------------------------------

// Backward tilt falls through both bounce modes: every branch stays on its closed form.
TEST(Campbell, BranchesKeepTheirModeThroughCrossings) {
  const Decoupled rotor;
  const double wx = rotor.bounce(rotor.kx), wy = rotor.bounce(rotor.ky);
  const double last = 1.5 * rotor.meets(wx);
  ASSERT_GT(rotor.tilt(0.0, -1), wy);   // begins above both
  ASSERT_LT(rotor.tilt(last, -1), wx);  // ends below both
  const std::vector<double> speeds = speeds_to(last, 40);
  const Campbell c = campbell(Assembler(rotor.structure()), speeds, 4);
  ASSERT_EQ(c.branches.size(), 4u);
  EXPECT_EQ(c.branches[0].whirl, Whirl::planar);
  EXPECT_EQ(c.branches[1].whirl, Whirl::planar);
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    const double exact[] = {wx, wy, rotor.tilt(speeds[i], -1), rotor.tilt(speeds[i], +1)};
    for (std::size_t b = 0; b < 4; ++b) {
      EXPECT_NEAR(c.branches[b].frequency[i], exact[b], solves * exact[b])
          << "branch " << b << " at " << speeds[i];
    }
  }
}

// The same with few speeds: the way between them is halved until shapes agree.
TEST(Campbell, FewSpeedsFindTheSameBranches) {
  const Decoupled rotor;
  const double last = 1.5 * rotor.meets(rotor.bounce(rotor.kx));
  const Campbell c = campbell(Assembler(rotor.structure()), {0.0, 0.4 * last, last}, 4);
  const double exact[] = {rotor.bounce(rotor.kx), rotor.bounce(rotor.ky), rotor.tilt(last, -1),
                          rotor.tilt(last, +1)};
  for (std::size_t b = 0; b < 4; ++b) {
    EXPECT_NEAR(c.branches[b].frequency.back(), exact[b], solves * exact[b]) << "branch " << b;
  }
}

// Shapes that change much between two speeds: with the way halved, two speeds are as good as
// eighty.
TEST(Campbell, TwoSpeedsEndWhereEightyDo) {
  std::mt19937 random(9);
  for (int draw = 0; draw < 4; ++draw) {
    const Assembler rotor(
        test::random_rotor(random, {.elements = 5, .is_isotropic = true, .damping = 0.02}));
    const double first = 25.0, last = 2000.0;
    const Campbell few = campbell(rotor, {first, last}, 8);
    std::vector<double> speeds;
    for (int i = 1; i <= 80; ++i) speeds.push_back(first * i);
    const Campbell many = campbell(rotor, speeds, 8);
    for (std::size_t b = 0; b < 8; ++b) {
      const double exact = many.branches[b].frequency.back();
      EXPECT_NEAR(few.branches[b].frequency.back(), exact, solves * exact)
          << "draw " << draw << ", branch " << b;
    }
  }
}

// Gyroscopics raise every forward and lower every backward frequency of an isotropic undamped
// rotor: branches are monotone, and cross each other.
TEST(Campbell, ForwardBranchesOfAnIsotropicRotorRiseAndBackwardOnesFall) {
  constexpr double noise = 1e-9;  // relative; of frequencies that hardly change
  const Campbell c =
      campbell(Assembler(test::two_disk(test::isotropic(1e6), 2)), speeds_to(4000.0, 40), 8);
  ASSERT_EQ(c.branches.size(), 8u);
  int forward = 0, changes_of_order = 0;
  for (std::size_t b = 0; b < 8; ++b) {
    const CampbellBranch& branch = c.branches[b];
    ASSERT_NE(branch.whirl, Whirl::planar);
    ASSERT_NE(branch.whirl, Whirl::mixed);
    const double sense = branch.whirl == Whirl::forward ? 1.0 : -1.0;
    forward += sense > 0.0 ? 1 : 0;
    for (std::size_t i = 1; i < c.speeds.size(); ++i) {
      EXPECT_GE(sense * (branch.frequency[i] - branch.frequency[i - 1]),
                -noise * branch.frequency[i])
          << "branch " << b << " at " << c.speeds[i];
    }
    for (std::size_t a = 0; a < b; ++a) {
      changes_of_order += c.branches[a].frequency.back() > branch.frequency.back() ? 1 : 0;
    }
  }
  EXPECT_EQ(forward, 4);
  EXPECT_GT(changes_of_order, 0);
}

// (K11 - m w^2) (K22 - Id w^2 + Ip Omega w) = K12^2, w > 0 forward, w < 0 backward: the formula of
// tests/data/rotors.json, closed-overhung-gyroscopic, here of a clamped shaft.
TEST(Campbell, OverhungDiskSplitsAsInClosedForm) {
  const test::Overhung rotor;
  const Mat2 K = rotor.K();
  const std::vector<double> speeds = speeds_to(800.0, 16);
  const Campbell c = campbell(Assembler(rotor.structure()), speeds, 4);
  ASSERT_EQ(c.branches.size(), 4u);
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    const auto value = [&](double w) {
      return ((K(0, 0) - rotor.m * w * w) *
                  (K(1, 1) - rotor.Id * w * w + rotor.Ip * speeds[i] * w) -
              K(0, 1) * K(0, 1)) /
             K.determinant();
    };
    for (std::size_t b = 0; b < 4; ++b) {
      const CampbellBranch& branch = c.branches[b];
      const double sense = branch.whirl == Whirl::forward ? 1.0 : -1.0;
      const double w = sense * branch.frequency[i];
      const double slope = (value(1.0001 * w) - value(0.9999 * w)) / 0.0002;
      EXPECT_LT(std::abs(value(w) / slope), 1e-8) << "branch " << b << " at " << speeds[i];
    }
  }
  EXPECT_EQ(c.branches[0].whirl, Whirl::backward);
  EXPECT_EQ(c.branches[1].whirl, Whirl::forward);
  EXPECT_EQ(c.branches[2].whirl, Whirl::backward);
  EXPECT_EQ(c.branches[3].whirl, Whirl::forward);
}

TEST(Campbell, HasTheBranchesAskedForOrAllThereAre) {
  const Assembler rotor(test::two_disk(test::isotropic(1e6)));
  EXPECT_EQ(campbell(rotor, speeds_to(400.0, 4), 5).branches.size(), 5u);
  const Campbell all = campbell(Assembler(test::Jeffcott{}.structure()), speeds_to(400.0, 4), 9);
  ASSERT_EQ(all.branches.size(), 2u);
  EXPECT_EQ(all.branches[0].frequency.size(), 5u);
  EXPECT_EQ(all.branches[0].log_decrement.size(), 5u);
  EXPECT_TRUE(campbell(rotor, {}, 5).branches.empty());
}

// ---- crossings ----------------------------------------------------------------------------------

// Where a branch meets the line of unbalance is a damped critical speed.
TEST(Campbell, CrossingsAreTheDampedCriticalSpeeds) {
  constexpr double iteration = 1e-9;  // relative; both stop at 1e-10
  for (const double order : {1.0, 2.0}) {
    const Assembler rotor(test::two_disk(test::orthotropic(1e6, 1.5e6, 800.0, 600.0), 2));
    const Campbell c = campbell(rotor, speeds_to(700.0, 35), 6, order);
    std::vector<double> criticals;
    for (const Critical& critical : critical_speeds(rotor, {.count = 6, .order = order})) {
      if (critical.damped_speed < 700.0) criticals.push_back(critical.damped_speed);
    }
    std::sort(criticals.begin(), criticals.end());
    ASSERT_GE(criticals.size(), 4u);
    ASSERT_EQ(c.crossings.size(), criticals.size()) << "order " << order;
    for (std::size_t i = 0; i < criticals.size(); ++i) {
      EXPECT_NEAR(c.crossings[i].speed, criticals[i], iteration * criticals[i]);
    }
  }
}

// Bounce meets the line at w, backward tilt at Ip + Id: (Id + Ip) w^2 = 12 E I / L.
TEST(Campbell, CrossingsNameTheirBranch) {
  const Decoupled rotor;
  const double wx = rotor.bounce(rotor.kx), wy = rotor.bounce(rotor.ky);
  const double tilt = std::sqrt(rotor.tilt_stiffness() / (rotor.Id + rotor.Ip));
  const Campbell c = campbell(Assembler(rotor.structure()), speeds_to(2.0 * tilt, 21), 4);
  ASSERT_EQ(c.crossings.size(), 3u);  // forward tilt, Ip > Id, is never met
  for (const Crossing& crossing : c.crossings) {
    ASSERT_LE(crossing.branch, 2);
    const double exact[] = {wx, wy, tilt};
    const double speed = exact[crossing.branch];
    EXPECT_NEAR(crossing.speed, speed, solves * speed);
  }
  EXPECT_LT(c.crossings[0].speed, c.crossings[1].speed);
  EXPECT_LT(c.crossings[1].speed, c.crossings[2].speed);
}

// ---- bearings by a table ------------------------------------------------------------------------

// k = a + b Omega, c = e Omega: w = sqrt(k / m - (c / 2 m)^2), zeta = c / (2 sqrt(k m)).
TEST(Campbell, BearingsByATableAreTakenAtEverySpeed) {
  const double m = 2.0, a = 2e4, b = 60.0, e = 0.05;
  const TableBearing table{
      {.speed = {0.0, 1000.0},
       .rows = {test::isotropic(a, 0.0), test::isotropic(a + 1000.0 * b, 1000.0 * e)}}};
  const Structure s{.bodies = {{.name = "block", .m = m}},
                    .bearings = {test::bearing(test::body("block"), AnyBearing(table))}};
  const std::vector<double> speeds = speeds_to(800.0, 10);
  const Campbell c = campbell(Assembler(s), speeds, 2);
  ASSERT_EQ(c.branches.size(), 2u);
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    const double k = a + b * speeds[i], damping = e * speeds[i] / (2.0 * m);
    const double w = std::sqrt(k / m - damping * damping);
    for (const CampbellBranch& branch : c.branches) {
      EXPECT_NEAR(branch.frequency[i], w, solves * w);
      EXPECT_NEAR(branch.log_decrement[i], 2.0 * test::pi * damping / w, solves);
    }
  }
}

// Damping that grows until the block creeps: the branch ends, as NaN. zeta = e Omega / (2 sqrt(k
// m)) passes 0.9806 at 784.5 rad/s.
TEST(Campbell, ABranchThatStopsOscillatingIsNotANumberFromThere) {
  const double m = 2.0, k = 800.0, critical = 2.0 * std::sqrt(k * m);
  const TableBearing table{
      {.speed = {0.0, 1000.0},
       .rows = {test::orthotropic(k, 2.0 * k), test::orthotropic(k, 2.0 * k, 1.25 * critical)}}};
  const Structure s{.bodies = {{.name = "block", .m = m}},
                    .bearings = {test::bearing(test::body("block"), AnyBearing(table))}};
  const Campbell c = campbell(Assembler(s), {0.0, 400.0, 780.0, 790.0, 1000.0}, 2);
  ASSERT_EQ(c.branches.size(), 2u);
  for (const double w : c.branches[1].frequency) EXPECT_NEAR(w, std::sqrt(2.0 * k / m), 1e-8);
  const auto& along_x = c.branches[0].frequency;
  EXPECT_TRUE(std::isfinite(along_x[2]));
  EXPECT_TRUE(std::isnan(along_x[3]));
  EXPECT_TRUE(std::isnan(along_x[4]));
  EXPECT_TRUE(std::isnan(c.branches[0].log_decrement[4]));
}

// The same backwards: the block creeps at first, and has a branch from where it oscillates.
TEST(Campbell, AModeThatBeginsToOscillateHasABranchFromThere) {
  const double m = 2.0, k = 800.0, critical = 2.0 * std::sqrt(k * m);
  const TableBearing table{
      {.speed = {0.0, 1000.0},
       .rows = {test::orthotropic(k, 2.0 * k, 1.25 * critical), test::orthotropic(k, 2.0 * k)}}};
  const Structure s{.bodies = {{.name = "block", .m = m}},
                    .bearings = {test::bearing(test::body("block"), AnyBearing(table))}};
  const std::vector<double> speeds{100.0, 200.0, 230.0, 600.0, 1000.0};
  const Campbell c = campbell(Assembler(s), speeds, 2);
  ASSERT_EQ(c.branches.size(), 2u);
  const auto& along_x = c.branches[1].frequency;
  EXPECT_TRUE(std::isnan(along_x[0]));
  EXPECT_TRUE(std::isnan(along_x[1]));
  for (std::size_t i = 2; i < speeds.size(); ++i) {
    const double zeta = 1.25 * (1.0 - speeds[i] / 1000.0);
    EXPECT_NEAR(along_x[i], std::sqrt(k / m * (1.0 - zeta * zeta)), 1e-8);
  }
}

// ---- the rest -----------------------------------------------------------------------------------

TEST(Campbell, SpeedsMustAscendFromZeroOrAbove) {
  const Assembler rotor(test::Jeffcott{}.structure());
  EXPECT_THROW(campbell(rotor, {100.0, 50.0}, 2), OptionError);
  EXPECT_THROW(campbell(rotor, {-1.0, 50.0}, 2), OptionError);
}

// |a^H W b|^2 / (a^H W a  b^H W b): one for shapes that differ by a complex factor, zero for
// orthogonal ones.
TEST(Mac, IsOneForOneShapeAndZeroForOrthogonalOnes) {
  constexpr double rounding = 1e-14;
  Sparse W(3, 3);
  W.insert(0, 0) = 2.0;
  W.insert(1, 1) = 3.0;
  W.insert(2, 2) = 5.0;
  CVec a(3), b(3);
  a << Complex(1, 2), Complex(0, 1), Complex(-1, 0);
  b << Complex(0, 0), Complex(0, 5), Complex(3, 0);
  EXPECT_NEAR(mac(a, Complex(0.3, -2.0) * a, W), 1.0, rounding);
  // a^H W b = 3 (-i)(5 i) + 5 (-1) 3 = 0
  EXPECT_NEAR(mac(a, b, W), 0.0, rounding);
  EXPECT_EQ(mac(a, CVec::Zero(3), W), 0.0);
  // a^H W c = 2 (1 - 2 i); |.|^2 = 20; a^H W a = 2 * 5 + 3 + 5 = 18; c^H W c = 2
  const CVec c = CVec::Unit(3, 0);
  EXPECT_NEAR(mac(a, c, W), 20.0 / 36.0, rounding);
}

}  // namespace whirl::campbell_test
