// Deflection, moment and shear force along a shaft under its weight.

#include "libfe/analyses/bending.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "libfe/analyses/static.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::bending_test {

using test::at;

constexpr double solves = 1e-9;  // relative; rounding times the condition of a small stiffness
constexpr double g = 9.81;

BendingLine line_of(const Structure& s, double Omega = 0.0) {
  const Assembler assembler(s);
  return bending_line(assembler, Omega, static_equilibrium(assembler, Omega).displacement);
}

// Uniform shaft between pins, q = rho A g:
//   V = q (z - L / 2),   M = q z (L - z) / 2,
//   y = -q z (L^3 - 2 L z^2 + z^3) / (24 E I) - q z (L - z) / (2 kappa G A)
TEST(BendingLine, OfAUniformShaftBetweenPinsIsTheClosedForm) {
  for (const int elements : {1, 3}) {
    for (const int internal : {0, 2}) {
      const double L = 1.5;
      Segment shaft = test::cylinder(L, 0.1, elements);
      shaft.internal_functions = internal;
      Structure s = test::pinned(shaft);
      s.gravity = g;
      const double q = shaft.material.rho * shaft.left.A() * g, EI = test::EI(shaft);
      const double kGA =
          shear_coefficient({}, shaft.left, shaft.material.nu) * shaft.material.G * shaft.left.A();
      const BendingLine line = line_of(s);
      ASSERT_EQ(line.z.size(), 9 * elements);
      const double sag = 5.0 * q * std::pow(L, 4) / (384.0 * EI);
      for (Eigen::Index i = 0; i < line.z.size(); ++i) {
        const double z = line.z(i);
        EXPECT_NEAR(line.shear(i, 1), q * (z - L / 2.0), solves * q * L) << z;
        EXPECT_NEAR(line.moment(i, 1), q * z * (L - z) / 2.0, solves * q * L * L) << z;
        const double y = -q * z * (L * L * L - 2.0 * L * z * z + z * z * z) / (24.0 * EI) -
                         q * z * (L - z) / (2.0 * kGA);
        EXPECT_NEAR(line.deflection(i, 1), y, solves * sag) << z;
      }
      EXPECT_LE(line.moment.col(0).cwiseAbs().maxCoeff(), solves * q * L * L);
    }
  }
}

// M r / I, and 4 V / 3 A of a cylinder, 2 V / A of a thin tube.
TEST(BendingLine, StressesAreThoseOfTheSection) {
  for (const double bore : {0.0, 0.05, 0.0999}) {
    Segment shaft = test::cylinder(1.5, 0.1, 3);
    shaft.left.inner = shaft.right.inner = bore;
    Structure s = test::pinned(shaft);
    s.gravity = g;
    const BendingLine line = line_of(s);
    const Section& section = shaft.left;
    const double r = 0.5 * section.outer, q = 0.5 * section.inner;
    for (Eigen::Index i = 0; i < line.z.size(); ++i) {
      const double M = line.moment.row(i).norm(), V = line.shear.row(i).norm();
      EXPECT_NEAR(line.bending_stress(i), M * r / section.I(), 1e-9 * M * r / section.I() + 1e-6);
      const double shape = (r * r + r * q + q * q) / (r * r + q * q);
      EXPECT_NEAR(line.shear_stress(i), 4.0 * V / (3.0 * section.A()) * shape,
                  1e-9 * V / section.A() + 1e-6);
    }
    if (bore == 0.0) {
      const double q0 = shaft.material.rho * section.A() * g, largest = q0 * 1.5 * 1.5 / 8.0;
      EXPECT_NEAR(line.bending_stress.maxCoeff(), 32.0 * largest / (3.14159265358979 * 1e-3),
                  1e-2 * largest / 1e-4);
    }
  }
}

// A disk overhung by a beyond a span L of a massless shaft: M = -W a z / L up to the near bearing,
// -W (L + a - z) beyond it; V = +W a / L, then -W.
TEST(BendingLine, JumpsAtBearingsAsTheLeverSays) {
  const double L = 1.0, a = 0.4, m = 20.0, W = m * g;
  Structure s{.shaft = {test::massless_cylinder(L + a, 0.05, 0)},
              .bearings = {test::rigid(at(0.0)), test::rigid(at(L))}};
  s.disks.push_back({.at = at(L + a), .m = m, .Id = 0.2, .Ip = 0.4});
  s.gravity = g;
  const BendingLine line = line_of(s);
  ASSERT_EQ(line.z.size(), 18);  // two beams
  for (Eigen::Index i = 0; i < line.z.size(); ++i) {
    const double z = line.z(i);
    const bool is_within = i < 9;
    EXPECT_NEAR(line.moment(i, 1), is_within ? -W * a * z / L : -W * (L + a - z), solves * W);
    EXPECT_NEAR(line.shear(i, 1), is_within ? W * a / L : -W, solves * W);
  }
}

// Shear force and moment follow from equilibrium alone: a cone of length L with its thin end free,
// diameter d(z) = d0 (1 - z / l), has the weight to the right of z, g rho pi d0^2 (l / 12) ((1 - z
// / l)^3
// - (1 - L / l)^3), whatever its stiffness and however fine the mesh.
TEST(BendingLine, OfAConicalCantileverIsInEquilibriumWithItsWeight) {
  const double L = 0.8, d0 = 0.1, d1 = 0.04, l = L * d0 / (d0 - d1);
  Structure s{.shaft = {test::cone(L, d0, d1, 3)}, .bearings = {test::clamped(at(0.0))}};
  s.gravity = g;
  const double rho = s.shaft[0].material.rho;
  const auto weight = [&](double z) {
    return g * rho * test::pi * d0 * d0 * l / 12.0 *
           (std::pow(1.0 - z / l, 3) - std::pow(1.0 - L / l, 3));
  };
  const BendingLine line = line_of(s);
  for (Eigen::Index i = 0; i < line.z.size(); ++i) {
    EXPECT_NEAR(line.shear(i, 1), -weight(line.z(i)), solves * weight(0.0)) << line.z(i);
  }
  EXPECT_NEAR(line.moment(line.z.size() - 1, 1), 0.0, solves * weight(0.0) * L);
  // the moment's slope is -V, by central differences of a cubic and a bit: within a piece squared
  constexpr double differences = 2e-3;
  for (Eigen::Index i = 1; i < 8; ++i) {
    const double slope =
        (line.moment(i + 1, 1) - line.moment(i - 1, 1)) / (line.z(i + 1) - line.z(i - 1));
    EXPECT_NEAR(slope, -line.shear(i, 1), differences * weight(0.0));
  }
}

// Between nodes the line is that of the same shaft with a node there, cone and shear included.
TEST(BendingLine, DoesNotDependOnTheMesh) {
  const auto shaft = [](int elements) {
    Structure s = test::pinned(test::cone(1.2, 0.12, 0.05, elements));
    s.gravity = g;
    return line_of(s);
  };
  const BendingLine coarse = shaft(1), fine = shaft(8);
  for (Eigen::Index i = 0; i < coarse.z.size(); ++i) {
    const Eigen::Index j = i < 8 ? 9 * i : fine.z.size() - 1;
    ASSERT_NEAR(fine.z(j), coarse.z(i), 1e-12);
    EXPECT_NEAR(fine.deflection(j, 1), coarse.deflection(i, 1),
                solves * coarse.deflection.cwiseAbs().maxCoeff());
    EXPECT_NEAR(fine.moment(j, 1), coarse.moment(i, 1),
                solves * coarse.moment.cwiseAbs().maxCoeff());
  }
}

// Damping inside a spinning shaft turns the sag sideways, but bearings and weight stay: the moment
// is that of the shaft without damping.
TEST(BendingLine, CarriesTheWeightWithDampingInsideTheShaftToo) {
  Segment segment = test::cylinder(1.0, 0.05, 2);
  segment.material.eta = 1e-4;
  Structure s = test::pinned(segment);
  s.gravity = g;
  const BendingLine rest = line_of(s), spinning = line_of(s, 2000.0);
  const double largest = rest.moment.cwiseAbs().maxCoeff();
  EXPECT_LE((spinning.moment - rest.moment).cwiseAbs().maxCoeff(), solves * largest);
  EXPECT_GT(spinning.deflection.col(0).maxCoeff(),
            0.1 * rest.deflection.col(1).cwiseAbs().maxCoeff());
}

TEST(BendingLine, OfARotorWithoutAShaftIsEmpty) {
  const Structure s{.bodies = {{.name = "block", .m = 2.0}},
                    .bearings = {test::bearing(test::body("block"), test::isotropic(1e4))},
                    .gravity = g};
  EXPECT_EQ(line_of(s).z.size(), 0);
}

}  // namespace whirl::bending_test
