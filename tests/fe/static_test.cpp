// Sag under gravity and what the bearings carry.

#include "libfe/analyses/static.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/assembly/properties.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::static_test {

using test::at;
using test::node;

constexpr double solves = 1e-9;  // relative; rounding times the condition of a small stiffness
constexpr double g = 9.81;

double sag(const StaticEquilibrium& e, int node_from_zero) {
  return e.displacement(4 * node_from_zero + Y);
}

// Jeffcott rotor: m g L^3 / (48 E I) downwards, both bearings carry half.
TEST(StaticEquilibrium, SagOfAJeffcottRotorIsTheClosedForm) {
  const test::Jeffcott jeffcott;
  Structure s = jeffcott.structure();
  s.gravity = g;
  const StaticEquilibrium e = static_equilibrium(Assembler(s), 0.0);
  const double exact = jeffcott.m * g / jeffcott.k();
  EXPECT_NEAR(sag(e, 1), -exact, solves * exact);
  EXPECT_NEAR(e.displacement(4 + X), 0.0, solves * exact);
  ASSERT_EQ(e.bearings.size(), 2u);
  for (const BearingLoad& load : e.bearings) {
    EXPECT_NEAR(load.force(1), -0.5 * jeffcott.m * g, solves * jeffcott.m * g);
    EXPECT_NEAR(load.force(0), 0.0, solves * jeffcott.m * g);
  }
}

// Uniform shaft between pins: 5 q L^4 / (384 E I) + q L^2 / (8 kappa G A), q = rho A g.
// Two-node elements are exact at nodes under a uniform load.
TEST(StaticEquilibrium, SagOfAUniformShaftIsTheClosedForm) {
  for (const int elements : {2, 6}) {
    for (const int internal : {0, 2}) {
      Segment shaft = test::cylinder(1.5, 0.1, elements);
      shaft.internal_functions = internal;
      Structure s = test::pinned(shaft);
      s.gravity = g;
      const double L = 1.5, q = shaft.material.rho * shaft.left.A() * g;
      const double kGA =
          shear_coefficient({}, shaft.left, shaft.material.nu) * shaft.material.G * shaft.left.A();
      const double exact =
          5.0 * q * L * L * L * L / (384.0 * test::EI(shaft)) + q * L * L / (8.0 * kGA);
      const StaticEquilibrium e = static_equilibrium(Assembler(s), 0.0);
      EXPECT_NEAR(sag(e, elements / 2), -exact, solves * exact);
    }
  }
}

// A disk overhung by a beyond a span L, massless shaft: the near bearing carries W (L + a) / L, the
// far one is pulled up with W a / L; the disk sags by W a^2 (L + a) / (3 E I).
TEST(StaticEquilibrium, OverhungDiskLoadsItsBearingsByTheLever) {
  const double L = 1.0, a = 0.4, m = 20.0, W = m * g;
  Segment shaft = test::massless_cylinder(L + a, 0.05, 0);
  Structure s{.shaft = {shaft}, .bearings = {test::rigid(at(0.0)), test::rigid(at(L))}};
  s.bearings[0].name = "far";
  s.bearings[1].name = "near";
  s.disks.push_back({.at = at(L + a), .m = m, .Id = 0.2, .Ip = 0.4});
  s.gravity = g;
  const StaticEquilibrium e = static_equilibrium(Assembler(s), 0.0);
  EXPECT_EQ(e.bearings[0].name, "far");
  EXPECT_NEAR(e.bearings[0].force(1), +W * a / L, solves * W);
  EXPECT_EQ(e.bearings[1].name, "near");
  EXPECT_NEAR(e.bearings[1].force(1), -W * (L + a) / L, solves * W);
  const double exact = W * a * a * (L + a) / (3.0 * test::EI(shaft));
  EXPECT_NEAR(sag(e, 2), -exact, solves * exact);
}

// Uniform shaft on three supports, two equal spans l: 3 / 8, 10 / 8, 3 / 8 of q l.
TEST(StaticEquilibrium, ThreeSupportsShareTheWeightAsInClosedForm) {
  const double l = 1.0;
  Segment shaft = test::cylinder(2.0 * l, 0.02, 8, Theory::euler_bernoulli);
  Structure s = test::pinned(shaft);
  s.bearings.push_back(test::rigid(at(l)));
  s.gravity = g;
  const double ql = shaft.material.rho * shaft.left.A() * g * l;
  const StaticEquilibrium e = static_equilibrium(Assembler(s), 0.0);
  EXPECT_NEAR(e.bearings[0].force(1), -3.0 / 8.0 * ql, solves * ql);
  EXPECT_NEAR(e.bearings[1].force(1), -3.0 / 8.0 * ql, solves * ql);
  EXPECT_NEAR(e.bearings[2].force(1), -10.0 / 8.0 * ql, solves * ql);
}

// Loads add up to the weight, whatever holds the rotor: springs, cross-coupled oil films, pins,
// clamps, and a pedestal (whose own weight does not rest on the bearing above it).
TEST(StaticEquilibrium, LoadsOfAllKindsOfBearingsAddUpToTheWeight) {
  BearingCoefficients oil;
  oil.K << 5e6, 8e6, -6e6, 9e6;
  Structure s = test::two_disk({});
  s.gravity = g;
  s.bodies = {{.name = "pedestal", .m = 30.0}};
  const std::vector<std::vector<Connection>> kinds = {
      {test::bearing(at(0.0), test::isotropic(1e6)), test::bearing(at(1.5), oil)},
      {test::rigid(at(0.0)), test::bearing(at(1.5), oil)},
      {test::clamped(at(0.0)), test::rigid(at(1.0)), test::bearing(at(1.5), oil)},
      {test::rigid(at(0.0)), test::rigid(at(1.5), test::body("pedestal"))},
      {test::rigid(at(0.0)), test::connect(at(1.5), test::body("pedestal"), oil)}};
  for (const auto& bearings : kinds) {
    s.bearings = bearings;
    s.links = {test::connect(test::body("pedestal"), test::ground(), test::isotropic(2e6))};
    const Assembler assembler(s);
    const StaticEquilibrium e = static_equilibrium(assembler, 0.0);
    Vec2 sum = Vec2::Zero();
    for (const BearingLoad& load : e.bearings) sum += load.force;
    const double weight = rotor_properties(s, assembler.mesh()).mass * g;
    EXPECT_NEAR(sum(0), 0.0, solves * weight) << bearings.size();
    EXPECT_NEAR(sum(1), -weight, solves * weight) << bearings.size();
    // the pedestal's spring carries the pedestal and what rests on it
    const Point pedestal = assembler.point(test::body("pedestal"));
    const double y = e.displacement(assembler.at(0.0).dofs.full_index(pedestal, Y));
    const bool carries = bearings.back().to.kind == Station::Kind::body;
    const double on_it = carries ? e.bearings.back().force(1) : 0.0;
    EXPECT_NEAR(2e6 * y, on_it - 30.0 * g, solves * weight);
  }
}

// Damping inside the shaft bends the sagging rotor sideways: k (1 - i eta Omega) z = -i m g.
TEST(StaticEquilibrium, InternalDampingMovesTheSagSideways) {
  const test::Jeffcott jeffcott;
  const double eta = 1e-4, Omega = 2000.0;
  Structure s = jeffcott.structure();
  s.shaft[0].material.eta = eta;
  s.gravity = g;
  const Complex z = Complex(0.0, -jeffcott.m * g / jeffcott.k()) / Complex(1.0, -eta * Omega);
  const StaticEquilibrium e = static_equilibrium(Assembler(s), Omega);
  EXPECT_NEAR(e.displacement(4 + X), z.real(), solves * std::abs(z));
  EXPECT_NEAR(e.displacement(4 + Y), z.imag(), solves * std::abs(z));
  EXPECT_GT(e.displacement(4 + X), 0.0);  // forward whirl is what it drives: down, then to +x
  // what is inside the shaft bends it and holds nothing up: the bearings share the weight
  for (const BearingLoad& load : e.bearings) {
    EXPECT_NEAR(load.force(X), 0.0, solves * jeffcott.m * g);
    EXPECT_NEAR(load.force(Y), -0.5 * jeffcott.m * g, solves * jeffcott.m * g);
  }
}

// A table gives the stiffness of the speed: y = -m g / k(Omega).
TEST(StaticEquilibrium, TakesTheBearingsOfTheSpeed) {
  const TableBearing table{
      {.speed = {0.0, 100.0}, .rows = {test::isotropic(1e4), test::isotropic(3e4)}}};
  const Structure s{.bodies = {{.name = "block", .m = 2.0}},
                    .bearings = {test::bearing(test::body("block"), AnyBearing(table))},
                    .gravity = g};
  for (const double Omega : {0.0, 50.0, 100.0}) {
    const StaticEquilibrium e = static_equilibrium(Assembler(s), Omega);
    const double k = 1e4 + 200.0 * Omega;
    EXPECT_NEAR(e.displacement(1), -2.0 * g / k, solves * 1e-3);
    EXPECT_NEAR(e.bearings[0].force(1), -2.0 * g, solves * 20.0);
  }
}

// Of coefficients over the frequency of whirl, a sag takes those at zero.
TEST(StaticEquilibrium, TakesTheBearingsOfNoWhirl) {
  const TableBearing table{
      {.rows = {test::isotropic(1e4), test::isotropic(3e4)}, .whirl = {0.0, 100.0}}};
  const Structure s{.bodies = {{.name = "block", .m = 2.0}},
                    .bearings = {test::bearing(test::body("block"), AnyBearing(table))},
                    .gravity = g};
  const StaticEquilibrium e = static_equilibrium(Assembler(s), 50.0);
  EXPECT_NEAR(e.displacement(1), -2.0 * g / 1e4, solves * 1e-3);
}

TEST(StaticEquilibrium, NeedsSupportsInBothDirections) {
  for (const auto& bearing :
       {test::isotropic(0.0), test::orthotropic(1e6, 0.0), test::orthotropic(0.0, 1e6)}) {
    Structure s = test::two_disk(bearing);
    s.gravity = g;
    try {
      static_equilibrium(Assembler(s), 0.0);
      FAIL() << "no error";
    } catch (const ModelError& error) {
      EXPECT_NE(std::string(error.what()).find("the static sag needs supports"), std::string::npos);
    }
  }
}

}  // namespace whirl::static_test
