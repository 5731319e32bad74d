// What a rotor weighs.

#include "libfe/assembly/properties.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/rotors.hpp"

namespace whirl::properties_test {

using test::at;
using test::pi;

constexpr double rounding = 1e-12;  // relative; quadrature is exact for cones

// Truncated cone: m = rho pi L (d1^2 + d1 d2 + d2^2) / 12, center at
// L / 4 (d1^2 + 2 d1 d2 + 3 d2^2) / (d1^2 + d1 d2 + d2^2), Ip = rho pi L (d2^5 - d1^5) / (160 (d2 -
// d1)).
TEST(RotorProperties, OfAConeAreItsClosedForms) {
  const double L = 0.5, d1 = 0.04, d2 = 0.1, rho = 7810.0;
  const Structure s{.shaft = {test::cone(L, d1, d2, 3)}};
  const RotorProperties p = rotor_properties(s, make_mesh(s));
  const double sum = d1 * d1 + d1 * d2 + d2 * d2;
  EXPECT_NEAR(p.mass, rho * pi * L * sum / 12.0, rounding * p.mass);
  EXPECT_NEAR(p.center_of_mass, 0.25 * L * (d1 * d1 + 2 * d1 * d2 + 3 * d2 * d2) / sum, rounding);
  const double Ip = rho * pi * L * (std::pow(d2, 5) - std::pow(d1, 5)) / (160.0 * (d2 - d1));
  EXPECT_NEAR(p.Ip, Ip, rounding * Ip);
}

// Two cylinders in a row, m1 and m2, with their centers at L1 / 2 and L1 + L2 / 2.
TEST(RotorProperties, OfSegmentsInARowCountEachAtItsPlace) {
  const double L1 = 0.2, L2 = 0.6, d1 = 0.1, d2 = 0.05;
  const Structure s{.shaft = {test::cylinder(L1, d1, 1), test::cylinder(L2, d2, 2)}};
  const RotorProperties p = rotor_properties(s, make_mesh(s));
  const double m1 = L1 * d1 * d1, m2 = L2 * d2 * d2;  // by one factor
  const double center = (m1 * 0.5 * L1 + m2 * (L1 + 0.5 * L2)) / (m1 + m2);
  EXPECT_NEAR(p.center_of_mass, center, rounding);
}

// Shaft of mass m0 with its center amid, a disk at z: (m0 L / 2 + m z) / (m0 + m). What spins
// counts, a stator does not; bodies have no place along the shaft.
TEST(RotorProperties, CountDisksAndBodiesThatSpin) {
  Structure s{.shaft = {test::cylinder(1.0, 0.05, 2)},
              .disks = {{.at = at(0.8), .m = 3.0, .Id = 0.1, .Ip = 0.2}},
              .bodies = {{.name = "stator", .m = 40.0, .tilts = true, .Id = 1.0, .Ip = 2.0},
                         {.name = "wheel", .m = 7.0, .spins = true, .tilts = true, .Ip = 0.3}}};
  const double shaft = 7810.0 * pi / 4.0 * 0.05 * 0.05;
  const RotorProperties p = rotor_properties(s, make_mesh(s));
  EXPECT_NEAR(p.mass, shaft + 3.0 + 7.0, rounding * p.mass);
  EXPECT_NEAR(p.center_of_mass, (0.5 * shaft + 0.8 * 3.0) / (shaft + 3.0), rounding);
  EXPECT_NEAR(p.Ip, shaft * 0.05 * 0.05 / 8.0 + 0.2 + 0.3, rounding);
}

// About its center a cylinder has m (3 r^2 + L^2) / 12, by Steiner's theorem a disk off it m a^2
// more.
TEST(RotorProperties, HaveTheTransverseInertiaOfACylinderAndADisk) {
  const double L = 1.2, d = 0.1, z = 1.0;
  Structure s{.shaft = {test::cylinder(0.5, d, 1), test::cylinder(L - 0.5, d, 2)}};
  const double m = 7810.0 * pi / 4.0 * d * d * L;
  const double own = m * (0.75 * d * d + L * L) / 12.0;
  EXPECT_NEAR(rotor_properties(s, make_mesh(s)).Id, own, rounding * own);
  s.disks = {{.at = at(z), .m = 30.0, .Id = 0.2, .Ip = 0.4}};
  const RotorProperties p = rotor_properties(s, make_mesh(s));
  const double a = p.center_of_mass - 0.5 * L, b = z - p.center_of_mass;
  EXPECT_NEAR(p.Id, own + m * a * a + 0.2 + 30.0 * b * b, rounding * p.Id);
}

// Left and right of a cut make the whole but for a disk at the cut; a cone that is cut is two
// cones.
TEST(RotorProperties, MassBeyondAPlaceIsThatOfWhatIsThere) {
  const double L = 0.5, d1 = 0.04, d2 = 0.1, cut = 0.3, rho = 7810.0;
  const Structure s{.shaft = {test::cone(L, d1, d2, 3), test::cylinder(0.2, d2, 2)},
                    .disks = {{.at = at(0.7), .m = 3.0}, {.at = at(0.5), .m = 11.0}}};
  const Mesh mesh = make_mesh(s);
  const auto frustum = [&](double length, double a, double b) {
    return rho * pi * length * (a * a + a * b + b * b) / 12.0;
  };
  const double d = d1 + (d2 - d1) * cut / L;
  EXPECT_NEAR(mass_beyond(s, mesh, cut, false), frustum(cut, d1, d), rounding);
  const double cylinder = rho * pi / 4.0 * d2 * d2 * 0.2;
  EXPECT_NEAR(mass_beyond(s, mesh, cut, true), frustum(L - cut, d, d2) + cylinder + 14.0,
              14.0 * rounding);
  EXPECT_NEAR(mass_beyond(s, mesh, 0.5, true), cylinder + 3.0, 3.0 * rounding);
  EXPECT_NEAR(mass_beyond(s, mesh, 0.5, false), frustum(L, d1, d2), rounding);
  EXPECT_NEAR(mass_beyond(s, mesh, 0.7, true), 0.0, rounding);
}

}  // namespace whirl::properties_test
