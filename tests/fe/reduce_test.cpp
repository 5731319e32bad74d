// Reduction to few shapes: what it keeps, how far it is off, and that it knows.

#include "libfe/analyses/reduction_error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libbase/numerics/dense.hpp"
#include "libfe/analyses/modes.hpp"
#include "libfe/eigen/quadratic.hpp"
#include "libfe/mesh/elements/disk.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::reduce_test {

using test::at;
using test::node;
using test::rpm;

constexpr double rounding = 1e-9;  // relative; projections of a stiffness conditioned to 1e7

/// Two disks of 300 mm on a shaft of 20 mm, in bearings of 4 MN/m and 5 kN.s/m at its ends.
Structure damped_rotor() {
  Segment shaft = test::cylinder(0.6, 0.02, 12);
  shaft.material = test::steel(7800.0);
  Structure s{.shaft = {shaft}};
  for (const int n : {4, 9}) {
    Disk disk{.at = node(n), .outer_diameter = 0.3, .inner_diameter = 0.02, .width = 0.01};
    set_inertia_from_shape(disk, 7800.0);
    s.disks.push_back(disk);
  }
  s.bearings = {test::bearing(node(1), test::isotropic(4e6, 5e3)),
                test::bearing(node(13), test::isotropic(4e6, 5e3))};
  return s;
}

/// Rows of x and y at nodes numbered from 1.
std::vector<Vec> rows(const System& s, const std::vector<int>& nodes) {
  std::vector<Vec> all;
  for (const int n : nodes) {
    all.push_back(s.dofs.row({Point::Kind::node, n - 1}, X));
    all.push_back(s.dofs.row({Point::Kind::node, n - 1}, Y));
  }
  return all;
}

/// Eigenvalues with Im > 0 of a reduced system, ascending frequency.
std::vector<Complex> eigenvalues(const ReducedSystem& r) {
  const QuadraticModes modes = dense_quadratic_modes(Mat(r.M).sparseView(), Mat(r.D()).sparseView(),
                                                     Mat(r.K).sparseView(), -1.0);
  std::vector<Complex> all;
  for (const Complex lambda : modes.lambda) {
    if (lambda.imag() > 0.0) all.push_back(lambda);
  }
  std::sort(all.begin(), all.end(), [](Complex a, Complex b) { return a.imag() < b.imag(); });
  return all;
}

std::vector<Complex> eigenvalues(const System& s, int count) {
  std::vector<Complex> all;
  for (const Mode& mode : complex_modes(s, count).oscillatory) all.push_back(mode.lambda);
  return all;
}

double distance(const std::vector<Complex>& all, Complex lambda) {
  double nearest = 1e300;
  for (const Complex other : all) nearest = std::min(nearest, std::abs(other - lambda));
  return nearest / std::abs(lambda);
}

// ---- what is kept -------------------------------------------------------------------------------

// Phi^T M Phi = I, Phi^T K_s Phi is diagonal, and all is Phi^T A Phi.
TEST(Reduce, ShapesAreOrthonormalInMassAndStiffness) {
  const System s = assemble(damped_rotor(), 5000.0 * rpm);
  const auto ports = rows(s, {7}), dampers = rows(s, {1, 13});
  for (const ReductionMethod method :
       {ReductionMethod::modal, ReductionMethod::modal_residual, ReductionMethod::damped}) {
    SCOPED_TRACE(name_of(method));
    const ReducedSystem r = reduce(s, {.method = method, .modes = 8}, ports, dampers);
    const int expected = method == ReductionMethod::modal_residual ? 8 + 6 : 8;
    ASSERT_EQ(r.size(), expected);
    EXPECT_EQ(r.Omega, s.Omega);
    EXPECT_EQ(r.dofs.size(), s.size());
    const Mat unit = Mat::Identity(expected, expected);
    EXPECT_LT((r.M - unit).cwiseAbs().maxCoeff(), rounding);
    EXPECT_LT((r.Phi.transpose() * (s.M * r.Phi) - unit).cwiseAbs().maxCoeff(), rounding);
    Mat off_diagonal = r.K;
    off_diagonal.diagonal().setZero();
    EXPECT_LT(off_diagonal.cwiseAbs().maxCoeff(), rounding * r.K.diagonal().maxCoeff());
    EXPECT_TRUE(r.C.isApprox(r.Phi.transpose() * (s.C * r.Phi), rounding));
    EXPECT_TRUE(r.G().isApprox(r.Phi.transpose() * (s.G() * r.Phi), rounding));
    EXPECT_TRUE(r.D().isApprox(r.C + s.Omega * r.G(), rounding));
    for (Eigen::Index j = 0; j < r.Phi.cols(); ++j) {
      EXPECT_GE(r.Phi.col(j).maxCoeff(), -r.Phi.col(j).minCoeff());  // largest entry positive
    }
  }
}

// The largest entry is positive where entries are small, too, as in shapes of heavy bodies.
TEST(Reduce, ShapesOfHeavyBodiesHaveAPositiveLargestEntry) {
  Structure bodies{.bodies = {{.name = "a", .m = 4e4}, {.name = "b", .m = 9e4}},
                   .bearings = {test::bearing(test::body("a"), test::orthotropic(1e9, 2e9))},
                   .links = {test::bearing(test::body("a"), test::isotropic(5e8))}};
  bodies.links[0].to = test::body("b");
  const System s = assemble(bodies, 0.0);
  const ReducedSystem r = reduce(s, {.method = ReductionMethod::modal, .modes = 3}, {}, {});
  ASSERT_EQ(r.size(), 3);
  for (const auto& shape : r.Phi.colwise()) {
    EXPECT_LT(shape.cwiseAbs().maxCoeff(), 0.01);
    EXPECT_EQ(shape.maxCoeff(), shape.cwiseAbs().maxCoeff());
  }
}

// Undamped and at rest, the modes kept are exact.
TEST(Reduce, ModalIsExactForTheModesOfTheRotorAtRest) {
  const System s = assemble(test::two_disk(test::orthotropic(1e6, 2e6), 2), 0.0);
  const auto kept = eigenvalues(reduce(s, {.method = ReductionMethod::modal, .modes = 6}, {}, {}));
  const auto exact = eigenvalues(s, 6);
  ASSERT_EQ(kept.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(kept[i].imag(), exact[i].imag(), rounding * exact[i].imag());
  }
}

// K_s^-1 r is in the basis: the static deflection under a load at a port is exact.
TEST(Reduce, StaticShapesMakeTheDeflectionOfThePortsExact) {
  const System s = assemble(damped_rotor(), 0.0);
  const auto ports = rows(s, {7});
  const auto dampers = rows(s, {1, 13});
  const ReducedSystem with =
      reduce(s, {.method = ReductionMethod::modal_residual, .modes = 4}, ports, dampers);
  const ReducedSystem without =
      reduce(s, {.method = ReductionMethod::modal, .modes = 4}, ports, dampers);
  const DenseLu<Mat> full{Mat(s.K)};
  std::vector<Vec> all = ports;
  all.insert(all.end(), dampers.begin(), dampers.end());
  for (const Vec& row : all) {
    const double exact = row.dot(Vec(full.solve(row)));
    const auto flexibility = [&](const ReducedSystem& r) -> double {
      const Vec small = r.Phi.transpose() * row;
      return small.dot(Vec(DenseLu<Mat>(r.K).solve(small)));
    };
    EXPECT_NEAR(flexibility(with), exact, rounding * exact);
    EXPECT_LT(flexibility(without), (1.0 - 1e-3) * exact);  // modes alone are too stiff
  }
}

// "none" keeps every freedom, and so does any method with as many modes as dofs.
TEST(Reduce, NoneIsTheSystemItself) {
  const System s = assemble(test::two_disk(test::isotropic(1e6, 500.0)), 300.0);
  ReductionError error;
  const ReducedSystem r = reduce(s, {.method = ReductionMethod::none}, {}, {}, &error);
  EXPECT_EQ(r.Phi, Mat(Mat::Identity(s.size(), s.size())));
  EXPECT_EQ(r.M, Mat(s.M));
  EXPECT_EQ(r.C, Mat(s.C));
  EXPECT_EQ(r.G(), Mat(s.G()));
  EXPECT_EQ(r.K, Mat(s.K));
  EXPECT_EQ(error.eigenvalue(), 0.0);
  EXPECT_TRUE(error.within_tolerance);
  EXPECT_EQ(reduce(s, {.method = ReductionMethod::modal, .modes = 100}, {}, {}).size(), s.size());
}

// Up to 12 dofs are not worth reducing.
TEST(Reduce, AutomaticKeepsSmallSystemsWhole) {
  const System small = assemble(test::Jeffcott{}.structure(), 100.0);
  EXPECT_EQ(reduce(small, {}, {}, {}).Phi, Mat(Mat::Identity(2, 2)));
  const System large = assemble(damped_rotor(), 100.0);
  EXPECT_LT(reduce(large, {}, rows(large, {7}), rows(large, {1, 13})).size(), large.size());
}

// ---- how far off --------------------------------------------------------------------------------

// The second forward mode at 7250 rpm: 6884 rpm. Eight modes at rest do not know what the dampers
// do and put it at 6725 rpm; with the static shapes of the bearings it is right, and eight real
// coordinates from the damped modes are exact for the four modes they are made of.
TEST(Reduce, TheSecondForwardModeOfADampedRotorNeedsTheShapesOfItsDampers) {
  constexpr double known = 0.5;  // [rpm], digits of the two figures
  const System s = assemble(damped_rotor(), 7250.0 * rpm);
  const auto dampers = rows(s, {1, 13});
  const auto exact = eigenvalues(s, 6);
  const Mode second_forward = complex_modes(s, 6).oscillatory[3];
  EXPECT_EQ(second_forward.whirl, Whirl::forward);
  EXPECT_NEAR(second_forward.frequency() / rpm, 6884.0, known);

  const auto with = [&](ReductionMethod method) {
    return eigenvalues(reduce(s, {.method = method, .modes = 8}, {}, dampers));
  };
  const auto modal = with(ReductionMethod::modal);
  const Complex nearest = *std::min_element(modal.begin(), modal.end(), [&](Complex a, Complex b) {
    return std::abs(a - exact[3]) < std::abs(b - exact[3]);
  });
  EXPECT_NEAR(nearest.imag() / rpm, 6725.0, known);

  const auto residual = with(ReductionMethod::modal_residual);
  for (const Complex lambda : exact) EXPECT_LT(distance(residual, lambda), 1e-4) << lambda;

  const auto damped = with(ReductionMethod::damped);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT(distance(damped, exact[i]), 1e-9) << exact[i];
  EXPECT_GT(distance(damped, exact[4]), 1e-3);  // and for no others
}

// ---- that it knows ------------------------------------------------------------------------------

// The error reported is the error found by hand.
TEST(ReductionError, IsTheDistanceOfTheEigenvaluesInTheBand) {
  const System s = assemble(damped_rotor(), 7250.0 * rpm);
  const double band = 10000.0 * rpm;
  ReductionError error;
  const ReducedSystem r = reduce(s, {.method = ReductionMethod::modal, .modes = 8, .band = band},
                                 rows(s, {7}), {}, &error);
  const auto exact = eigenvalues(s, 6), reduced = eigenvalues(r);  // six are below 10 000 rpm
  ASSERT_EQ(error.pairs.size(), 6u);
  EXPECT_EQ(error.band, band);
  double largest = 0.0;
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_LT(std::abs(error.pairs[i].full - exact[i]), rounding * std::abs(exact[i]));
    EXPECT_NEAR(error.pairs[i].error(), distance(reduced, exact[i]), rounding);
    largest = std::max(largest, distance(reduced, exact[i]));
  }
  EXPECT_NEAR(error.eigenvalue(), largest, rounding);
  EXPECT_GT(error.eigenvalue(), 1e-2);
  EXPECT_GT(error.receptance, 1e-3);
  EXPECT_FALSE(error.within_tolerance);
}

// Where the number of modes is left open, every eigenvalue of the band is met to the tolerance, for
// all methods, and a finer tolerance takes more shapes.
TEST(Reduce, AutomaticNumberOfModesMeetsTheTolerance) {
  const System s = assemble(damped_rotor(), 7250.0 * rpm);
  const auto ports = rows(s, {7}), dampers = rows(s, {1, 13});
  const double band = 25000.0 * rpm;
  const auto exact = eigenvalues(s, 8);
  ASSERT_LT(exact[7].imag(), band);
  for (const ReductionMethod method :
       {ReductionMethod::modal, ReductionMethod::modal_residual, ReductionMethod::damped}) {
    int coarser = 0;
    for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
      SCOPED_TRACE(std::string(name_of(method)) + " to " + std::to_string(tolerance));
      ReductionError error;
      const ReducedSystem r = reduce(s, {.method = method, .tolerance = tolerance, .band = band},
                                     ports, dampers, &error);
      EXPECT_TRUE(error.within_tolerance);
      EXPECT_LE(error.receptance, tolerance);
      for (const Complex lambda : exact) {
        EXPECT_LE(distance(eigenvalues(r), lambda), tolerance) << lambda;
      }
      EXPECT_LT(r.size(), s.size());
      EXPECT_GE(r.size(), coarser);
      coarser = r.size();
    }
  }
}

// The band may hold more modes than the first guess of the basis: all of them count.
TEST(Reduce, AutomaticNumberOfModesCoversTheWholeBand) {
  const System s = assemble(test::two_disk(test::isotropic(1e6), 2), 0.0);
  for (const double band : {200.0, 1000.0, 3000.0, 6000.0}) {
    ReductionError error;
    const ReducedSystem r =
        reduce(s, {.method = ReductionMethod::modal, .band = band}, {}, {}, &error);
    std::size_t within = 0;
    for (const Complex lambda : eigenvalues(s, 60)) {
      if (lambda.imag() > band) break;
      ++within;
      EXPECT_LT(distance(eigenvalues(r), lambda), 1e-3) << lambda << ", band " << band;
    }
    EXPECT_EQ(error.pairs.size(), within);
    EXPECT_GE(r.size(), static_cast<int>(within));
  }
}

// Left out, the band is twice the spin.
TEST(Reduce, BandIsTwiceTheSpin) {
  const System s = assemble(damped_rotor(), 3000.0 * rpm);
  ReductionError error;
  reduce(s, {.method = ReductionMethod::modal}, {}, {}, &error);
  EXPECT_DOUBLE_EQ(error.band, 6000.0 * rpm);
}

// ---- free rotors --------------------------------------------------------------------------------

// A free shaft keeps its rigid motions and its first flexible modes; static shapes of a free body
// leave the rigid motions aside. Few modes are no excuse.
TEST(Reduce, FreeRotorsKeepTheirRigidMotions) {
  const Structure shaft{.shaft = {test::cylinder(1.0, 0.05, 10)}};
  const System s = assemble(shaft, 0.0);
  Mat rigid = Mat::Zero(s.size(), 4);
  for (int n = 0; n < s.dofs.nodes; ++n) {
    rigid.block<4, 4>(4 * n, 0).setIdentity();
    rigid(4 * n + Y, THETA_X) = -0.1 * n;
    rigid(4 * n + X, THETA_Y) = +0.1 * n;
  }
  for (const ReductionMethod method :
       {ReductionMethod::modal, ReductionMethod::modal_residual, ReductionMethod::damped}) {
    SCOPED_TRACE(name_of(method));
    ReductionError error;
    const ReducedSystem r = reduce(s, {.method = method}, rows(s, {6}), {}, &error);
    EXPECT_TRUE(error.within_tolerance);
    EXPECT_GT(error.pairs.size(), 0u);
    EXPECT_LT(r.size(), s.size());
    const Mat left = rigid - r.Phi * (r.Phi.transpose() * (s.M * rigid));
    EXPECT_LT(left.cwiseAbs().maxCoeff(), 1e-6);
  }
}

// K + s M with s from the first flexible frequency: the residual shape of a free shaft is finite
// even where all modes asked for are rigid.
TEST(Reduce, StaticShapesOfFreeRotorsWithOnlyRigidModesAreSound) {
  const System s = assemble({.shaft = {test::cylinder(1.0, 0.05, 10)}}, 0.0);
  for (const int modes : {2, 4}) {
    const ReducedSystem r =
        reduce(s, {.method = ReductionMethod::modal_residual, .modes = modes}, rows(s, {6}), {});
    EXPECT_EQ(r.size(), modes + 2);
    // the added shapes bend as the first flexible mode does, more or less
    const double first = eigenvalues(s, 1)[0].imag(), found = std::sqrt(r.K.diagonal().maxCoeff());
    EXPECT_LT(found, 2.0 * first);
    EXPECT_GT(found, 0.1 * first);
  }
}

// Bodies that nothing holds, K = 0: every method gives a basis.
TEST(Reduce, FreeBodiesAloneAreReducible) {
  const System s = assemble({.bodies = {{.name = "a", .m = 1.0}, {.name = "b", .m = 2.0}}}, 0.0);
  const std::vector<Vec> ports{s.dofs.row({Point::Kind::body, 0}, X)};
  for (const ReductionMethod method : {ReductionMethod::automatic, ReductionMethod::modal,
                                       ReductionMethod::modal_residual, ReductionMethod::damped}) {
    const ReducedSystem r = reduce(s, {.method = method}, ports, {});
    EXPECT_EQ(r.size(), 4) << static_cast<int>(method);
    EXPECT_TRUE(r.K.isZero(0.0));
  }
}

// ---- wrong use ----------------------------------------------------------------------------------

// A joint without mass between a spring and a damper cannot be integrated as it stands.
TEST(Reduce, RefusesFreedomsWithoutInertia) {
  const Structure structure{
      .bodies = {{.name = "mass", .m = 2.0}, {.name = "joint"}},
      .bearings = {test::bearing(test::body("mass"), test::isotropic(1e5)),
                   test::bearing(test::body("joint"), test::isotropic(0.0, 100.0))},
      .links = {test::connect(test::body("mass"), test::body("joint"), test::isotropic(1e5))}};
  EXPECT_THROW(reduce(assemble(structure, 0.0), {}, {}, {}), NumericalError);
}

// Nothing oscillates: there are no damped modes to reduce to.
TEST(Reduce, DampedNeedsModesThatOscillate) {
  const Structure structure{
      .bodies = {{.name = "mass", .m = 1.0}},
      .bearings = {test::bearing(test::body("mass"), test::isotropic(1.0, 10.0))}};
  EXPECT_THROW(
      reduce(assemble(structure, 0.0), {.method = ReductionMethod::damped, .modes = 1}, {}, {}),
      NumericalError);
}

}  // namespace whirl::reduce_test
