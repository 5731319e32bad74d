// Coefficients of bearings over speed, and the matrices they make.

#include <gtest/gtest.h>

#include "libfe/mesh/elements/connection.hpp"
#include "libfe/parts/bearings.hpp"
#include "libfe/parts/bearings/table.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::table_bearing_test {

constexpr double rounding = 1e-9;  // relative 1e-15 of the coefficients below

BearingCoefficients row(double scale) {
  BearingCoefficients c;
  c.K << 4e6, 1e5, -2e5, 3e6;
  c.C << 5e3, 1e2, 1e2, 4e3;
  c.Kt << 2e3, 10.0, -10.0, 1e3;
  c.Ct << 3.0, 0.1, -0.1, 2.0;
  c.M << 2.0, 0.3, -0.3, 1.0;
  c.M *= 2.0 + scale;
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
  EXPECT_TRUE(a.M.isApprox(b.M, 1e-14));
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

// ---- over the whirl frequency ----

TEST(TableBearing, OverTheWhirlFrequencyAloneTheSpeedDoesNotMatter) {
  const TableBearing t{{.speed = {}, .rows = {row(1.0), row(3.0)}, .whirl = {50.0, 150.0}}};
  EXPECT_FALSE(t.depends_on_speed());
  EXPECT_TRUE(t.depends_on_whirl());
  EXPECT_TRUE(t.speeds().empty());
  for (const double Omega : {0.0, 80.0, 1e4}) {
    expect_same(t.at(Omega, 0.0), row(1.0));
    EXPECT_NEAR(t.at(Omega, 75.0).K(0, 0), 0.75 * row(1.0).K(0, 0) + 0.25 * row(3.0).K(0, 0),
                rounding);
    expect_same(t.at(Omega, 1e4), row(3.0));
  }
}

/// Two rows at the first speed, three at the second, at other frequencies.
CoefficientTable grid() {
  return {.speed = {100.0, 100.0, 300.0, 300.0, 300.0},
          .rows = {row(1.0), row(2.0), row(4.0), row(3.0), row(6.0)},
          .whirl = {10.0, 50.0, 0.0, 40.0, 80.0}};
}

// Over the frequency at both speeds around, then over the speed.
TEST(TableBearing, OverBothIsLinearInEither) {
  const CoefficientTable t = grid();
  const auto k = [](double scale) { return row(scale).K(0, 1); };
  const double low = 0.5 * k(1.0) + 0.5 * k(2.0);     // at 30 rad/s
  const double high = 0.25 * k(4.0) + 0.75 * k(3.0);  // likewise
  EXPECT_NEAR(t.at(100.0, 30.0).K(0, 1), low, rounding);
  EXPECT_NEAR(t.at(300.0, 30.0).K(0, 1), high, rounding);
  EXPECT_NEAR(t.at(150.0, 30.0).K(0, 1), 0.75 * low + 0.25 * high, rounding);
  EXPECT_NEAR(t.at(150.0, 30.0).M(1, 0),
              0.75 * (0.5 * row(1.0).M(1, 0) + 0.5 * row(2.0).M(1, 0)) +
                  0.25 * (0.25 * row(4.0).M(1, 0) + 0.75 * row(3.0).M(1, 0)),
              rounding);
}

TEST(TableBearing, OverBothIsConstantBeyondEveryEnd) {
  const CoefficientTable t = grid();
  expect_same(t.at(0.0, 0.0), row(1.0));
  expect_same(t.at(0.0, 1e3), row(2.0));
  expect_same(t.at(1e3, 1e3), row(6.0));
  EXPECT_NEAR(t.at(200.0, 1e3).C(0, 0), 0.5 * row(2.0).C(0, 0) + 0.5 * row(6.0).C(0, 0), rounding);
}

// By hand from values of SciPy: PchipInterpolator over the frequency, then over the speed.
TEST(TableBearing, PchipGoesOverBothLikewise) {
  CoefficientTable t;
  const double y[3][3] = {{4.0, 1.0, 2.0}, {6.0, 5.0, 2.0}, {4.0, 4.5, 4.0}};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      t.speed.push_back(std::vector{100.0, 200.0, 400.0}[static_cast<std::size_t>(i)]);
      t.whirl.push_back(std::vector{10.0, 20.0, 50.0}[static_cast<std::size_t>(j)]);
      BearingCoefficients c;
      c.K(1, 1) = y[i][j];
      t.rows.push_back(c);
    }
  }
  constexpr double digits = 1e-13;  // of those given
  EXPECT_NEAR(t.at(100.0, 12.0, Interpolation::pchip).K(1, 1), 3.1973333333333334, digits);
  EXPECT_NEAR(t.at(170.0, 12.0, Interpolation::pchip).K(1, 1), 5.4739059999999995, digits);
  EXPECT_NEAR(t.at(399.0, 44.0, Interpolation::pchip).K(1, 1), 4.237542071854604, digits);
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
  const Eigen::Matrix<double, 8, 1> f = -e.K * q, g = -e.C * q, h = -e.M * q;
  const Eigen::Vector4d stretch = q.head<4>() - q.tail<4>();
  EXPECT_TRUE(f.head<2>().isApprox(-c.K * stretch.head<2>(), 1e-14));
  EXPECT_TRUE(f.segment<2>(2).isApprox(-c.Kt * stretch.tail<2>(), 1e-14));
  EXPECT_TRUE(g.head<2>().isApprox(-c.C * stretch.head<2>(), 1e-14));
  EXPECT_TRUE(g.segment<2>(2).isApprox(-c.Ct * stretch.tail<2>(), 1e-14));
  EXPECT_TRUE(h.head<2>().isApprox(-c.M * stretch.head<2>(), 1e-14));
  EXPECT_TRUE(h.segment<2>(2).isZero(0.0));
  EXPECT_TRUE(f.head<4>().isApprox(-f.tail<4>(), 1e-14));
  EXPECT_TRUE(h.head<4>().isApprox(-h.tail<4>(), 1e-14));
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

// The matrices of a motion have the coefficients of its frequency; unbalance has the speed's.
TEST(TableBearing, AssemblesTheCoefficientsOfTheFrequency) {
  Structure s{.bodies = {{.name = "mass", .m = 1.0}}};
  s.bearings = {test::bearing(test::body("mass"), AnyBearing(TableBearing{grid()}))};
  const Assembler assembler(s);
  EXPECT_TRUE(assembler.depends_on_whirl());
  for (const double omega : {0.0, 30.0, 70.0}) {
    const BearingCoefficients c = grid().at(150.0, omega);
    EXPECT_TRUE(Mat(assembler.at(150.0, omega).K).isApprox(c.K, 1e-14)) << omega;
    EXPECT_TRUE(Mat(assembler.at(150.0, omega).C).isApprox(c.C, 1e-14)) << omega;
    EXPECT_TRUE(Mat(assembler.at(150.0, omega).M).isApprox(Mat2::Identity() + c.M, 1e-14));
  }
  EXPECT_EQ(Mat(assembler.at(150.0).K), Mat(assembler.at(150.0, 150.0).K));
  EXPECT_FALSE(Assembler({.bodies = s.bodies,
                          .bearings = {test::bearing(test::body("mass"), AnyBearing(table))}})
                   .depends_on_whirl());
}

// Added mass is inertia, not weight; a body of this mass has both.
TEST(AddedMass, MovesAsABodysMassAndHasNoWeight) {
  BearingCoefficients c = test::isotropic(1e5, 10.0);
  Structure lumped{.bodies = {{.name = "mass", .m = 5.0}}, .gravity = 9.81};
  lumped.bearings = {test::bearing(test::body("mass"), c)};
  Structure added = lumped;
  added.bodies[0].m = 3.0;
  c.M = 2.0 * Mat2::Identity();
  added.bearings = {test::bearing(test::body("mass"), c)};
  const Assembler a(lumped), b(added);
  EXPECT_EQ(Mat(a.at(50.0).M), Mat(b.at(50.0).M));
  EXPECT_DOUBLE_EQ(a.gravity_load()(1), -5.0 * 9.81);
  EXPECT_DOUBLE_EQ(b.gravity_load()(1), -3.0 * 9.81);
}

// Rayleigh damping b K takes the stiffness of the speed, too, of which the symmetric part is
// conservative.
TEST(TableBearing, RayleighDampingFollowsItsStiffness) {
  Structure s{.bodies = {{.name = "mass", .m = 1.0}},
              .bearings = {test::bearing(test::body("mass"), AnyBearing(table))}};
  s.damping.stiffness = 1e-3;
  for (const double Omega : {0.0, 275.0}) {
    const Mat2 K = table.table.at(Omega).K;
    const Mat2 C = table.table.at(Omega).C + 1e-3 * 0.5 * (K + K.transpose());
    EXPECT_TRUE(Mat(assemble(s, Omega).C).isApprox(C, 1e-14)) << Omega;
  }
}

}  // namespace whirl::table_bearing_test
