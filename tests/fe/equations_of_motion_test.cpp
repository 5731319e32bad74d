// Shafts that spin at speeds of their own: their parts of the equations of motion, summed.

#include "libfe/eigen/equations_of_motion.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "libfe/analyses/modes.hpp"
#include "libfe/analyses/reduce.hpp"
#include "libfe/eigen/dynamic_stiffness.hpp"
#include "libfe/mesh/elements/disk.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::equations_of_motion_test {

constexpr double rounding = 1e-9;  // relative; of eigenvalues

/// A rotor whose shaft damps, so that it has both matrices that go with the spin.
System rotor_that_damps(double Omega) {
  Structure rotor = test::two_disk(test::isotropic(1e6, 500.0));
  for (Segment& s : rotor.shaft) s.material.eta = 1e-4;
  return assemble(rotor, Omega);
}

void expect_same_modes(const Modes& modes, const Modes& expected) {
  ASSERT_EQ(modes.oscillatory.size(), expected.oscillatory.size());
  for (std::size_t i = 0; i < modes.oscillatory.size(); ++i) {
    const Complex lambda = expected.oscillatory[i].lambda;
    EXPECT_LE(std::abs(modes.oscillatory[i].lambda - lambda), rounding * std::abs(lambda));
  }
}

// What spins backward as fast as something equal spins forward takes its gyroscopics and its
// rotating damping away: the modes are those at rest.
TEST(EquationsOfMotion, EqualShaftsThatSpinAgainstEachOtherAreAtRest) {
  System s = rotor_that_damps(400.0);
  ASSERT_TRUE(s.circulates());
  ASSERT_EQ(s.spin_parts.size(), 1u);
  s.spin_parts.push_back(s.spin_parts[0]);
  s.spin_parts[1].ratio = -1.0;
  EXPECT_TRUE(Mat(s.G()).isZero(0.0));
  EXPECT_EQ(Mat(s.D()), Mat(s.C));
  EXPECT_EQ(Mat(s.stiffness()), Mat(s.K));
  expect_same_modes(complex_modes(s, 6), complex_modes(rotor_that_damps(0.0), 6));
}

TEST(EquationsOfMotion, AShaftAtTwiceTheSpeedIsThatAtTwiceOmega) {
  System s = rotor_that_damps(200.0);
  s.spin_parts[0].ratio = 2.0;
  const System twice = rotor_that_damps(400.0);
  expect_same_modes(complex_modes(s, 6), complex_modes(twice, 6));
  const CVec force = CVec::Ones(s.size());
  const auto q = DynamicStiffness(s).solve(300.0, 200.0, force);
  const auto expected = DynamicStiffness(twice).solve(300.0, 400.0, force);
  ASSERT_TRUE(q && expected);
  EXPECT_LE((*q - *expected).norm(), rounding * expected->norm());
}

// Every shaft is reduced by itself, so that the reduced equations hold at other ratios, too.
TEST(EquationsOfMotion, AReducedSystemKeepsItsShaftsApart) {
  System s = rotor_that_damps(400.0);
  s.spin_parts.push_back({0.5, 3.0 * s.spin_parts[0].G, 2.0 * s.spin_parts[0].H});
  const Mat Phi = Mat::Identity(s.size(), 4);
  ReducedSystem r = in_shapes(s, Phi);
  ASSERT_EQ(r.spin_parts.size(), 2u);
  EXPECT_EQ(r.spin_parts[1].ratio, 0.5);
  EXPECT_EQ(r.G(), 2.5 * Mat(s.spin_parts[0].G).topLeftCorner(4, 4));
  EXPECT_EQ(r.H(), 2.0 * Mat(s.spin_parts[0].H).topLeftCorner(4, 4));
  r.spin_parts[1].ratio = s.spin_parts[1].ratio = -0.25;
  EXPECT_EQ(r.D(), Mat(s.D()).topLeftCorner(4, 4));
  EXPECT_EQ(r.stiffness(), Mat(s.stiffness()).topLeftCorner(4, 4));
}

// ---- angular acceleration -----------------------------------------------------------------------

/// Fourth-order difference of a function of time.
template <class Function>
auto rate(const Function& f, double t) {
  constexpr double h = 1e-3;
  return ((8.0 * (f(t + h) - f(t - h)) - (f(t + 2.0 * h) - f(t - 2.0 * h))) / (12.0 * h)).eval();
}

/// A rigid disk that is turned by an angle and then tilted, by finite rotations.
struct TurningDisk {
  double Id, Ip;
  std::function<Vec2(double t)> tilt;     ///< theta_x, theta_y
  std::function<double(double t)> angle;  ///< of spin

  Eigen::Matrix3d rotation(double t) const {
    const Vec2 theta = tilt(t);
    const Eigen::Vector3d about(theta(0), theta(1), 0.0);
    return Eigen::AngleAxisd(about.norm(), about.normalized()).toRotationMatrix() *
           Eigen::AngleAxisd(angle(t), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  }
  Eigen::Vector3d momentum(double t) const {
    const Eigen::Matrix3d R = rotation(t);
    const Eigen::Matrix3d W = rate([&](double s) { return rotation(s); }, t) * R.transpose();
    const Eigen::Vector3d inertia(Id, Id, Ip);
    return R * inertia.asDiagonal() * R.transpose() * Eigen::Vector3d(W(2, 1), W(0, 2), W(1, 0));
  }
  /// Moment about x and y beside a drive whose torque halves the angle of the axis at rest and the
  /// tilted one.
  Vec2 moment(double t) const {
    const Eigen::Vector3d whole = rate([&](double s) { return momentum(s); }, t);
    const Eigen::Vector3d halfway = Eigen::Vector3d::UnitZ() + rotation(t).col(2);
    return (whole - whole(2) / halfway(2) * halfway).head<2>();
  }
};

// Linear equations with angular acceleration beside Euler's, for small tilts.
TEST(EquationsOfMotion, AngularAccelerationIsThatOfADiskOnAHomokineticJoint) {
  constexpr double small = 1e-4;  // tilt: its square is left out
  const double Omega = 3.0, acceleration = 40.0, t = 0.3;
  const Disk disk{.m = 1.0, .Id = 0.5, .Ip = 0.9};
  const auto tilt = [](double s) {
    return Vec2(small * std::cos(2.0 * s), small * (0.3 + std::sin(5.0 * s)));
  };
  const TurningDisk turning{disk.Id, disk.Ip, tilt, [=](double s) {
                              return Omega * (s - t) + 0.5 * acceleration * (s - t) * (s - t);
                            }};

  const auto e = matrices(disk);
  EquationsOfMotion<Mat> equations{e.M, e.C, e.K, {{1.0, e.G, e.H}}, Omega};
  const auto at_nodes = [](const Vec2& theta) { return Vec{{0.0, 0.0, theta(0), theta(1)}}; };
  const auto rate_of_tilt = [&](double s) { return rate(tilt, s); };
  const auto moment = [&] {
    return Vec(equations.M * at_nodes(rate(rate_of_tilt, t)) +
               equations.D() * at_nodes(rate_of_tilt(t)) +
               acceleration * equations.acceleration_stiffness() * at_nodes(tilt(t)));
  };
  const Vec2 expected = turning.moment(t);
  EXPECT_LE((moment().tail(2) - expected).norm(), 1e-6 * expected.norm());
  equations.spin_parts[0].ratio = 0.0;  // the term is not small
  EXPECT_GE((moment().tail(2) - expected).norm(), 0.1 * expected.norm());
}

// As the other matrices it is a sum over shafts, and is reduced with them.
TEST(EquationsOfMotion, AngularAccelerationGoesWithEachShaft) {
  System s = rotor_that_damps(400.0);
  s.spin_parts.push_back({-2.0, s.spin_parts[0].G, s.spin_parts[0].H});
  const Mat G = s.spin_parts[0].G;
  EXPECT_EQ(Mat(s.acceleration_stiffness()), -0.5 * G);
  const ReducedSystem r = in_shapes(s, Mat::Identity(s.size(), 4));
  EXPECT_EQ(r.acceleration_stiffness(), -0.5 * G.topLeftCorner(4, 4));
}

TEST(EquationsOfMotion, CirculateWhereSomethingThatRotatesDamps) {
  System s = rotor_that_damps(400.0);
  const Mat Phi = Mat::Identity(s.size(), 4);
  EXPECT_TRUE(in_shapes(s, Phi).circulates());
  s.spin_parts[0].H = Sparse(s.size(), s.size());
  EXPECT_FALSE(s.circulates());
  EXPECT_FALSE(in_shapes(s, Phi).circulates());
  s.spin_parts.clear();
  EXPECT_FALSE(s.circulates());
  EXPECT_EQ(s.G().nonZeros(), 0);
  EXPECT_EQ(Mat(s.D()), Mat(s.C));
}

}  // namespace whirl::equations_of_motion_test
