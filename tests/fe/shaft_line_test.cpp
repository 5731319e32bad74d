// The shaft between its nodes: shape functions, and shapes drawn with them.

#include "libfe/assembly/shaft_line.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <utility>
#include <vector>

#include "libfe/analyses/modes.hpp"
#include "libfe/analyses/static.hpp"
#include "libfe/mesh/elements/beam.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::shaft_line_test {

using test::pi;

constexpr double rounding = 1e-11;         // relative; interpolation through 24 points
constexpr double taper_quadrature = 1e-9;  // relative; 24 points on a cone
constexpr double slope_tolerance = 0.15;   // of an order measured over a factor of four in h

/// Orders by which errors fall from one mesh to the one twice as fine.
std::vector<double> orders(const std::vector<double>& errors) {
  std::vector<double> all;
  for (std::size_t i = 1; i < errors.size(); ++i)
    all.push_back(std::log2(errors[i - 1] / errors[i]));
  return all;
}

// Phi = 12 E I / (kappa G A L^2), xi = z / L, [Przemieniecki1968], ch. 11:
//   N_1 = (1 - 3 xi^2 + 2 xi^3 + Phi (1 - xi)) / (1 + Phi)
//   N_2 = L (xi - 2 xi^2 + xi^3 + Phi (xi - xi^2) / 2) / (1 + Phi)
//   N_3 = (3 xi^2 - 2 xi^3 + Phi xi) / (1 + Phi)
//   N_4 = L (-xi^2 + xi^3 - Phi (xi - xi^2) / 2) / (1 + Phi)
TEST(DeflectionFunctions, OfACylinderAreTheClosedForms) {
  for (const Theory theory : {Theory::timoshenko, Theory::rayleigh, Theory::euler_bernoulli}) {
    const Section section{.outer = 0.06, .inner = 0.02};
    const Material m = test::steel();
    const double L = 0.15;
    const Beam beam{.L = L, .left = section, .right = section, .material = m, .theory = theory};
    const double kappa = shear_coefficient({}, section, m.nu);
    const double Phi = theory == Theory::timoshenko
                           ? 12.0 * m.E * section.I() / (kappa * m.G * section.A() * L * L)
                           : 0.0;
    const Vec xi = Vec::LinSpaced(11, 0.0, 1.0);
    const Mat N = deflection_functions(beam, xi);
    ASSERT_EQ(N.cols(), 4);
    for (Eigen::Index i = 0; i < xi.size(); ++i) {
      const double s = xi(i), s2 = s * s, s3 = s2 * s, shear = 0.5 * Phi * (s - s2);
      Eigen::RowVector4d exact(1 - 3 * s2 + 2 * s3 + Phi * (1 - s), L * (s - 2 * s2 + s3 + shear),
                               3 * s2 - 2 * s3 + Phi * s, L * (-s2 + s3 - shear));
      exact /= 1.0 + Phi;
      EXPECT_LT((N.row(i) - exact).cwiseAbs().maxCoeff(), rounding) << "at " << s;
    }
  }
}

// A cone bent by a force at its end carries no load between its nodes: one element is exact there,
// and equals a mesh with nodes at all the places that are drawn.
TEST(ShaftLine, OfACantileveredConeEqualsAMeshWithNodesThere) {
  constexpr int parts = 12;
  const auto deflection = [](int elements, int pieces) {
    Structure s = test::cantilever(test::cone(0.6, 0.1, 0.03, elements));
    const Assembler assembler(s);
    const System system = assembler.uncondensed(0.0);
    Vec f = Vec::Zero(system.dofs.full_size);
    f(4 * elements + X) = 1000.0;
    f(4 * elements + Y) = 300.0;
    const Vec q = Mat(system.K).ldlt().solve(Vec(system.dofs.T.transpose() * f));
    const ShaftLine line = shaft_line(assembler, pieces);
    Mat xy(line.z.size(), 2);
    xy.col(0) = line.x * Vec(system.dofs.T * q);
    xy.col(1) = line.y * Vec(system.dofs.T * q);
    return xy;
  };
  const Mat one = deflection(1, parts), many = deflection(parts, 1);
  ASSERT_EQ(one.rows(), many.rows());
  EXPECT_LT((one - many).cwiseAbs().maxCoeff(), taper_quadrature * many.cwiseAbs().maxCoeff());
}

// A rigid rotation theta_x, theta_y about the left end: x = theta_y z, y = -theta_x z everywhere.
TEST(ShaftLine, FollowsRigidRotationsWithTheSignsOfTheConventions) {
  Structure s{.shaft = {test::cylinder(0.5, 0.05, 3), test::cone(0.3, 0.05, 0.02, 2)}};
  s.shaft[0].internal_functions = 2;  // whose amplitudes are behind all nodes
  const Assembler assembler(s);
  const ShaftLine line = shaft_line(assembler, 5);
  Vec full = Vec::Zero(line.x.cols());
  ASSERT_EQ(full.size(), assembler.uncondensed(0.0).dofs.full_size);
  for (int i = 0; i < assembler.mesh().nodes(); ++i) {
    const double z = assembler.mesh().z[static_cast<std::size_t>(i)];
    full.segment<4>(4 * i) << 0.02 * z, -0.03 * z, 0.03, 0.02;
  }
  EXPECT_LT((line.x * full - 0.02 * line.z).cwiseAbs().maxCoeff(), rounding);
  EXPECT_LT((line.y * full + 0.03 * line.z).cwiseAbs().maxCoeff(), rounding);
  EXPECT_EQ(line.z.size(), 5 * 5 + 1);
  EXPECT_DOUBLE_EQ(line.z(line.z.size() - 1), 0.8);
}

/// Error of the second mode of a pinned shaft between the nodes too, of its largest displacement:
/// it is a sine whatever the theory.
double error_of_second_mode(Segment shaft) {
  const Assembler assembler(test::pinned(shaft));
  const System system = assembler.at(0.0);
  const Mode mode = complex_modes(system, 4).oscillatory.at(3);  // two planes
  const ShaftLine line = shaft_line(assembler, 7);
  const CVec full = system.dofs.T * mode.shape;
  const CVec x = line.x * full, y = line.y * full;
  const CVec& w = x.norm() > y.norm() ? x : y;
  const CVec sine = (2.0 * pi * line.z / shaft.length).array().sin().matrix().cast<Complex>();
  const Complex factor = sine.dot(w) / sine.squaredNorm();
  return (w - factor * sine).cwiseAbs().maxCoeff() / std::abs(factor);
}

// Without shear the cubic functions are of fourth order between the nodes, and a pair of internal
// functions makes it five.
TEST(ShaftLine, OfAModeConvergesToTheSineBetweenTheNodes) {
  for (const auto& [internal, order] : {std::pair(0, 4.0), {1, 5.0}}) {
    std::vector<double> errors;
    for (const int elements : {8, 16, 32}) {
      Segment shaft = test::cylinder(1.0, 0.02, elements, Theory::euler_bernoulli);
      shaft.internal_functions = internal;
      errors.push_back(error_of_second_mode(shaft));
    }
    for (const double measured : orders(errors)) {
      EXPECT_NEAR(measured, order, slope_tolerance) << internal << " internal functions";
    }
  }
}

// Straight lines between the nodes of a sine miss it by (k h)^2 / 8, k = 2 pi / L, in the middle.
TEST(ShaftLine, OfATimoshenkoModeIsFarNearerThanLinesBetweenTheNodes) {
  constexpr double share = 0.02;  // of that error; measured 0.012 and less
  for (const int elements : {6, 12, 24}) {
    const double straight = std::pow(2.0 * pi / elements, 2) / 8.0;
    EXPECT_LT(error_of_second_mode(test::cylinder(1.0, 0.02, elements)), share * straight);
  }
}

}  // namespace whirl::shaft_line_test
