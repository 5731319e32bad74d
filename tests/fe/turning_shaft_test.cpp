// Rules of one shaft, asked of one of several.

#include "libfe/lateral/turning_shaft.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "libfe/analyses/modes.hpp"
#include "libfe/analyses/response_curve.hpp"
#include "libfe/assembly/properties.hpp"
#include "libfe/lateral/antinodes.hpp"
#include "libfe/lateral/rigid_supports.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::turning_shaft_test {

using namespace test;

Station outer(double z) {
  return {.kind = Station::Kind::position, .z = z, .rotor = "outer"};
}

/// A shaft of 1 m and, from 0.2 m, a further one of 0.6 m; a disk and an unbalance on the latter.
Structure two_shafts(double ratio) {
  Structure s{
      .shaft = {cylinder(1.0, 0.04, 10)},
      .disks = {{.at = outer(0.5), .m = 5.0, .Id = 0.02, .Ip = 0.03}, {.at = outer(0.8), .m = 2.0}},
      .bearings = {bearing(at(0.0), isotropic(2e7, 2e3)), bearing(at(1.0), isotropic(2e7, 2e3)),
                   bearing(outer(0.2), isotropic(3e7, 3e3)),
                   connect(at(0.7), outer(0.7), isotropic(3e7, 3e3))},
      .unbalances = {{.at = outer(0.5), .moment = 1e-4, .phase = 0.6}}};
  s.rotors = {{.name = "outer", .ratio = ratio, .z = 0.2, .shaft = {cylinder(0.6, 0.05, 6)}}};
  return s;
}

/// A shape that moves one node in a circle.
void whirl_at(int node, double radius, bool is_forward, CVec& shape) {
  shape(4 * node + X) = radius;
  shape(4 * node + Y) = Complex(0.0, is_forward ? -radius : radius);
}

// Antinodes of a shaft are those of what whirls as it turns.
TEST(TurningShaft, HasTheAntinodesOfItsOwnSense) {
  const Assembler assembler(two_shafts(-1.5));
  const Mesh& mesh = assembler.mesh();
  const DofMap dofs = assembler.uncondensed(0.0).dofs;
  ASSERT_EQ(mesh.shaft_of[14], 1);
  CVec shape = CVec::Zero(dofs.full_size);
  whirl_at(5, 1.0, true, shape);
  whirl_at(14, 0.8, false, shape);
  EXPECT_EQ(shaft_moved_most(mesh, dofs, shape), 0);
  const auto of_first = antinodes(mesh, dofs, shape);
  ASSERT_EQ(of_first.size(), 1u);
  EXPECT_EQ(of_first[0].node, 5);
  const auto against = antinodes(mesh, dofs, shape, {1, -1.5});
  ASSERT_EQ(against.size(), 1u);
  EXPECT_EQ(against[0].node, 14);
  EXPECT_DOUBLE_EQ(against[0].deflection, 1.0);
  EXPECT_TRUE(antinodes(mesh, dofs, shape, {1, 1.5}).empty());
  EXPECT_DOUBLE_EQ(forward_share(mesh, dofs, shape, 14, {1, -1.5}), 0.8);
  whirl_at(14, 1.2, false, shape);
  EXPECT_EQ(shaft_moved_most(mesh, dofs, shape), 1);
}

TEST(TurningShaft, HangsOverByItsOwnMass) {
  const Structure s = two_shafts(1.5);
  const Mesh mesh = make_mesh(s);
  const double per_length = steel().rho * std::numbers::pi / 4.0;
  EXPECT_NEAR(mass_beyond(s, mesh, 0.7, true), per_length * 0.04 * 0.04 * 0.3, 1e-12);
  EXPECT_NEAR(mass_beyond(s, mesh, 0.7, true, 1), per_length * 0.05 * 0.05 * 0.1 + 2.0, 1e-12);
}

// A disk amid a massless shaft between rigid supports, one of them on another shaft, which has its
// own rigid support there: (48 E I / (L^3 m))^(1/2) is met by its own speed.
TEST(TurningShaft, IsCriticalOnRigidSupportsByItsOwnSpeed) {
  for (const bool is_turned : {false, true}) {
    const Segment shaft = massless_cylinder(0.6, 0.03, 6);
    Structure s{.shaft = {cylinder(1.0, 0.06, 10)}, .disks = {{.at = outer(0.7), .m = 4.0}}};
    s.rotors = {{.name = "outer", .ratio = -2.0, .z = 0.4, .shaft = {shaft}}};
    s.bearings = {bearing(at(0.0), isotropic(1e6)), bearing(at(1.0), isotropic(1e6)),
                  bearing(outer(0.4), isotropic(1e6)),
                  is_turned ? connect(outer(1.0), at(1.0), isotropic(1e6))
                            : connect(at(1.0), outer(1.0), isotropic(1e6))};
    const double omega = std::sqrt(48.0 * EI(shaft) / (0.6 * 0.6 * 0.6 * 4.0));
    EXPECT_NEAR(2.0 * critical_on_rigid_supports(s, {1, -2.0}), omega, 1e-9 * omega);
  }
}

// The solver of one load, and the curve by it, are the responses at each speed.
TEST(TurningShaft, RespondsToItsUnbalanceAlongACurve) {
  for (const double ratio : {1.5, -1.5}) {
    const Assembler assembler(two_shafts(ratio));
    const Excitation load = other_excitations(assembler).at(0);
    const std::vector<Point> points{assembler.point(outer(0.5)), assembler.point(at(0.5))};
    const ResponseCurve curve = response_curve(assembler, {50.0, 900.0}, points, {.load = load});
    EXPECT_GE(curve.peaks.size(), 1u);
    const auto& [speeds, of, x, y, tilts_x, tilts_y] = curve.response;
    const UnbalanceResponse expected = oscillating_response(assembler, load, speeds, points);
    EXPECT_LE((x - expected.x).norm(), 1e-12 * expected.x.norm());
    EXPECT_LE((y - expected.y).norm(), 1e-12 * expected.y.norm());
    for (const ResponsePeak& peak : curve.peaks) {
      const auto size_at = [&](double Omega) {
        const UnbalanceResponse u = oscillating_response(assembler, load, {Omega}, points);
        return Orbit(u.x(peak.row, 0), u.y(peak.row, 0)).major();
      };
      EXPECT_NEAR(size_at(peak.speed), peak.amplitude, 1e-12 * peak.amplitude);
      for (const double beside : {1.0 - 1e-5, 1.0 + 1e-5}) {
        EXPECT_LT(size_at(beside * peak.speed), peak.amplitude);
      }
    }
  }
}

}  // namespace whirl::turning_shaft_test
