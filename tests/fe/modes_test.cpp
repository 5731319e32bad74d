// Complex modes: whirl, damping, and what does not oscillate.

#include "libfe/analyses/modes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/eigen/symmetric.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::modes_test {

using test::at;
using test::pi;

constexpr Complex I(0.0, 1.0);
constexpr double rounding = 1e-10;  // relative; eigenvalues of a few dofs

/// A mass on a bearing of its own.
Structure block(double m, const BearingCoefficients& c) {
  return {.bodies = {{.name = "block", .m = m}},
          .bearings = {test::bearing(test::body("block"), c)}};
}

// ---- orbits -------------------------------------------------------------------------------------

// x = a cos(w t), y = b sin(w t): circles (a + b) / 2 forward and (a - b) / 2 backward.
TEST(Orbit, EllipsesHaveTheCirclesAndAxesOfTheirClosedForm) {
  const auto ellipse = [](double a, double b) { return Orbit(a, -I * b); };
  const Orbit forward = ellipse(3.0, 1.0), backward = ellipse(1.0, -3.0);
  EXPECT_DOUBLE_EQ(forward.forward, 2.0);
  EXPECT_DOUBLE_EQ(forward.backward, 1.0);
  EXPECT_DOUBLE_EQ(forward.major(), 3.0);
  EXPECT_DOUBLE_EQ(forward.minor(), 1.0);
  EXPECT_DOUBLE_EQ(forward.kappa(), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(backward.kappa(), -1.0 / 3.0);
  EXPECT_DOUBLE_EQ(ellipse(2.0, 2.0).kappa(), 1.0);
  EXPECT_DOUBLE_EQ(ellipse(2.0, -2.0).kappa(), -1.0);
  EXPECT_NEAR(Orbit(3.0, 4.0).kappa(), 0.0, 1e-15);  // a line
  EXPECT_DOUBLE_EQ(Orbit(3.0, 4.0).major(), 5.0);
  EXPECT_DOUBLE_EQ(Orbit().kappa(), 0.0);
}

// docs/conventions.md: points below a thousandth of the largest are not asked, orbits with an axis
// ratio below 1e-4 are lines.
TEST(WhirlOf, FollowsTheConventions) {
  const Orbit forward(1.0, -I * 0.5), backward(1.0, I * 0.5), line(1.0, 0.3);
  const Orbit tiny(1e-4, I * 1e-4), small(1e-2, I * 1e-2), nearly_line(1.0, -I * 1e-5);
  EXPECT_EQ(whirl_of({forward, forward}), Whirl::forward);
  EXPECT_EQ(whirl_of({backward}), Whirl::backward);
  EXPECT_EQ(whirl_of({forward, backward}), Whirl::mixed);
  EXPECT_EQ(whirl_of({line, line}), Whirl::planar);
  EXPECT_EQ(whirl_of({line, forward}), Whirl::forward);
  EXPECT_EQ(whirl_of({forward, tiny}), Whirl::forward);
  EXPECT_EQ(whirl_of({forward, small}), Whirl::mixed);
  EXPECT_EQ(whirl_of({nearly_line}), Whirl::planar);
}

// A mass on springs kx, ky with a skew coupling g between x' and y' (Foucault's pendulum):
//   (kx - m w^2) (ky - m w^2) = (g w)^2,   Y = i (kx - m w^2) / (g w) X = i r X
// kappa = -r for |r| < 1, -1 / r otherwise.
TEST(Modes, EllipsesOfACoupledMassHaveTheirClosedForm) {
  const double m = 2.0, kx = 900.0, ky = 1600.0, g = 10.0;
  System s = assemble(block(m, test::orthotropic(kx, ky)), 0.0);
  s.Omega = 1.0;
  s.spin_parts[0].G.coeffRef(0, 1) = +g;
  s.spin_parts[0].G.coeffRef(1, 0) = -g;
  const Modes modes = complex_modes(s, 2);
  ASSERT_EQ(modes.oscillatory.size(), 2u);
  const double sum = m * (kx + ky) + g * g, root = std::sqrt(sum * sum - 4 * m * m * kx * ky);
  for (const int i : {0, 1}) {
    const double w = std::sqrt((sum + (i == 0 ? -root : root)) / (2 * m * m));
    const Mode& mode = modes.oscillatory[static_cast<std::size_t>(i)];
    EXPECT_NEAR(mode.frequency(), w, rounding * w);
    const double r = (kx - m * w * w) / (g * w);
    const double kappa = std::abs(r) < 1.0 ? -r : -1.0 / r;
    EXPECT_NEAR(mode.kappa, kappa, rounding);
    EXPECT_EQ(mode.kappas, std::vector<double>{mode.kappa});
    EXPECT_EQ(mode.whirl, kappa > 0.0 ? Whirl::forward : Whirl::backward);
    // largest lateral radius one, reached at t = 0
    const Vec2 at_zero = mode.shape.real();
    EXPECT_NEAR(at_zero.norm(), 1.0, rounding);
    EXPECT_NEAR(at_zero.dot(Vec2(mode.shape.imag())), 0.0, rounding);
  }
}

// Bearing force -[k q; -q k] (x, y): lambda^2 = -(k -+ i q) / m, forward unstable, circles.
TEST(Modes, CrossCouplingDrivesForwardWhirl) {
  const double m = 3.0, k = 2700.0, q = 60.0;
  BearingCoefficients c = test::isotropic(k);
  c.K(0, 1) = +q;
  c.K(1, 0) = -q;
  const Modes modes = complex_modes(assemble(block(m, c), 0.0), 2);
  ASSERT_EQ(modes.oscillatory.size(), 2u);
  const Complex forward = std::sqrt(-Complex(k, -q) / m);  // Re > 0
  for (const Mode& mode : modes.oscillatory) {
    const bool is_forward = mode.whirl == Whirl::forward;
    const Complex exact = is_forward ? forward : Complex(-forward.real(), forward.imag());
    EXPECT_LT(std::abs(mode.lambda - exact), rounding * std::abs(exact));
    EXPECT_NEAR(mode.kappa, is_forward ? 1.0 : -1.0, rounding);
    EXPECT_EQ(mode.log_decrement() < 0.0, is_forward);
  }
}

// ---- damping ------------------------------------------------------------------------------------

// zeta = c / (2 sqrt(k m)), log decrement = 2 pi zeta / sqrt(1 - zeta^2) = ln of the ratio of
// amplitudes one period apart.
TEST(Modes, DampingOfOneMassIsTheClosedForm) {
  const double m = 3.0, k = 2700.0, w = 30.0;
  for (const double zeta : {-0.1, 1e-5, 0.02, 0.4, 0.6, 0.9}) {
    const Modes modes =
        complex_modes(assemble(block(m, test::isotropic(k, 2.0 * zeta * m * w)), 0.0), 2);
    ASSERT_EQ(modes.oscillatory.size(), 2u);
    for (const Mode& mode : modes.oscillatory) {
      EXPECT_NEAR(mode.damping_ratio(), zeta, rounding);
      EXPECT_EQ(mode.is_heavily_damped(), zeta > 0.5);
      const double period = 2.0 * pi / mode.frequency();
      EXPECT_NEAR(mode.log_decrement(), -mode.lambda.real() * period, 1e-9);
      EXPECT_NEAR(mode.frequency(), w * std::sqrt(1.0 - zeta * zeta), rounding * w);
    }
  }
}

// docs/conventions.md: overdamped is |Im| < 0.2 |Re|, a damping ratio above 1 / sqrt(1.04) =
// 0.9806.
TEST(Modes, OverdampedMotionsAreListedApartNearestToZeroFirst) {
  const double m = 3.0, k = 2700.0, w = 30.0;
  const auto modes_of = [&](double along_x, double along_y) {
    const double c = 2.0 * m * w;
    return complex_modes(assemble(block(m, test::orthotropic(k, k, along_x * c, along_y * c)), 0.0),
                         4);
  };
  const Modes hardly = modes_of(0.97, 0.99);  // one on either side of the limit
  ASSERT_EQ(hardly.oscillatory.size(), 1u);
  EXPECT_NEAR(hardly.oscillatory[0].damping_ratio(), 0.97, rounding);
  ASSERT_EQ(hardly.overdamped.size(), 1u);
  EXPECT_LT(std::abs(hardly.overdamped[0] - w * Complex(-0.99, std::sqrt(1.0 - 0.99 * 0.99))),
            rounding * w);

  const Modes real = modes_of(2.0, 0.1);  // lambda = -w (2 -+ sqrt(3))
  ASSERT_EQ(real.overdamped.size(), 2u);
  EXPECT_LT(std::abs(real.overdamped[0] + w * (2.0 - std::sqrt(3.0))), rounding * w);
  EXPECT_LT(std::abs(real.overdamped[1] + w * (2.0 + std::sqrt(3.0))), rounding * w);
  EXPECT_EQ(real.oscillatory.size(), 1u);
  EXPECT_TRUE(real.rigid_body.empty());
}

// Damping inside the shaft c_i = eta k and outside c_e: unstable from
//   Omega = omega_0 (1 + c_e / c_i)
// in forward whirl with omega_0. [Friswell2010], ch. 7; [ZorziNelson1977]
TEST(Modes, InternalDampingDrivesAJeffcottRotorUnstableAtItsThreshold) {
  const test::Jeffcott jeffcott;
  const double eta = 2e-5, ci = eta * jeffcott.k(), w = jeffcott.omega();
  for (const double ratio : {0.0, 0.5, 3.0}) {
    Structure s = jeffcott.structure();
    s.shaft[0].material.eta = eta;
    s.bearings.push_back(test::bearing(test::node(2), test::isotropic(0.0, ratio * ci)));
    const Assembler assembler(s);
    EXPECT_TRUE(assembler.depends_on_speed());
    const double threshold = w * (1.0 + ratio);
    const auto forward = [&](double Omega) {
      const Modes modes = complex_modes(assembler.at(Omega), 2);
      const auto mode = std::find_if(modes.oscillatory.begin(), modes.oscillatory.end(),
                                     [](const Mode& m) { return m.whirl == Whirl::forward; });
      EXPECT_NE(mode, modes.oscillatory.end());
      return mode->lambda;
    };
    EXPECT_LT(std::abs(forward(threshold) - I * w), rounding * w) << "c_e / c_i = " << ratio;
    EXPECT_LT(forward(0.99 * threshold).real(), 0.0);
    EXPECT_GT(forward(1.01 * threshold).real(), 0.0);
  }
}

// ---- order, count, planes -----------------------------------------------------------------------

TEST(Modes, AscendInFrequencyAndComeInTheNumberAskedFor) {
  std::mt19937 random(7);
  for (int draw = 0; draw < 6; ++draw) {
    const int elements = draw < 3 ? 10 : 40;  // dense, sparse
    const System s =
        assemble(test::random_rotor(random, {.elements = elements, .damping = 0.1}), 400.0);
    const Modes modes = complex_modes(s, 9);
    ASSERT_EQ(modes.oscillatory.size(), 9u);
    for (std::size_t i = 1; i < 9; ++i) {
      EXPECT_GE(modes.oscillatory[i].frequency(), modes.oscillatory[i - 1].frequency());
    }
    for (const Mode& mode : modes.oscillatory) {
      double largest = 0.0, at_zero = 0.0;  // radii: of the orbits, and at t = 0
      const CVec full = s.dofs.T * mode.shape;
      for (const Point& p : s.dofs.points()) {
        const Complex x = full(s.dofs.full_index(p, X)), y = full(s.dofs.full_index(p, Y));
        largest = std::max(largest, Orbit(x, y).major());
        at_zero = std::max(at_zero, std::hypot(x.real(), y.real()));
      }
      EXPECT_NEAR(largest, 1.0, rounding);
      EXPECT_NEAR(at_zero, 1.0, rounding);  // the largest orbit begins at its major axis
    }
    const Modes fewer = complex_modes(s, 4);
    ASSERT_EQ(fewer.oscillatory.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(fewer.oscillatory[i].frequency(), modes.oscillatory[i].frequency(),
                  1e-8 * modes.oscillatory[i].frequency());
    }
  }
}

// Four bodies with zeta = 0.99, lambda = w (-0.99 +- i sqrt(1 - 0.99^2)) along x and y, stand
// before the rotor's modes. They take no mode's place.
TEST(Modes, OverdampedOnesTakeNoPlaceOfThoseThatOscillate) {
  const double m = 5.0, zeta = 0.99;
  for (const int elements : {2, 8}) {  // per sixth: dense, sparse
    Structure s = test::two_disk(test::orthotropic(1e6, 2e6), elements);
    const Modes alone = complex_modes(assemble(s, 300.0), 5);
    for (int i = 0; i < 4; ++i) {
      const std::string name = "creeping " + std::to_string(i);
      const double w = 10.0 + i;
      s.bodies.push_back({.name = name, .m = m});
      s.bearings.push_back(
          test::bearing(test::body(name), test::isotropic(m * w * w, 2.0 * zeta * m * w)));
    }
    const Modes modes = complex_modes(assemble(s, 300.0), 5);
    ASSERT_EQ(modes.oscillatory.size(), 5u);
    for (std::size_t i = 0; i < 5; ++i) {
      const Complex exact = alone.oscillatory[i].lambda;
      EXPECT_LT(std::abs(modes.oscillatory[i].lambda - exact), 1e-8 * std::abs(exact));
    }
    ASSERT_EQ(modes.overdamped.size(), 8u);
    for (std::size_t i = 0; i < 8; ++i) {
      const double w = 10.0 + static_cast<double>(i / 2);
      const Complex exact = w * Complex(-zeta, std::sqrt(1.0 - zeta * zeta));
      EXPECT_LT(std::abs(modes.overdamped[i] - exact), 1e-8 * w);
    }
  }
}

TEST(Modes, FewerComeBackIfThereAreFewer) {
  EXPECT_EQ(complex_modes(assemble(test::Jeffcott{}.structure(), 0.0), 10).oscillatory.size(), 2u);
}

// A shaft element and a disk have eight degrees of freedom with mass; the dampers of the left
// bearing keep two motions from oscillating. The massless end of the shaft in its bearing has four
// eigenvalues at infinity, which rounding moves to some 1e10 rad/s.
TEST(Modes, AreNotThoseOfPartsWithoutMassAtInfinity) {
  Segment heavy = test::cylinder(0.13217445398790448, 0.022821769534020705, 1),
          light = test::cylinder(0.197777962606788, 0.021103455400970514, 1);
  heavy.material = {.name = "steel", .rho = 7800.0, .E = 210e9, .G = 210e9 / 2.6, .nu = 0.3};
  light.material = heavy.material;
  light.material.rho = 0.0;
  const Structure s{
      .shaft = {heavy, light},
      .disks = {{.at = test::node(1),
                 .m = 0.24078270155447765,
                 .Id = 0.00041473468485874913,
                 .Ip = 0.0006709329018913512}},
      .bearings = {test::bearing(test::node(1),
                                 test::orthotropic(948256.471963386, 338199.5764436885,
                                                   5064.26777915017, 5514.171136118596)),
                   test::bearing(test::node(3),
                                 test::orthotropic(23214723361.828716, 191141202626.68933,
                                                   30198.81064752865, 64552.059476604285))},
      .damping = {.mass = 5.243102139147648}};
  const Modes modes = complex_modes(assemble(s, 106.9106199327959), 8);
  ASSERT_EQ(modes.oscillatory.size(), 6u);
  EXPECT_NEAR(modes.oscillatory.back().frequency(), 78052.25, 0.01);  // LAPACK's QZ
}

// At rest nothing turns: every mode is planar, of equal pairs too, and the planes of a pair are
// perpendicular.
TEST(Modes, AtRestAllArePlanarEvenInEqualPairs) {
  for (const int elements : {2, 8}) {  // per sixth: dense, sparse
    for (const double c : {0.0, 500.0}) {
      const System s = assemble(test::two_disk(test::isotropic(1e6, c), elements), 0.0);
      const Modes modes = complex_modes(s, 8);
      ASSERT_EQ(modes.oscillatory.size(), 8u);
      for (std::size_t i = 0; i < 8; ++i) {
        SCOPED_TRACE("mode " + std::to_string(i + 1) + ", damping " + std::to_string(c));
        const Mode &mode = modes.oscillatory[i], &twin = modes.oscillatory[i ^ 1];
        EXPECT_EQ(mode.whirl, Whirl::planar);
        EXPECT_LT(std::abs(mode.kappa), 1e-4);
        EXPECT_NEAR(mode.frequency(), twin.frequency(), 1e-8 * mode.frequency());
        const double overlap = std::abs(mode.shape.dot(CVec(s.M * twin.shape))) /
                               std::abs(mode.shape.dot(CVec(s.M * mode.shape)));
        EXPECT_LT(overlap, 1e-4);
      }
    }
  }
}

// Two equal blocks: four equal eigenvalues, two in each plane.
TEST(Modes, AtRestAllArePlanarInLargerClustersToo) {
  Structure s = block(2.0, test::isotropic(800.0, 3.0));
  s.bodies.push_back({.name = "twin", .m = 2.0});
  s.bearings.push_back(test::bearing(test::body("twin"), test::isotropic(800.0, 3.0)));
  const Modes modes = complex_modes(assemble(s, 0.0), 4);
  ASSERT_EQ(modes.oscillatory.size(), 4u);
  for (const Mode& mode : modes.oscillatory) EXPECT_EQ(mode.whirl, Whirl::planar);
}

// ---- damping in proportion to stiffness ---------------------------------------------------------

// C = b K at rest: lambda^2 + b w^2 lambda + w^2 = 0 for every undamped frequency w. Those that
// oscillate lie on the circle |lambda + 1 / b| = 1 / b; all faster ones are real, one of each pair
// near -1 / b, hundreds in a heap. Those below 2 / (sqrt(1.04) b) oscillate, and no others.
TEST(Modes, BeforeAHeapOfOverdampedOnesHaveTheirClosedForm) {
  constexpr double two_solvers = 1e-7;  // relative; frequencies by Lanczos to 1e-10
  Structure s = test::pinned(test::cylinder(1.2, 0.05, 100));
  const System undamped = assemble(s, 0.0);
  const Vec w2 = lowest_real_modes(undamped.K, undamped.M, 24).omega2;
  for (const double b : {3e-4, 1e-3}) {
    s.damping.stiffness = b;
    const double limit = 2.0 / (std::sqrt(1.04) * b);
    const auto count = (w2.array() < limit * limit).count();
    ASSERT_LT(count, w2.size());
    const Modes modes = complex_modes(assemble(s, 0.0), static_cast<int>(count) + 4);
    ASSERT_EQ(static_cast<Eigen::Index>(modes.oscillatory.size()), count) << b;
    std::vector<Complex> exact;
    for (const double square : w2.head(count)) {
      const double half = 0.5 * b * square;
      exact.emplace_back(-half, std::sqrt(square - half * half));
    }
    std::sort(exact.begin(), exact.end(), [](Complex p, Complex q) { return p.imag() < q.imag(); });
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const Complex lambda = modes.oscillatory[i].lambda;
      EXPECT_LT(std::abs(lambda - exact[i]), two_solvers * std::abs(exact[i])) << exact[i];
    }
  }
}

// ---- free rotors --------------------------------------------------------------------------------

// A free rigid rotor that spins precesses with Omega Ip / Id; a short cylinder, d = 2 L:
//   Ip / Id = (1/8) / (1/16 + 1/48) = 1.5
TEST(Modes, PrecessionOfAFreeSpinningRotorIsARigidBodyMode) {
  constexpr double flexibility = 1e-3;  // (Omega / first flexible frequency)^2, a few 1e-4
  const double Omega = 1000.0;
  const System s = assemble({.shaft = {test::cylinder(0.05, 0.1, 4)}}, Omega);
  const Modes modes = complex_modes(s, 4);
  const auto precession =
      std::count_if(modes.rigid_body.begin(), modes.rigid_body.end(), [&](const Mode& mode) {
        return std::abs(mode.lambda - 1.5 * Omega * I) < flexibility * Omega;
      });
  EXPECT_EQ(precession, 1);
  ASSERT_FALSE(modes.rigid_body.empty());
  EXPECT_EQ(modes.rigid_body.back().whirl, Whirl::forward);
  ASSERT_FALSE(modes.oscillatory.empty());
  EXPECT_GT(modes.oscillatory.front().frequency(), 20.0 * Omega);  // nothing rigid among these
}

// Moving a free shaft as a whole is no damped motion: its eigenvalue is zero, and it has no damping
// ratio. Rounding made pairs of it before, with ratios of 1 and -1, heavily damped and unstable.
TEST(Modes, OfARigidBodyHaveNoDamping) {
  Structure s = test::two_disk(test::isotropic(1e7));
  s.bearings.clear();
  for (const double Omega : {0.0, 300.0}) {
    const Modes modes = complex_modes(assemble(s, Omega), 4);
    ASSERT_GE(modes.rigid_body.size(), 3u);
    for (const Mode& mode : modes.rigid_body) {
      EXPECT_FALSE(mode.is_heavily_damped()) << Omega;
      EXPECT_FALSE(std::abs(mode.damping_ratio()) > 1e-6) << Omega << ", " << mode.lambda;
    }
  }
}

// Free-free Euler-Bernoulli shaft, beta L = 4.730040744862704: the first mode that is listed.
TEST(Modes, RigidBodyMotionsOfAFreeShaftAreListedApart) {
  for (const int elements : {12, 60}) {  // dense, sparse
    const Segment shaft = test::cylinder(2.0, 0.05, elements, Theory::euler_bernoulli);
    const Modes modes = complex_modes(assemble({.shaft = {shaft}}, 0.0), 4);
    ASSERT_EQ(modes.oscillatory.size(), 4u);
    EXPECT_GE(modes.rigid_body.size(), 4u);
    const double first =
        std::pow(4.730040744862704, 2) *
        std::sqrt(test::EI(shaft) / (shaft.material.rho * shaft.left.A() * std::pow(2.0, 4)));
    EXPECT_NEAR(modes.oscillatory[0].frequency(), first, 1e-4 * first);  // h^4
    EXPECT_NEAR(modes.oscillatory[1].frequency(), first, 1e-4 * first);
    for (const Mode& rigid : modes.rigid_body) {
      EXPECT_LT(std::abs(rigid.lambda), 1e-2 * first);
    }
  }
}

// A body that nothing holds: two rigid motions, none that oscillates.
TEST(Modes, AFreeBodyAloneHasOnlyRigidBodyMotions) {
  const Modes modes = complex_modes(assemble({.bodies = {{.name = "ball", .m = 2.0}}}, 0.0), 4);
  EXPECT_TRUE(modes.oscillatory.empty());
  EXPECT_TRUE(modes.overdamped.empty());
  EXPECT_GE(modes.rigid_body.size(), 2u);
}

// A rotor held by a damper alone, on a joint without mass (a squeeze film without springs):
//   m c s^2 + m k s + k c = 0,  and s = 0
TEST(Modes, AFreeMassOnAMasslessJointWithADamperHasItsClosedForm) {
  const double m = 2.0, k = 3e5, c = 1000.0;
  const Structure s{
      .bodies = {{.name = "mass", .m = m}, {.name = "joint"}},
      .bearings = {test::bearing(test::body("joint"), test::isotropic(0.0, c))},
      .links = {test::connect(test::body("mass"), test::body("joint"), test::isotropic(k))}};
  const Modes modes = complex_modes(assemble(s, 0.0), 4);
  ASSERT_EQ(modes.oscillatory.size(), 2u);
  const double half = 0.5 * k / c;
  const Complex exact(-half, std::sqrt(k / m - half * half));
  for (const Mode& mode : modes.oscillatory) {
    EXPECT_LT(std::abs(mode.lambda - exact), rounding * std::abs(exact));
  }
  ASSERT_GE(modes.rigid_body.size(), 2u);
  for (const Mode& mode : modes.rigid_body) EXPECT_LT(std::abs(mode.lambda), rounding * half);
}

// ---- many speeds --------------------------------------------------------------------------------

// Work that is done once changes nothing: bearings constant and by a table, dense and sparse.
TEST(ModeFinder, FindsWhatIsFoundSpeedBySpeed) {
  const TableBearing table{
      {.speed = {0.0, 800.0},
       .rows = {test::isotropic(1e6, 100.0), test::orthotropic(3e6, 2e6, 900.0)}}};
  for (const int elements : {1, 8}) {
    for (const bool by_table : {false, true}) {
      Structure s = test::two_disk(test::orthotropic(1e6, 2e6, 300.0, 400.0), elements);
      if (by_table) s.bearings[1] = test::bearing(at(1.5), AnyBearing(table));
      const Assembler assembler(s);
      const ModeFinder finder(assembler);
      for (const double Omega : {0.0, 150.0, 700.0}) {
        const Modes once = finder.at(Omega, 8), alone = complex_modes(assembler.at(Omega), 8);
        ASSERT_EQ(once.oscillatory.size(), 8u);
        for (std::size_t i = 0; i < 8; ++i) {
          const Complex a = once.oscillatory[i].lambda, b = alone.oscillatory[i].lambda;
          EXPECT_LT(std::abs(a - b), 1e-8 * std::abs(b)) << Omega;
          EXPECT_EQ(once.oscillatory[i].whirl, alone.oscillatory[i].whirl) << Omega;
        }
        EXPECT_TRUE(Mat(finder.system(Omega).K).isApprox(Mat(assembler.at(Omega).K), 1e-14));
        EXPECT_EQ(finder.system(Omega).Omega, Omega);
      }
    }
  }
}

}  // namespace whirl::modes_test
