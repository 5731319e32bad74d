// Coefficients of bearings over speed, and the matrices they make.

#include <gtest/gtest.h>

#include "libfe/bearings.hpp"
#include "libfe/bearings/table.hpp"
#include "libfe/elements/connection.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::table_bearing_test {

constexpr double rounding = 1e-9;  // relative 1e-15 of the coefficients below

BearingCoefficients row(double scale) {
  BearingCoefficients c;
  c.K << 4e6, 1e5, -2e5, 3e6;
  c.C << 5e3, 1e2, 1e2, 4e3;
  c.Kt << 2e3, 10.0, -10.0, 1e3;
  c.Ct << 3.0, 0.1, -0.1, 2.0;
  c.K *= scale;
  c.C *= scale * scale;
  c.Kt *= scale + 1.0;
  c.Ct *= 3.0 - scale;
  return c;
}

void expect_same(const BearingCoefficients& a, const BearingCoefficients& b) {
  EXPECT_TRUE(a.K.isApprox(b.K, 1e-14));
  EXPECT_TRUE(a.C.isApprox(b.C, 1e-14));
  EXPECT_TRUE(a.Kt.isApprox(b.Kt, 1e-14));
  EXPECT_TRUE(a.Ct.isApprox(b.Ct, 1e-14));
}

const TableBearing table{{.speed = {100.0, 200.0, 500.0}, .rows = {row(1.0), row(2.0), row(0.5)}}};

TEST(TableBearing, MeetsItsRows) {
  expect_same(table.table.at(100.0), row(1.0));
  expect_same(table.table.at(200.0), row(2.0));
  expect_same(table.table.at(500.0), row(0.5));
}

// c(Omega) = (1 - s) c_i + s c_{i+1},  s = (Omega - Omega_i) / (Omega_{i+1} - Omega_i)
TEST(TableBearing, IsLinearBetweenItsRowsInEveryCoefficient) {
  const BearingCoefficients a = row(2.0), b = row(0.5), c = table.table.at(275.0);  // s = 1/4
  EXPECT_NEAR(c.K(0, 1), 0.75 * a.K(0, 1) + 0.25 * b.K(0, 1), rounding);
  EXPECT_NEAR(c.K(1, 0), 0.75 * a.K(1, 0) + 0.25 * b.K(1, 0), rounding);
  EXPECT_NEAR(c.C(1, 1), 0.75 * a.C(1, 1) + 0.25 * b.C(1, 1), rounding);
  EXPECT_NEAR(c.Kt(0, 0), 0.75 * a.Kt(0, 0) + 0.25 * b.Kt(0, 0), rounding);
  EXPECT_NEAR(c.Ct(1, 0), 0.75 * a.Ct(1, 0) + 0.25 * b.Ct(1, 0), rounding);
}

TEST(TableBearing, IsConstantBeyondItsEnds) {
  expect_same(table.table.at(0.0), row(1.0));
  expect_same(table.table.at(1e6), row(0.5));
}

TEST(TableBearing, OneRowIsAConstantBearing) {
  const AnyBearing one = TableBearing{{.speed = {300.0}, .rows = {row(1.0)}}};
  const AnyBearing constant = constant_bearing(row(1.0));
  for (const double Omega : {0.0, 300.0, 1000.0}) {
    expect_same(coefficients(one, Omega), coefficients(constant, Omega));
  }
  EXPECT_TRUE(depends_on_speed(one));
  EXPECT_FALSE(depends_on_speed(constant));
}

// force on `from` = -K (u_from - u_to), moment = -Kt (t_from - t_to); action and reaction
TEST(Connection, PullsBothEndsTogetherWithOppositeForces) {
  const BearingCoefficients c = row(1.0);
  const auto e = matrices(c);
  Eigen::Matrix<double, 8, 1> q;
  q << 1e-3, 2e-3, 0.01, 0.02, -1e-3, 5e-4, 0.03, -0.01;
  const Eigen::Matrix<double, 8, 1> f = -e.K * q, g = -e.C * q;
  const Eigen::Vector4d stretch = q.head<4>() - q.tail<4>();
  EXPECT_TRUE(f.head<2>().isApprox(-c.K * stretch.head<2>(), 1e-14));
  EXPECT_TRUE(f.segment<2>(2).isApprox(-c.Kt * stretch.tail<2>(), 1e-14));
  EXPECT_TRUE(g.head<2>().isApprox(-c.C * stretch.head<2>(), 1e-14));
  EXPECT_TRUE(g.segment<2>(2).isApprox(-c.Ct * stretch.tail<2>(), 1e-14));
  EXPECT_TRUE(f.head<4>().isApprox(-f.tail<4>(), 1e-14));
}

// A rotor's matrices take the coefficients of its speed.
TEST(TableBearing, AssemblesTheCoefficientsOfTheSpeed) {
  Structure s{.bodies = {{.name = "mass", .m = 1.0}}};
  s.bearings = {test::bearing(test::body("mass"), AnyBearing(table))};
  const Assembler assembler(s);
  EXPECT_TRUE(assembler.depends_on_speed());
  for (const double Omega : {0.0, 150.0, 275.0, 600.0}) {
    EXPECT_TRUE(Mat(assembler.at(Omega).K).isApprox(table.table.at(Omega).K, 1e-14)) << Omega;
    EXPECT_TRUE(Mat(assembler.at(Omega).C).isApprox(table.table.at(Omega).C, 1e-14)) << Omega;
  }
}

// Rayleigh damping b K takes the stiffness of the speed, too.
TEST(TableBearing, RayleighDampingFollowsItsStiffness) {
  Structure s{.bodies = {{.name = "mass", .m = 1.0}},
              .bearings = {test::bearing(test::body("mass"), AnyBearing(table))}};
  s.damping.stiffness = 1e-3;
  for (const double Omega : {0.0, 275.0}) {
    const Mat2 C = table.table.at(Omega).C + 1e-3 * table.table.at(Omega).K;
    EXPECT_TRUE(Mat(assemble(s, Omega).C).isApprox(C, 1e-14)) << Omega;
  }
}

}  // namespace whirl::table_bearing_test
