// Layers beside the segments of the shaft: sleeves, hubs, tubes.

#include <gtest/gtest.h>

#include <cmath>

#include "libfe/analyses/bending.hpp"
#include "libfe/analyses/modes.hpp"
#include "libfe/analyses/static.hpp"
#include "libfe/assembly/properties.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::layers_test {

using namespace test;

constexpr double rounding = 1e-12;  ///< relative to the largest entry

/// A tube of damped steel without shear, on two bearings.
Structure tube(double outer, double inner) {
  Segment s = cylinder(0.8, outer, 8, Theory::rayleigh);
  s.left.inner = s.right.inner = inner;
  s.material.eta = 2e-5;
  return {.shaft = {s},
          .disks = {{.at = node(4), .m = 3.0, .Id = 0.02, .Ip = 0.03}},
          .bearings = {bearing(node(1), isotropic(2e7, 300.0)),
                       bearing(node(9), isotropic(3e7, 500.0))},
          .gravity = 9.81};
}

/// Another tube around or in a shaft, all along it or between two nodes.
Layer layer_of(const Segment& like, double outer, double inner, int from = 1, int to = 9) {
  return {.from = node(from),
          .to = node(to),
          .material = like.material,
          .left = {outer, inner},
          .right = {outer, inner},
          .theory = like.theory};
}

void expect_same(const Sparse& a, const Sparse& b) {
  const Mat expected(b);
  EXPECT_LT((Mat(a) - expected).cwiseAbs().maxCoeff(), rounding * expected.cwiseAbs().maxCoeff());
}

// Without shear the shape functions of a cylinder are cubic whatever its diameters, and E I, rho A
// and rho I of a tube are the sums of those of its inner and outer half.
TEST(Layers, TwoHalvesOfAWallAreTheWholeTube) {
  const Structure whole = tube(0.08, 0.04);
  Structure halves = tube(0.06, 0.04);
  halves.layers = {layer_of(halves.shaft[0], 0.08, 0.06)};
  const Assembler a(halves), b(whole);
  const System layered = a.at(500.0), one = b.at(500.0);
  expect_same(layered.M, one.M);
  expect_same(layered.C, one.C);
  expect_same(layered.G(), one.G());
  expect_same(layered.K, one.K);  // rotating damping in it
  EXPECT_LT((a.gravity_load() - b.gravity_load()).norm(), rounding * b.gravity_load().norm());

  const RotorProperties p = rotor_properties(halves, a.mesh()),
                        q = rotor_properties(whole, b.mesh());
  EXPECT_NEAR(p.mass, q.mass, rounding * q.mass);
  EXPECT_NEAR(p.Ip, q.Ip, rounding * q.Ip);
  EXPECT_NEAR(p.center_of_mass, q.center_of_mass, rounding);
}

// The same where the inner half is the layer, in two pieces that lie over the borders of segments.
TEST(Layers, MayLieInsideAndAcrossSegments) {
  const Structure whole = tube(0.08, 0.04);
  Structure halves = tube(0.08, 0.06);
  const Segment s = halves.shaft[0];
  halves.shaft = {s, s};
  halves.shaft[0].length = 0.5;
  halves.shaft[0].elements = 5;
  halves.shaft[1].length = 0.3;
  halves.shaft[1].elements = 3;
  halves.layers = {layer_of(s, 0.06, 0.04), layer_of(s, 0.06, 0.04)};
  halves.layers[0].to = at(0.2);
  halves.layers[1].from = at(0.2);
  const System layered = assemble(halves, 500.0), one = assemble(whole, 500.0);
  expect_same(layered.M, one.M);
  expect_same(layered.K, one.K);
  expect_same(layered.G(), one.G());
}

// Moments and shear forces under its weight are those of statics whatever the rotor is made of;
// deflections those of the sum of both stiffnesses.
TEST(Layers, BendWithTheShaftUnderItsWeight) {
  const Structure whole = tube(0.08, 0.04);
  Structure halves = tube(0.06, 0.04);
  halves.layers = {layer_of(halves.shaft[0], 0.08, 0.06)};
  const auto line_of = [](const Structure& s) {
    const Assembler assembler(s);
    return bending_line(assembler, 0.0, static_equilibrium(assembler, 0.0).displacement);
  };
  const BendingLine a = line_of(halves), b = line_of(whole);
  constexpr double solver = 1e-10;  // of the static solution
  EXPECT_LT((a.deflection - b.deflection).norm(), solver * b.deflection.norm());
  EXPECT_LT((a.moment - b.moment).norm(), solver * b.moment.norm());
  EXPECT_LT((a.shear - b.shear).norm(), solver * b.shear.norm());
}

TEST(Layers, ThatCarryMassAndStiffnessApartAreOneThatCarriesBoth) {
  Structure both = tube(0.06, 0.04), apart = both;
  Layer sleeve = layer_of(both.shaft[0], 0.09, 0.06, 3, 5);
  sleeve.theory = Theory::timoshenko;
  sleeve.damping = {.mass = 2.0, .stiffness = 1e-5};
  both.layers = {sleeve};
  Layer mass = sleeve, stiffness = sleeve;
  mass.carries = Carries::mass;
  stiffness.carries = Carries::stiffness;
  apart.layers = {mass, stiffness};
  const System a = assemble(apart, 500.0), b = assemble(both, 500.0);
  expect_same(a.M, b.M);
  expect_same(a.C, b.C);
  expect_same(a.G(), b.G());
  expect_same(a.K, b.K);

  // and each leaves the other alone
  const Structure bare = tube(0.06, 0.04);
  Structure heavy = bare, stiff = bare;
  heavy.layers = {mass};
  stiff.layers = {stiffness};
  expect_same(assemble(heavy, 500.0).K, assemble(bare, 500.0).K);
  expect_same(assemble(stiff, 500.0).M, assemble(bare, 500.0).M);
  expect_same(assemble(stiff, 500.0).G(), assemble(bare, 500.0).G());
  const Mesh mesh = make_mesh(stiff);
  EXPECT_EQ(rotor_properties(stiff, mesh).mass, rotor_properties(bare, mesh).mass);
}

// A sleeve whose material is damped drives a rotor on undamped bearings unstable above its first
// critical speed, as a damped shaft does.
TEST(Layers, WithInternalDampingMakeARotorUnstableAboveItsCriticalSpeed) {
  Structure s = tube(0.04, 0.0);
  s.shaft[0].material.eta = 0.0;
  for (Connection& b : s.bearings) b.coefficients = constant_bearing(isotropic(1e9));
  Layer sleeve = layer_of(s.shaft[0], 0.05, 0.04, 3, 7);
  sleeve.material.eta = 1e-4;
  s.layers = {sleeve};
  const Assembler assembler(s);
  const double first = complex_modes(assembler.at(0.0), 4).oscillatory[0].frequency();
  const auto largest_growth = [&](double Omega) {
    double growth = -INFINITY;
    for (const Mode& mode : complex_modes(assembler.at(Omega), 4).oscillatory) {
      growth = std::max(growth, mode.lambda.real());
    }
    return growth;
  };
  EXPECT_LT(largest_growth(0.9 * first), 0.0);
  EXPECT_GT(largest_growth(1.1 * first), 0.0);
}

TEST(Layers, GetNodesAtTheirEndsAndAreSeen) {
  Structure s{.shaft = {cylinder(0.8, 0.04, 0)}};
  Layer sleeve = layer_of(s.shaft[0], 0.07, 0.04);
  sleeve.from = at(0.123);
  sleeve.to = at(0.456);
  sleeve.right.outer = 0.05;
  s.layers = {sleeve};
  const Mesh mesh = make_mesh(s);
  double covered = 0.0;
  for (const MeshLayer& piece : mesh.layers) {
    const MeshElement& e = mesh.elements[static_cast<std::size_t>(piece.element)];
    covered += mesh.z[static_cast<std::size_t>(e.right)] - mesh.z[static_cast<std::size_t>(e.left)];
  }
  EXPECT_NEAR(covered, 0.456 - 0.123, 1e-15);
  EXPECT_EQ(mesh.layers.front().from, 0.0);
  EXPECT_EQ(mesh.layers.back().to, 1.0);
  EXPECT_NEAR(shaft_diameter(s, mesh, 0.123), 0.07, 1e-15);
  EXPECT_NEAR(shaft_diameter(s, mesh, 0.5 * (0.123 + 0.456)), 0.06, 1e-15);
  EXPECT_NEAR(shaft_diameter(s, mesh, 0.6), 0.04, 1e-15);
}

TEST(Layers, EndToTheRightOfWhereTheyBegin) {
  const auto message_of = [](Station from, Station to) -> std::string {
    Structure s = tube(0.06, 0.04);
    s.layers = {layer_of(s.shaft[0], 0.08, 0.06)};
    s.layers[0].from = std::move(from);
    s.layers[0].to = std::move(to);
    try {
      make_mesh(s);
    } catch (const ModelError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message_of(at(0.2), at(0.6)), "");
  EXPECT_NE(message_of(at(0.6), at(0.2)).find("expected a place to the right of 600 mm"),
            std::string::npos);
  EXPECT_NE(message_of(node(3), node(3)).find("to the right of 200 mm"), std::string::npos);
  EXPECT_NE(message_of(at(0.6), at(0.9)).find("off the shaft"), std::string::npos);
  EXPECT_NE(message_of(node(1), node(12)).find("expected a node from 1 to 9"), std::string::npos);
  EXPECT_NE(message_of(ground(), at(0.2)).find("a layer lies on the shaft"), std::string::npos);
}

}  // namespace whirl::layers_test
