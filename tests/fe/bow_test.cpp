// Shafts that are bent without any force on them.

#include "libfe/parts/bow.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "libbase/error.hpp"
#include "libfe/analyses/unbalance.hpp"
#include "libfe/assembly/excitations.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::bow_test {

using namespace test;

// Through supports and the middle the natural cubic spline is the line of a beam under a load
// there: r (3 s - 4 s^3), s = z / L up to the middle, and straight beyond the supports.
TEST(Bow, IsTheElasticLineBetweenItsPoints) {
  const double L = 0.8, r = 2e-4;
  const Bow bow{.z = {0.0, L / 2.0, L}, .x = {0.0, r, 0.0}, .y = {0.0, -2.0 * r, 0.0}};
  const std::vector<double> z{-0.1, 0.0, 0.1, 0.25, 0.4, 0.55, 0.8, 0.9};
  const auto states = bow_states(bow, z);
  ASSERT_EQ(states.size(), z.size());
  for (std::size_t i = 0; i < z.size(); ++i) {
    const double mirrored = z[i] <= L / 2.0 ? z[i] : L - z[i], s = mirrored / L;
    const double w = mirrored < 0.0 ? 3.0 * s : 3.0 * s - 4.0 * s * s * s;
    const double slope = (mirrored < 0.0 ? 3.0 : 3.0 - 12.0 * s * s) / L;
    EXPECT_NEAR(states[i].r.real(), r * w, 1e-18) << z[i];
    EXPECT_NEAR(states[i].r.imag(), -2.0 * r * w, 1e-18) << z[i];
    EXPECT_NEAR(states[i].slope.real(), (z[i] <= L / 2.0 ? r : -r) * slope, 1e-17) << z[i];
  }
}

// A spline through several points has no kink at them, and ends straight.
TEST(Bow, BendsWithoutKinksAtItsPoints) {
  constexpr double beside = 1e-7;  // [m]
  const Bow bow{.z = {0.0, 0.1, 0.35, 0.5, 0.9},
                .x = {0.0, 2e-4, -1e-4, 3e-4, 1e-4},
                .y = {1e-4, 0.0, 0.0, -2e-4, 0.0}};
  for (const double z : {0.1, 0.35, 0.5}) {
    const auto at = bow_states(bow, {z - beside, z, z + beside});
    EXPECT_LT(std::abs(at[2].slope - at[0].slope), 1e-6) << z;  // of slopes of some 1e-3
    EXPECT_LT(std::abs(at[1].slope - at[0].slope), 1e-6) << z;
  }
  const auto ends = bow_states(bow, {0.0, beside, 0.9 - beside, 0.9});
  EXPECT_LT(std::abs(ends[1].slope - ends[0].slope), 1e-12);
  EXPECT_LT(std::abs(ends[3].slope - ends[2].slope), 1e-12);
}

TEST(Bow, OfTwoPointsIsStraightAndNeedsNoForce) {
  Structure s{.shaft = {cylinder(0.8, 0.04, 8)},
              .bow = {.z = {0.1, 0.6}, .x = {1e-4, 3e-4}, .y = {0.0, 1e-4}}};
  const auto states = bow_states(s.bow, {0.0, 0.8});
  EXPECT_NEAR(states[0].r.real(), 0.6e-4, 1e-18);
  EXPECT_NEAR(states[1].r.real(), 3.8e-4, 1e-18);
  const double stiffness = 4.0 * EI(s.shaft[0]) / 1e-3;  // of an element, for scale
  EXPECT_LT(Assembler(s).bow().cwiseAbs().maxCoeff(), 1e-12 * stiffness * 3e-4);
}

/// A disk on a massless shaft on rigid bearings, damped, whose shaft is bent by r at the disk.
struct Jeffcott {
  double m = 5.0, c = 60.0, e = 3e-5, phase = 0.7, r = 1e-4, angle = -0.4;
  double k = 0.0;
  Structure structure() {
    const Segment shaft = massless_cylinder(0.8, 0.03, 8);
    k = 48.0 * EI(shaft) / (0.8 * 0.8 * 0.8);
    const Complex at_disk = std::polar(r, angle);
    return {.shaft = {shaft},
            .disks = {{.at = node(5), .m = m}},
            .bearings = {rigid(node(1)), rigid(node(9)), bearing(node(5), isotropic(0.0, c))},
            .unbalances = {{.at = node(5), .moment = m * e, .phase = phase}},
            .bow = {.z = {0.0, 0.4, 0.8},
                    .x = {0.0, at_disk.real(), 0.0},
                    .y = {0.0, at_disk.imag(), 0.0}}};
  }
};

// [Nicholas1976], eq. (4): m u'' + c u' + k u = (m e Omega^2 e^(i phase) + k r e^(i angle)) e^(i
// Omega t)
TEST(Bow, OfAJeffcottRotorRespondsAsInClosedForm) {
  Jeffcott jeffcott;
  const Structure s = jeffcott.structure();
  const auto& [m, c, e, phase, r, angle, k] = jeffcott;
  const double critical = std::sqrt(k / m);
  const Assembler assembler(s);
  UnbalanceSolver solver(assembler);
  const std::vector<Point> disk{assembler.point(node(5))};
  for (const double share : {0.0, 0.2, 0.9, 1.0, 1.1, 3.0}) {
    const double Omega = share * critical;
    const Complex load = m * e * Omega * Omega * std::polar(1.0, phase) + k * std::polar(r, angle);
    const Complex expected = load / Complex(k - m * Omega * Omega, c * Omega);
    const auto u = solver.at(Omega, disk);
    ASSERT_TRUE(u);
    const double tolerance = 1e-10 * std::abs(expected);
    EXPECT_NEAR(std::abs((*u)(0) - expected), 0.0, tolerance) << share;
    EXPECT_NEAR(std::abs((*u)(1) - Complex(0.0, -1.0) * expected), 0.0, tolerance) << share;
  }
}

// At rest nothing else acts: the shaft is where its bow has it, at every node, whatever it consists
// of.
TEST(Bow, IsTheDeflectionAtRest) {
  Structure s{
      .shaft = {cylinder(0.3, 0.03, 3), cone(0.5, 0.03, 0.05, 5)},
      .bearings = {bearing(node(1), isotropic(1e7)), bearing(node(9), isotropic(2e7))},
      .bow = {
          .z = {0.0, 0.2, 0.5, 0.8}, .x = {0.0, 1e-4, 2e-4, 0.0}, .y = {0.0, -3e-5, 1e-5, 0.0}}};
  s.shaft[1].axial_force = 0.0;
  s.layers = {{.from = node(3),
               .to = node(6),
               .material = steel(),
               .left = {0.06, 0.03},
               .right = {0.06, 0.05}}};
  const Assembler assembler(s);
  const auto full = UnbalanceSolver(assembler).at(0.0);
  ASSERT_TRUE(full);
  const auto states = bow_states(s.bow, assembler.mesh().z);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto x = static_cast<Eigen::Index>(4 * i);
    EXPECT_NEAR(std::abs((*full)(x)-states[i].r), 0.0, 1e-14) << i;
    EXPECT_NEAR(std::abs((*full)(x + 3) - states[i].slope), 0.0, 1e-13) << i;
    EXPECT_NEAR(std::abs((*full)(x + 2) - Complex(0.0, 1.0) * states[i].slope), 0.0, 1e-13) << i;
  }
}

Station outer(double z) {
  return {.kind = Station::Kind::position, .z = z, .rotor = "outer"};
}

/// A straight shaft and, from z = 0.2 m and without any link to it, a tube that is bent.
struct BentTube {
  double ratio = 1.5;
  Bow bow{.z = {0.2, 0.35, 0.6}, .x = {0.0, 8e-5, 0.0}, .y = {0.0, 5e-5, -2e-5}};

  static Segment tube() {
    Segment all = cylinder(0.4, 0.08, 4);
    all.left.inner = all.right.inner = 0.06;
    return all;
  }
  Structure both() const {
    Structure s{.shaft = {cylinder(0.8, 0.03, 8)},
                .disks = {{.at = outer(0.4), .m = 6.0, .Id = 0.02, .Ip = 0.04}},
                .bearings = {bearing(at(0.0), isotropic(4e6, 800.0)),
                             bearing(at(0.8), isotropic(5e6, 600.0)),
                             bearing(outer(0.2), isotropic(6e6, 500.0)),
                             bearing(outer(0.6), isotropic(7e6, 400.0))}};
    s.rotors = {{.name = "outer", .ratio = ratio, .z = 0.2, .shaft = {tube()}, .bow = bow}};
    return s;
  }
  /// The tube, from z = 0.
  Structure alone() const {
    Bow moved = bow;
    for (double& z : moved.z) z -= 0.2;
    return {.shaft = {tube()},
            .disks = {{.at = at(0.2), .m = 6.0, .Id = 0.02, .Ip = 0.04}},
            .bearings = {bearing(at(0.0), isotropic(6e6, 500.0)),
                         bearing(at(0.4), isotropic(7e6, 400.0))},
            .bow = moved};
  }
};

/// The full vector under the only load of another frequency, at a speed.
CVec forced(const Assembler& assembler, double Omega) {
  const std::vector<Excitation> loads = other_excitations(assembler);
  if (loads.size() != 1) throw NumericalError("expected one load");
  CVec found;
  for_each_oscillation(assembler, loads[0], {Omega},
                       [&](Eigen::Index, double, const CVec& full) { found = full; });
  return found;
}

constexpr int nodes_before = 9, nodes_of_tube = 5;

// A further shaft is bent as if it were alone at its own speed, and bends no other one.
TEST(Bow, OfAFurtherShaftIsOneOfItsOwnSpeed) {
  constexpr double Omega = 420.0;
  BentTube tube;
  for (const bool has_own_speed : {false, true}) {
    Structure s = tube.both();
    if (has_own_speed) s.rotors[0].lead = {0.0}, s.rotors[0].own = {1.5 * Omega};
    const Assembler assembler(s), of_tube(tube.alone());
    EXPECT_EQ(other_excitations(assembler).at(0).names, "bow of outer");
    EXPECT_TRUE(has_oscillating_force(s));
    EXPECT_DOUBLE_EQ(highest_frequency(s, Omega), 1.5 * Omega);
    const auto expected = UnbalanceSolver(of_tube).at(1.5 * Omega);
    ASSERT_TRUE(expected);
    const CVec full = forced(assembler, Omega);
    const CVec own = full.segment(4 * nodes_before, 4 * nodes_of_tube);
    EXPECT_LT((own - *expected).norm(), 1e-12 * expected->norm());
    EXPECT_EQ(full.head(4 * nodes_before).norm(), 0.0);
    EXPECT_FALSE(acts_at(synchronous_excitations(assembler), 0.0));
  }
}

// Of the speed of the first shaft it loads as that one's own bow does.
TEST(Bow, OfAFurtherShaftOfTheSameSpeedIsSynchronous) {
  BentTube tube{1.0};
  const Structure s = tube.both();
  EXPECT_FALSE(has_oscillating_force(s));
  EXPECT_TRUE(has_synchronous_load(s));
  const auto full = UnbalanceSolver(Assembler(s)).at(300.0);
  const auto expected = UnbalanceSolver(Assembler(tube.alone())).at(300.0);
  ASSERT_TRUE(full && expected);
  const CVec own = full->segment(4 * nodes_before, 4 * nodes_of_tube);
  EXPECT_LT((own - *expected).norm(), 1e-12 * expected->norm());
}

// Against the first shaft the load whirls that way: y is ahead of x, all mirrored at the plane of
// x.
TEST(Bow, OfAShaftThatTurnsTheOtherWayWhirlsThatWay) {
  constexpr double Omega = 420.0;
  for (const double ratio : {-1.5, -1.0}) {
    BentTube tube{ratio};
    const Assembler assembler(tube.both());
    for (double& y : tube.bow.y) y = -y;  // mirrored
    const auto expected = UnbalanceSolver(Assembler(tube.alone())).at(-ratio * Omega);
    const CVec full =
        ratio == -1.0 ? *UnbalanceSolver(assembler).at(Omega) : forced(assembler, Omega);
    ASSERT_TRUE(expected);
    const double rounding = 1e-12 * expected->norm();
    for (int i = 0; i < nodes_of_tube; ++i) {
      const Eigen::Index x = 4 * (nodes_before + i), y = x + 1;
      EXPECT_NEAR(std::abs(full(x) - (*expected)(4 * i)), 0.0, rounding) << i;
      EXPECT_NEAR(std::abs(full(y) - Complex(0.0, 1.0) * full(x)), 0.0, rounding) << i;
    }
  }
}

// A shaft that stands is bent for good.
TEST(Bow, OfAShaftThatStandsIsConstant) {
  const BentTube tube{0.0};
  const Structure s = tube.both();
  const Assembler assembler(s);
  EXPECT_TRUE(has_constant_force(s));
  EXPECT_TRUE(other_excitations(assembler).empty());
  const Vec load = static_load(assembler, 300.0);
  const Vec expected = Assembler(tube.alone()).bow().real();
  EXPECT_LT((load.segment(4 * nodes_before, 4 * nodes_of_tube) - expected).norm(),
            1e-12 * expected.norm());
  EXPECT_GT(expected.norm(), 1.0);
}

// The bow of the first shaft is not that of those around it.
TEST(Bow, OfTheFirstShaftBendsNoOther) {
  Structure s = BentTube{1.0}.both();
  s.straighten();
  EXPECT_FALSE(s.is_bent());
  s.bow = {.z = {0.0, 0.4, 0.8}, .x = {0.0, 1e-4, 0.0}, .y = {0.0, 0.0, 0.0}};
  EXPECT_TRUE(s.is_bent());
  const CVec load = Assembler(s).bow();
  EXPECT_GT(load.head(4 * nodes_before).norm(), 1.0);
  EXPECT_EQ(load.tail(4 * nodes_of_tube).norm(), 0.0);
}

}  // namespace whirl::bow_test
