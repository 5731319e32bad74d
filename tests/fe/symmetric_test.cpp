// Undamped modes: the sparse solver against the dense one and closed forms.

#include "libfe/eigen/symmetric.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libbase/numerics/dense.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::symmetric_test {

using test::at;

// relative; the stiffness of hundreds of short elements is conditioned to 1e10, and the dense
// oracle loses as much
constexpr double eigenvalue_noise = 2e-6;

/// omega^2 of both planes at rest, ascending: dense, but only of half the size each.
Vec dense_by_planes(const System& s) {
  std::vector<int> planes[2];
  for (int i = 0; i < s.size(); ++i) {
    // a freedom of a plane is one whose full vector moves along x or theta_y
    const int full = static_cast<int>(Sparse(s.dofs.T.col(i)).innerIndexPtr()[0]) % 4;
    planes[full == X || full == THETA_Y ? 0 : 1].push_back(i);
  }
  const Mat K = s.K, M = s.M;
  EXPECT_TRUE(K(planes[0], planes[1]).isZero(0.0));
  Vec all(s.size());
  Eigen::Index next = 0;
  for (const auto& plane : planes) {
    const Vec values = symmetric_modes(K(plane, plane), M(plane, plane)).value().values;
    all.segment(next, values.size()) = values;
    next += values.size();
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// Modes must solve the pencil, be M-orthonormal, ascend and show their largest entry positive.
void expect_modes(const System& s, const RealModes& modes) {
  constexpr double orthogonality = 1e-8;  // Lanczos vectors, tolerance 1e-10
  const auto m = modes.omega2.size();
  const Mat MPhi = s.M * modes.Phi, KPhi = s.K * modes.Phi;
  EXPECT_LT((modes.Phi.transpose() * MPhi - Mat::Identity(m, m)).cwiseAbs().maxCoeff(),
            orthogonality);
  const double scale = modes.omega2(m - 1);
  Mat stiffness = modes.Phi.transpose() * KPhi;
  stiffness.diagonal() -= modes.omega2;
  EXPECT_LT(stiffness.cwiseAbs().maxCoeff(), eigenvalue_noise * scale);
  EXPECT_TRUE(std::is_sorted(modes.omega2.begin(), modes.omega2.end()));
  for (Eigen::Index j = 0; j < m; ++j) {
    EXPECT_GT(modes.Phi.col(j).maxCoeff(), 0.0);
    EXPECT_GE(modes.Phi.col(j).maxCoeff(), -modes.Phi.col(j).minCoeff());
  }
}

void expect_lowest(const System& s, int count) {
  const RealModes modes = lowest_real_modes(s.K, s.M, count);
  ASSERT_EQ(modes.omega2.size(), count);
  EXPECT_EQ(modes.rigid, 0);
  const Vec exact = dense_by_planes(s).head(count);
  for (int i = 0; i < count; ++i) {
    EXPECT_NEAR(modes.omega2(i), exact(i), eigenvalue_noise * exact(i)) << "mode " << i + 1;
  }
  expect_modes(s, modes);
}

// ---- supported rotors ---------------------------------------------------------------------------

// Every eigenvalue is double; odd counts cut a pair in half.
TEST(RealModes, IsotropicRotorsOfThirtyToThreeHundredNodes) {
  for (const int elements : {29, 60, 120, 299}) {
    const System s = assemble(test::two_disk(test::isotropic(1e6), std::max(1, elements / 6)), 0.0);
    for (const int count : {1, 2, 7, 12}) {
      SCOPED_TRACE(std::to_string(elements) + " elements, " + std::to_string(count) + " modes");
      expect_lowest(s, count);
    }
  }
}

TEST(RealModes, RandomRotors) {
  std::mt19937 random(3);
  for (int draw = 0; draw < 12; ++draw) {
    SCOPED_TRACE("draw " + std::to_string(draw));
    const int elements = std::uniform_int_distribution<int>(30, 90)(random);
    const Structure rotor =
        test::random_rotor(random, {.elements = elements, .is_isotropic = draw % 2 == 0});
    expect_lowest(assemble(rotor, 0.0), 5 + draw);
  }
}

// The sparse and the dense branch of one function: 29 nodes are solved densely, 31 sparsely.
TEST(RealModes, DenseAndSparseBranchesAgreeOnOneRotor) {
  const System s = assemble(test::two_disk(test::isotropic(1e6), 8), 0.0);
  ASSERT_GT(s.size(), 180);
  const RealModes sparse = lowest_real_modes(s.K, s.M, 9);
  const RealModes dense = lowest_real_modes(s.K, s.M, s.size());
  for (int i = 0; i < 9; ++i) {
    EXPECT_NEAR(sparse.omega2(i), dense.omega2(i), eigenvalue_noise * dense.omega2(i));
  }
}

TEST(RealModes, CountsBeyondTheSizeGiveAll) {
  const System s = assemble(test::Jeffcott{}.structure(), 0.0);
  const RealModes modes = lowest_real_modes(s.K, s.M, 10);
  EXPECT_EQ(modes.omega2.size(), 2);
}

TEST(RealModes, FreedomsWithoutInertiaAreRefused) {
  Sparse M(3, 3), K(3, 3);
  M.insert(0, 0) = M.insert(1, 1) = 1.0;
  K.setIdentity();
  EXPECT_THROW(lowest_real_modes(K, M, 2), NumericalError);
  // large enough for Lanczos
  const System s = assemble(test::two_disk(test::isotropic(1e6), 8), 0.0);
  Sparse lacking = s.M;
  lacking.prune([](Eigen::Index i, Eigen::Index j, double) { return i != 0 && j != 0; });
  EXPECT_THROW(lowest_real_modes(s.K, lacking, 4), NumericalError);
}

// ---- free rotors --------------------------------------------------------------------------------

// Free-free Euler-Bernoulli shaft: omega = (beta L)^2 sqrt(E I / (rho A L^4)),
// beta L = 4.730040744862704, 7.853204624095838, every one double. [Blevins1979], table 8-1
TEST(RealModes, FreeShaftHasFourRigidModesOfExactlyZeroAndItsPublishedFrequencies) {
  for (const int elements : {12, 40, 150, 500}) {  // dense, sparse, and badly conditioned
    Segment shaft = test::cylinder(2.0, 0.05, elements, Theory::euler_bernoulli);
    const System s = assemble({.shaft = {shaft}}, 0.0);
    const RealModes modes = lowest_real_modes(s.K, s.M, 8);
    EXPECT_EQ(modes.rigid, 4);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(modes.omega2(i), 0.0);
    const double unit =
        std::sqrt(test::EI(shaft) / (shaft.material.rho * shaft.left.A() * std::pow(2.0, 4)));
    const double discretization = 0.1 * std::pow(7.85 / elements, 4);  // h^4 in the second mode
    const double first = std::pow(4.730040744862704, 2) * unit;
    const double second = std::pow(7.853204624095838, 2) * unit;
    const double tolerance = std::max(discretization, eigenvalue_noise);
    EXPECT_NEAR(modes.first_flexible(), first, tolerance * first) << elements;
    EXPECT_NEAR(std::sqrt(modes.omega2(5)), first, tolerance * first) << elements;
    EXPECT_NEAR(std::sqrt(modes.omega2(6)), second, tolerance * second) << elements;
    EXPECT_NEAR(std::sqrt(modes.omega2(7)), second, tolerance * second) << elements;
  }
}

// Rigid modes span translations and rotations: the rest is orthogonal to them.
TEST(RealModes, RigidModesOfFreeRotorsDoNotDeform) {
  std::mt19937 random(4);
  for (int draw = 0; draw < 8; ++draw) {
    SCOPED_TRACE("draw " + std::to_string(draw));
    const int elements = draw < 2 ? 20 : std::uniform_int_distribution<int>(30, 90)(random);
    const Structure rotor = test::random_rotor(random, {.elements = elements, .is_free = true});
    const Assembler assembler(rotor);
    const System s = assembler.at(0.0);
    const RealModes modes = lowest_real_modes(s.K, s.M, 9);
    ASSERT_EQ(modes.rigid, 4);

    Mat rigid = Mat::Zero(s.size(), 4);  // x, y, and rotations about x and y through z = 0
    for (int n = 0; n < s.dofs.nodes; ++n) {
      const double z = assembler.mesh().z[static_cast<std::size_t>(n)];
      rigid.block<4, 4>(4 * n, 0).setIdentity();
      rigid(4 * n + Y, THETA_X) = -z;
      rigid(4 * n + X, THETA_Y) = z;
    }
    // what the flexible modes keep of them, against their own size
    constexpr double orthogonality = 1e-6;
    const Vec size = (rigid.transpose() * (s.M * rigid)).diagonal().cwiseSqrt();
    const Mat share =
        size.cwiseInverse().asDiagonal() * (rigid.transpose() * (s.M * modes.Phi.rightCols(5)));
    EXPECT_LT(share.cwiseAbs().maxCoeff(), orthogonality);
    const Vec exact = dense_by_planes(s).segment(4, 5);
    for (int i = 0; i < 5; ++i) {
      EXPECT_NEAR(modes.omega2(4 + i), exact(i), eigenvalue_noise * exact(i));
    }
  }
}

// Held along x only: two rigid modes are left, along y.
TEST(RealModes, HalfSupportedRotorsKeepHalfTheirRigidModes) {
  for (const int elements : {2, 8}) {  // per sixth: dense, sparse
    const System s = assemble(test::two_disk(test::orthotropic(1e6, 0.0), elements), 0.0);
    const RealModes modes = lowest_real_modes(s.K, s.M, 6);
    EXPECT_EQ(modes.rigid, 2) << elements;
    EXPECT_GT(modes.omega2(2), 0.0);
  }
}

// A body that nothing holds, and nothing else: all is rigid.
TEST(RealModes, AFreeBodyAloneIsRigid) {
  const System s = assemble({.bodies = {{.name = "ball", .m = 2.0}}}, 0.0);
  const RealModes modes = lowest_real_modes(s.K, s.M, 2);
  EXPECT_EQ(modes.rigid, 2);
  EXPECT_EQ(modes.omega2, Vec::Zero(2));
}

// ---- supports -----------------------------------------------------------------------------------

TEST(IsSupported, TellsSupportedFromFreeAndHalfSupported) {
  for (const int elements : {1, 10, 40}) {
    const auto K = [&](double kx, double ky) {
      return assemble(test::two_disk(test::orthotropic(kx, ky), elements), 0.0).K;
    };
    EXPECT_TRUE(is_supported(K(1e6, 1e6)));
    EXPECT_TRUE(is_supported(K(1.0, 1.0)));  // soft is still supported
    EXPECT_FALSE(is_supported(K(0.0, 0.0)));
    EXPECT_FALSE(is_supported(K(1e6, 0.0)));
    EXPECT_FALSE(is_supported(K(0.0, 1e6)));
  }
  // one bearing pins two of four rigid motions; a clamp holds all
  const Segment shaft = test::cylinder(1.0, 0.05, 10);
  EXPECT_FALSE(
      is_supported(assemble({.shaft = {shaft}, .bearings = {test::rigid(at(0.0))}}, 0.0).K));
  EXPECT_TRUE(is_supported(assemble(test::cantilever(shaft), 0.0).K));
}

TEST(IsSymmetric, SeesCrossCoupling) {
  Structure s = test::two_disk(test::isotropic(1e6));
  EXPECT_TRUE(is_symmetric(assemble(s, 0.0).K));
  BearingCoefficients oil = test::isotropic(1e6);
  oil.K(0, 1) = 10.0;
  s.bearings[0] = test::bearing(at(0.0), oil);
  const Sparse K = assemble(s, 0.0).K;
  EXPECT_FALSE(is_symmetric(K));
  EXPECT_TRUE(is_symmetric(symmetric_part(K)));
}

}  // namespace whirl::symmetric_test
