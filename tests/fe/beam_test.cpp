// One shaft element against closed forms.

#include "libfe/mesh/elements/beam.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libbase/numerics/dense.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::beam_test {

using test::pi;
using Block = Eigen::Matrix<double, 8, 8>;

constexpr double rounding = 1e-12;      // relative; sums over 24 points and a 2 x 2 inverse
constexpr double gram_schmidt = 1e-10;  // relative; up to eight functions that resemble each other
constexpr double taper_quadrature = 1e-9;  // relative; 24 points on a cone of up to 1:10

Beam cylinder(Theory theory = Theory::timoshenko) {
  return {.L = 0.15,
          .left = {.outer = 0.06, .inner = 0.02},
          .right = {.outer = 0.06, .inner = 0.02},
          .material = test::steel(),
          .theory = theory};
}

Beam cone(Theory theory = Theory::timoshenko) {
  Beam beam = cylinder(theory);
  beam.right = {.outer = 0.11, .inner = 0.05};
  return beam;
}

std::vector<Beam> beams_of_all_kinds() {
  std::vector<Beam> beams;
  for (const Theory theory : {Theory::timoshenko, Theory::rayleigh, Theory::euler_bernoulli}) {
    for (int internal = 0; internal <= 4; ++internal) {
      beams.push_back(cylinder(theory));
      beams.back().internal_functions = internal;
      beams.push_back(cone(theory));
      beams.back().internal_functions = internal;
    }
  }
  return beams;
}

std::string what(const Beam& b) {
  return std::string(name_of(b.theory)) + (b.left.outer == b.right.outer ? " cylinder" : " cone") +
         " with " + std::to_string(b.internal_functions) + " internal functions";
}

double largest(const Mat& A) {
  return A.cwiseAbs().maxCoeff();
}

/// 4 x 4 blocks of the planes (x, theta_y) and (y, -theta_x) at their places among the dofs.
Block in_planes(const Eigen::Matrix4d& xx, const Eigen::Matrix4d& xy) {
  const int place[2][4] = {{0, 3, 4, 7}, {1, 2, 5, 6}};
  const double sign[2][4] = {{1, 1, 1, 1}, {1, -1, 1, -1}};
  Block e = Block::Zero();
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      e(place[0][i], place[0][j]) += xx(i, j);
      e(place[1][i], place[1][j]) += sign[1][i] * sign[1][j] * xx(i, j);
      e(place[0][i], place[1][j]) += sign[1][j] * xy(i, j);
      e(place[1][i], place[0][j]) -= sign[1][i] * xy(i, j);
    }
  }
  return e;
}

/// Matrices of one plane, rows (w_1, theta_1, w_2, theta_2), from their upper triangles.
Eigen::Matrix4d plane(double factor, double ww, double wt, double ww2, double wt2, double tt,
                      double tt2) {
  Eigen::Matrix4d A;
  A << ww, wt, ww2, wt2,   //
      wt, tt, -wt2, tt2,   //
      ww2, -wt2, ww, -wt,  //
      wt2, tt2, -wt, tt;
  return factor * A;
}

/// Displacements of a rigid motion: translations, and rotations about the left end.
Vec rigid_motion(const Beam& b, double x, double y, double theta_x, double theta_y) {
  Vec q = Vec::Zero(matrices(b).M.rows());
  q.head<8>() << x, y, theta_x, theta_y, x + b.L * theta_y, y - b.L * theta_x, theta_x, theta_y;
  return q;
}

// ---- cylinders ----------------------------------------------------------------------------------

// Phi = 12 E I / (kappa G A L^2), kappa of Cowper:
//   K = E I / ((1+Phi) L^3) [12 6L -12 6L; 6L (4+Phi)L^2 -6L (2-Phi)L^2; ...]
// [Przemieniecki1968], ch. 5; [Nelson1980]
TEST(Beam, StiffnessOfACylinderIsTheClosedForm) {
  for (const Theory theory : {Theory::timoshenko, Theory::rayleigh, Theory::euler_bernoulli}) {
    const Beam b = cylinder(theory);
    const double L = b.L, EI = b.material.E * b.left.I();
    const double kappa = shear_coefficient(b.shear, b.left, b.material.nu);
    const double Phi = theory == Theory::timoshenko
                           ? 12.0 * EI / (kappa * b.material.G * b.left.A() * L * L)
                           : 0.0;
    const auto K = plane(EI / ((1.0 + Phi) * L * L * L), 12.0, 6.0 * L, -12.0, 6.0 * L,
                         (4.0 + Phi) * L * L, (2.0 - Phi) * L * L);
    const Block expected = in_planes(K, Eigen::Matrix4d::Zero());
    // rotations and displacements differ in size by L: compare in common units
    EXPECT_LT(largest(matrices(b).K - expected), rounding * largest(expected)) << what(b);
  }
}

// Consistent mass of [Nelson1980], with s = rho A L / (840 (1+Phi)^2) for translation
//   312+588Phi+280Phi^2, (44+77Phi+35Phi^2)L, 108+252Phi+140Phi^2, -(26+63Phi+35Phi^2)L, ...
// and rho I / (30 (1+Phi)^2 L) for rotation
//   36, (3-15Phi)L, -36, (3-15Phi)L, (4+5Phi+10Phi^2)L^2, (-1-5Phi+5Phi^2)L^2
// The gyroscopic matrix is twice the rotary one between the planes.
TEST(Beam, MassAndGyroscopicsOfACylinderAreTheClosedForms) {
  for (const Theory theory : {Theory::timoshenko, Theory::rayleigh, Theory::euler_bernoulli}) {
    const Beam b = cylinder(theory);
    const double L = b.L, rho = b.material.rho, A = b.left.A(), I = b.left.I();
    const double kappa = shear_coefficient(b.shear, b.left, b.material.nu);
    const double p = theory == Theory::timoshenko
                         ? 12.0 * b.material.E * I / (kappa * b.material.G * A * L * L)
                         : 0.0;
    const double p2 = p * p, one = (1.0 + p) * (1.0 + p);
    const Eigen::Matrix4d translation =
        plane(rho * A * L / (840.0 * one), 312 + 588 * p + 280 * p2, (44 + 77 * p + 35 * p2) * L,
              108 + 252 * p + 140 * p2, -(26 + 63 * p + 35 * p2) * L, (8 + 14 * p + 7 * p2) * L * L,
              -(6 + 14 * p + 7 * p2) * L * L);
    Eigen::Matrix4d rotation =
        plane(rho * I / (30.0 * one * L), 36.0, (3 - 15 * p) * L, -36.0, (3 - 15 * p) * L,
              (4 + 5 * p + 10 * p2) * L * L, (-1 - 5 * p + 5 * p2) * L * L);
    if (theory == Theory::euler_bernoulli) rotation.setZero();

    const auto e = matrices(b);
    const Block M = in_planes(translation + rotation, Eigen::Matrix4d::Zero());
    const Block G = in_planes(Eigen::Matrix4d::Zero(), 2.0 * rotation);
    EXPECT_LT(largest(e.M - M), rounding * largest(M)) << what(b);
    EXPECT_LE(largest(e.G - G), rounding * largest(G)) << what(b);
  }
}

// A short cylinder on its tilts is a disk: G(theta_x, theta_y) > 0 for rigid rotations.
//   Ip = rho 2 I L,   Id = rho I L + rho A L^3 / 3 about the left end
TEST(Beam, RigidRotationHasTheInertiaAndTheGyroscopicsOfADisk) {
  for (const Theory theory : {Theory::timoshenko, Theory::rayleigh}) {
    const Beam b = cylinder(theory);
    const double rho = b.material.rho;
    const double Ip = 2.0 * rho * b.left.I() * b.L;
    const double Id = 0.5 * Ip + rho * b.left.A() * std::pow(b.L, 3) / 3.0;
    const auto e = matrices(b);
    const Vec about_x = rigid_motion(b, 0, 0, 1, 0), about_y = rigid_motion(b, 0, 0, 0, 1);
    EXPECT_NEAR(about_x.dot(e.M * about_x), Id, rounding * Id);
    EXPECT_NEAR(about_y.dot(e.M * about_y), Id, rounding * Id);
    EXPECT_NEAR(about_x.dot(e.G * about_y), +Ip, rounding * Ip);
    EXPECT_NEAR(about_y.dot(e.G * about_x), -Ip, rounding * Ip);
  }
}

// ---- all kinds ----------------------------------------------------------------------------------

TEST(Beam, MatricesAreSymmetricOrSkewAndMassIsPositive) {
  for (const Beam& b : beams_of_all_kinds()) {
    const auto e = matrices(b);
    EXPECT_LT(largest(e.M - e.M.transpose()), rounding * largest(e.M)) << what(b);
    EXPECT_LT(largest(e.K - e.K.transpose()), rounding * largest(e.K)) << what(b);
    EXPECT_LE(largest(e.G + e.G.transpose()), rounding * largest(e.G)) << what(b);
    EXPECT_GT(symmetric_modes(Mat(e.M)).values(0), 0.0) << what(b);
  }
}

// Translations and rotations store no energy, everything else does: K has exactly four null
// vectors, with internal functions too.
TEST(Beam, OnlyRigidMotionsHaveNoElasticEnergy) {
  for (const Beam& b : beams_of_all_kinds()) {
    const Mat K = matrices(b).K;
    Mat rigid(K.rows(), 4);
    rigid << rigid_motion(b, 1, 0, 0, 0), rigid_motion(b, 0, 1, 0, 0), rigid_motion(b, 0, 0, 1, 0),
        rigid_motion(b, 0, 0, 0, 1);
    EXPECT_LT(largest(K * rigid), rounding * largest(K)) << what(b);
    const Vec size = K.diagonal().cwiseSqrt().cwiseInverse();  // tells zeros from small stiffness
    const Mat scaled = size.asDiagonal() * K * size.asDiagonal();
    const Vec energy = symmetric_modes(Mat(scaled)).values;
    EXPECT_LT(std::abs(energy(3)), rounding) << what(b);
    EXPECT_GT(energy(4), 1e-4) << what(b);
  }
}

// Mass of a truncated cone: rho pi L (d1^2 + d1 d2 + d2^2) / 12, outside less inside.
TEST(Beam, TranslationHasTheMassOfTheBody) {
  for (const Beam& b : beams_of_all_kinds()) {
    const auto volume = [&](double d1, double d2) {
      return pi / 12.0 * b.L * (d1 * d1 + d1 * d2 + d2 * d2);
    };
    const double mass = b.material.rho *
                        (volume(b.left.outer, b.right.outer) - volume(b.left.inner, b.right.inner));
    const Mat M = matrices(b).M;
    const Vec along_x = rigid_motion(b, 1, 0, 0, 0), along_y = rigid_motion(b, 0, 1, 0, 0);
    EXPECT_NEAR(along_x.dot(M * along_x), mass, rounding * mass) << what(b);
    EXPECT_NEAR(along_y.dot(M * along_y), mass, rounding * mass) << what(b);
    EXPECT_NEAR(along_x.dot(M * along_y), 0.0, rounding * mass) << what(b);
  }
}

// Polar inertia of a truncated cone: rho pi L (d2^5 - d1^5) / (160 (d2 - d1)), outside less inside.
TEST(Beam, GyroscopicsOfAConeHaveItsPolarInertia) {
  Beam b = cone();
  const auto polar = [&](double d1, double d2) {
    return b.material.rho * pi * b.L * (std::pow(d2, 5) - std::pow(d1, 5)) / (160.0 * (d2 - d1));
  };
  const double Ip = polar(b.left.outer, b.right.outer) - polar(b.left.inner, b.right.inner);
  for (b.internal_functions = 0; b.internal_functions <= 4; ++b.internal_functions) {
    const Vec about_x = rigid_motion(b, 0, 0, 1, 0), about_y = rigid_motion(b, 0, 0, 0, 1);
    EXPECT_NEAR(about_x.dot(matrices(b).G * about_y), Ip, rounding * Ip) << what(b);
  }
}

// Internal functions leave static deflections alone: K is block diagonal, internal blocks diagonal.
TEST(Beam, InternalFunctionsAreOrthogonalInEnergy) {
  for (const Beam& b : beams_of_all_kinds()) {
    if (b.internal_functions == 0) continue;
    const Mat K = matrices(b).K;
    const auto n = K.rows() - 8;
    const Vec size = K.diagonal().cwiseSqrt();
    for (Eigen::Index i = 0; i < K.rows(); ++i) {
      for (Eigen::Index j = 8; j < K.rows(); ++j) {
        if (i == j) continue;
        EXPECT_LT(std::abs(K(i, j)), gram_schmidt * size(i) * size(j)) << what(b);
      }
    }
    EXPECT_EQ(n, 4 * b.internal_functions / (b.theory == Theory::timoshenko ? 1 : 2)) << what(b);
  }
}

// A flipped cone is the same cone seen from the other side: z -> -z maps theta to -theta.
TEST(Beam, AMirroredConeHasTheMirroredMatrices) {
  const Beam b = cone();
  Beam mirrored = b;
  std::swap(mirrored.left, mirrored.right);
  Block flip = Block::Zero();
  flip.topRightCorner<4, 4>().diagonal() << 1, 1, -1, -1;
  flip.bottomLeftCorner<4, 4>().diagonal() << 1, 1, -1, -1;
  const auto e = matrices(b), f = matrices(mirrored);
  EXPECT_LT(largest(flip * f.K * flip - e.K), taper_quadrature * largest(e.K));
  EXPECT_LT(largest(flip * f.M * flip - e.M), taper_quadrature * largest(e.M));
}

// ---- cones --------------------------------------------------------------------------------------

// Solid cantilever tapering from d0 at the clamp to d1 at the tip, exact with one element:
//   force:   w     = 64 F L^3 / (3 pi E d0^3 d1) + 4 F L / (pi kappa G d0 d1)
//   moment:  theta = 64 M L (d0^2 + d0 d1 + d1^2) / (3 pi E d0^3 d1^3)
//            w     = 32 M L^2 (d0 + 2 d1) / (3 pi E d0^3 d1^2)
// from integrals of s^2, 1 and s over (d1 + (d0 - d1) s / L)^4.
TEST(Beam, TaperedCantileverDeflectsAsInClosedForm) {
  for (const double d1 : {0.01, 0.02, 0.05, 0.099, 0.2, 1.0}) {
    const double d0 = 0.1, L = 0.8, F = 1e4, moment = 2e3;
    const Material m = test::steel();
    const Beam b{.L = L, .left = {.outer = d0}, .right = {.outer = d1}, .material = m};
    const Mat K = matrices(b).K.bottomRightCorner(4, 4);  // the tip: x, y, theta_x, theta_y
    const double kappa = shear_coefficient({}, b.left, m.nu);

    const Vec forced = DenseLu<Mat>(K).solve(Eigen::Vector4d(F, 0, 0, 0));
    const double w = 64.0 * F * L * L * L / (3.0 * pi * m.E * d0 * d0 * d0 * d1) +
                     4.0 * F * L / (pi * kappa * m.G * d0 * d1);
    EXPECT_NEAR(forced(0), w, taper_quadrature * w) << "tip of " << d1;

    const Vec turned = DenseLu<Mat>(K).solve(Eigen::Vector4d(0, 0, 0, moment));
    const double theta = 64.0 * moment * L * (d0 * d0 + d0 * d1 + d1 * d1) /
                         (3.0 * pi * m.E * d0 * d0 * d0 * d1 * d1 * d1);
    const double w_moment =
        32.0 * moment * L * L * (d0 + 2.0 * d1) / (3.0 * pi * m.E * d0 * d0 * d0 * d1 * d1);
    EXPECT_NEAR(turned(3), theta, taper_quadrature * theta) << "tip of " << d1;
    EXPECT_NEAR(turned(0), w_moment, taper_quadrature * w_moment) << "tip of " << d1;
  }
}

// ---- axial force and torque ---------------------------------------------------------------------

// Axial force of an Euler-Bernoulli element, [Przemieniecki1968], ch. 15:
//   N / (30 L) [36 3L -36 3L; 3L 4L^2 -3L -L^2; ...]
TEST(Beam, AxialForceAddsTheGeometricStiffness) {
  Beam b = cylinder(Theory::euler_bernoulli);
  const Block without = matrices(b).K;
  b.axial_force = 7e5;
  const double L = b.L;
  const auto geometric =
      plane(b.axial_force / (30.0 * L), 36.0, 3.0 * L, -36.0, 3.0 * L, 4.0 * L * L, -L * L);
  const Block expected = without + in_planes(geometric, Eigen::Matrix4d::Zero());
  EXPECT_LT(largest(matrices(b).K - expected), rounding * largest(expected));
}

// A string that turns by alpha about its end: energy N L alpha^2 / 2, no matter how it bends.
TEST(Beam, RigidRotationUnderTensionHasTheEnergyOfAString) {
  for (Beam b : beams_of_all_kinds()) {
    b.axial_force = 1e6;
    const Vec turn = rigid_motion(b, 0, 0, 0, 1);
    const double energy = turn.dot(matrices(b).K * turn);
    // tension is far below the bending stiffness whose rounding is left
    const double noise = rounding * largest(matrices(b).K);
    EXPECT_NEAR(energy, b.axial_force * b.L, noise) << what(b);
    EXPECT_LT(noise, 1e-3 * b.axial_force * b.L);
  }
}

TEST(Beam, TorqueOfAnElementActsBetweenThePlanesOnly) {
  Beam b = cylinder(Theory::euler_bernoulli);
  const Block without = matrices(b).K;
  b.torque = 1e4;
  const Block by_torque = matrices(b).K - without;
  for (const int i : {0, 3, 4, 7}) {
    for (const int j : {0, 3, 4, 7}) EXPECT_EQ(by_torque(i, j), 0.0);
  }
  // ends held: what is left is symmetric, a torque fixed in space does no work around a loop
  Beam long_one = b;
  long_one.internal_functions = 3;
  const auto with = matrices(long_one).K;
  long_one.torque = 0.0;
  const Mat inner = Mat(with - matrices(long_one).K).bottomRightCorner(6, 6);
  EXPECT_GT(largest(inner), 0.0);
  EXPECT_LT(largest(inner - inner.transpose()), rounding * largest(inner));
}

// ---- internal damping ---------------------------------------------------------------------------

// Material whose stress is E (strain + eta strain'): C = eta K, and between the planes the
// circulatory matrix H with force -eta K (z' - i Omega z), z = x + i y. [ZorziNelson1977]
TEST(Beam, InternalDampingIsProportionalToStiffnessAndCirculatory) {
  for (Beam b : beams_of_all_kinds()) {
    b.material.eta = 2e-4;
    b.axial_force = 1e5;  // stores energy but does not dissipate
    const auto e = matrices(b);
    b.axial_force = 0.0;
    const Mat elastic = matrices(b).K;
    EXPECT_LT(largest(e.C - b.material.eta * elastic), rounding * largest(e.C)) << what(b);
    EXPECT_LT(largest(e.H + e.H.transpose()), rounding * largest(e.H)) << what(b);
    // of -eta K (z' - i Omega z) the part along x that comes from y: -Omega eta K y
    EXPECT_NEAR(e.H(0, 1), b.material.eta * elastic(0, 0), rounding * largest(e.H)) << what(b);
    EXPECT_NEAR(e.H(1, 0), -b.material.eta * elastic(0, 0), rounding * largest(e.H)) << what(b);
  }
}

// Seen from the shaft, a bow that turns with it is at rest and is not damped: z = z0 e^(i Omega t)
// means q' = Omega J q with J (x, y, theta_x, theta_y) = (-y, x, -theta_y, theta_x), and
// C q' + Omega H q = 0.
TEST(Beam, InternalDampingVanishesInSynchronousMotion) {
  Beam b = cone();
  b.material.eta = 2e-4;
  const auto e = matrices(b);
  Vec q(8), turned(8);
  q << 1e-3, 2e-3, 0.01, -0.02, -1e-3, 5e-4, 0.03, 0.01;
  for (int i = 0; i < 8; i += 2) {
    turned(i) = -q(i + 1);
    turned(i + 1) = q(i);
  }
  EXPECT_LT(largest(e.C * turned + e.H * q), rounding * largest(e.C));
  EXPECT_GT(largest(e.C * turned), 1e-6 * largest(e.C));
}

TEST(Beam, RefusesMoreInternalFunctionsThanItHas) {
  Beam b = cylinder();
  b.internal_functions = 5;
  EXPECT_THROW(matrices(b), OptionError);
  b.internal_functions = -1;
  EXPECT_THROW(matrices(b), OptionError);
}

}  // namespace whirl::beam_test
