// Rigid disks and bodies.

#include "libfe/mesh/elements/disk.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/dense.hpp"
#include "libfe/mesh/elements/body.hpp"

namespace whirl::disk_test {

constexpr double rounding = 1e-14;  // relative; a few products

// Disk on a rotational spring k, theta = theta_x + i theta_y ~ exp(i w t):
//   Id w^2 - Ip Omega w - k = 0
TEST(Disk, SpinSplitsTheConicalFrequenciesAsInClosedForm) {
  constexpr double qr_noise = 1e-9;  // of the eigenvalues of a 4 x 4 state matrix
  const Disk disk{.m = 2.0, .Id = 0.010, .Ip = 0.018};
  const double k = 400.0, Omega = 300.0;

  const auto e = matrices(disk);
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();  // state (theta, theta')
  A.topRightCorner<2, 2>().setIdentity();
  A.bottomLeftCorner<2, 2>().diagonal().setConstant(-k / disk.Id);
  A.bottomRightCorner<2, 2>() = -Omega / disk.Id * e.G.bottomRightCorner<2, 2>();
  Eigen::Vector4d w = eigenvalues(A).imag();
  std::sort(w.begin(), w.end());

  const double mean = disk.Ip * Omega / (2.0 * disk.Id);
  const double root = std::sqrt(mean * mean + k / disk.Id);
  EXPECT_NEAR(w[2], root - mean, qr_noise * root);  // backward whirl is slowed down
  EXPECT_NEAR(w[3], root + mean, qr_noise * root);  // forward whirl is sped up
}

// The angular momentum of spin follows the axis, L = Omega Ip (theta_y, -theta_x, 1), and changes
// with the moment, L' = M: the signs of docs/conventions.md.
TEST(Disk, GyroscopicMomentIsTheRateOfTheAngularMomentum) {
  const Disk disk{.m = 1.0, .Id = 0.5, .Ip = 0.9};
  const double Omega = 7.0;
  const Eigen::Vector4d rate(0.0, 0.0, 0.2, 0.3);  // theta_x', theta_y'
  const Eigen::Vector4d moment = Omega * matrices(disk).G * rate;
  const Vec2 momentum_rate = Omega * disk.Ip * Vec2(rate(3), -rate(2));
  EXPECT_NEAR(moment(2), momentum_rate(0), rounding);
  EXPECT_NEAR(moment(3), momentum_rate(1), rounding);
  EXPECT_EQ(moment(0), 0.0);
  EXPECT_EQ(moment(1), 0.0);
}

TEST(Disk, MassActsOnDisplacementsAndDiametralInertiaOnTilts) {
  const auto e = matrices(Disk{.m = 2.0, .Id = 0.3, .Ip = 0.5});
  EXPECT_EQ(e.M, Eigen::Matrix4d(Eigen::Vector4d(2.0, 2.0, 0.3, 0.3).asDiagonal()));
  EXPECT_EQ(e.G, Eigen::Matrix4d(-e.G.transpose()));
  EXPECT_TRUE(e.K.isZero(0.0));
  EXPECT_TRUE(e.C.isZero(0.0));
}

// [Friswell2010], example 5.9.1: disks of 280 mm and 350 mm, 70 mm wide, bore 50 mm, 7810 kg/m^3,
// have 32.589728 kg, Id 0.178089, Ip 0.329564 kg.m^2 and 51.525261 kg, 0.423581, 0.805082 kg.m^2
// (as printed by ROSS for DiskElement.from_geometry).
TEST(Disk, InertiaFromShapeAsPublished) {
  constexpr double printed = 5e-7;  // six digits behind the point
  Disk first{.outer_diameter = 0.28, .inner_diameter = 0.05, .width = 0.07};
  set_inertia_from_shape(first, 7810.0);
  EXPECT_NEAR(first.m, 32.589728, printed);
  EXPECT_NEAR(first.Id, 0.178089, printed);
  EXPECT_NEAR(first.Ip, 0.329564, printed);
  Disk second{.outer_diameter = 0.35, .inner_diameter = 0.05, .width = 0.07};
  set_inertia_from_shape(second, 7810.0);
  EXPECT_NEAR(second.m, 51.525261, printed);
  EXPECT_NEAR(second.Id, 0.423581, printed);
  EXPECT_NEAR(second.Ip, 0.805082, printed);
}

// Perpendicular axes: Ip = 2 Id for no width; a cylinder as wide as sqrt(3) radii has Ip = Id.
TEST(Disk, InertiaFromShapeInItsLimits) {
  Disk thin{.outer_diameter = 0.3, .inner_diameter = 0.1, .width = 1e-9};
  set_inertia_from_shape(thin, 7800.0);
  EXPECT_NEAR(thin.Ip / thin.Id, 2.0, rounding);
  Disk sphere_like{.outer_diameter = 0.2, .width = 0.1 * std::sqrt(3.0)};
  set_inertia_from_shape(sphere_like, 7800.0);
  EXPECT_NEAR(sphere_like.Ip / sphere_like.Id, 1.0, rounding);
}

// A body that spins is a disk; one that does not has no gyroscopics.
TEST(Body, IsADiskOnlyIfItSpins) {
  const Body stator{.m = 4.0, .tilts = true, .Id = 0.2, .Ip = 0.3};
  Body rotor = stator;
  rotor.spins = true;
  const auto disk = matrices(Disk{.m = 4.0, .Id = 0.2, .Ip = 0.3});
  EXPECT_EQ(matrices(rotor).M, disk.M);
  EXPECT_EQ(matrices(rotor).G, disk.G);
  EXPECT_EQ(matrices(stator).M, disk.M);
  EXPECT_TRUE(matrices(stator).G.isZero(0.0));
}

}  // namespace whirl::disk_test
