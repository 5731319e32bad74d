// Damped gyroscopic eigenproblems: Arnoldi against the dense solver and closed forms.

#include "libfe/eigen/quadratic.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/eigen/disc.hpp"
#include "libfe/eigen/energy_bounds.hpp"
#include "libfe/eigen/refine.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::quadratic_test {

using test::at;

constexpr double oracle = 1e-8;     // relative; Arnoldi to 1e-10, QR loses some of a wide spectrum
constexpr double backward = 1e-10;  // normwise backward error that is promised of modes
constexpr double loosest = 1.05;    // a bound is 2 % beyond Lanczos' residual
// of a disc: 1e-10 of the inverse's residual, which counts for more far from the center
constexpr double unrefined = 1e-8;

std::vector<Complex> ordered(const CVec& lambda) {
  std::vector<Complex> all(lambda.begin(), lambda.end());
  std::sort(all.begin(), all.end(), [](Complex a, Complex b) { return std::abs(a) < std::abs(b); });
  return all;
}

Complex nearest(const std::vector<Complex>& all, Complex lambda) {
  return *std::min_element(all.begin(), all.end(), [&](Complex a, Complex b) {
    return std::abs(a - lambda) < std::abs(b - lambda);
  });
}

/// |(lambda^2 M + lambda D + K) q|, against the sizes of its three parts.
double residual(const System& s, Complex lambda, const CVec& q) {
  const CVec inertia = lambda * lambda * (s.M * q), damping = lambda * (s.D() * q),
             elastic = s.K * q;
  return (inertia + damping + elastic).norm() / (inertia.norm() + damping.norm() + elastic.norm());
}

/// A disc about a center on the real axis with at least so many pairs; of these, that with Im > 0.
QuadraticModes lowest(const System& s, int pairs, double center = 0.0) {
  const auto wanted = [&](double, std::span<const Complex> lambda, double) {
    const auto found =
        std::count_if(lambda.begin(), lambda.end(), [](Complex l) { return l.imag() > 0.0; });
    return std::optional(found >= pairs ? 0.0 : std::numeric_limits<double>::infinity());
  };
  const DiscModes disc = DiscSolver(s.M, s.D(), s.K).around(center, wanted);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < disc.lambda.size(); ++i) {
    if (disc.lambda(i).imag() >= 0.0) kept.push_back(i);
  }
  return {disc.lambda(kept), disc.q(Eigen::all, kept)};
}

/// Every eigenvalue that Arnoldi should find is there, as often as the oracle has it.
void expect_lowest(const System& s, int pairs) {
  const QuadraticModes sparse = lowest(s, pairs);
  const auto exact = ordered(dense_quadratic_modes(s.M, s.D(), s.K).lambda);
  const auto found = ordered(sparse.lambda);
  EXPECT_GE(std::count_if(found.begin(), found.end(), [](Complex l) { return l.imag() > 0.0; }),
            pairs);
  // the last may be one of a pair that was cut; those before it come in the same order
  std::vector<Complex> left = exact;
  for (const Complex lambda : found) {
    const auto match = std::min_element(left.begin(), left.end(), [&](Complex a, Complex b) {
      return std::abs(a - lambda) < std::abs(b - lambda);
    });
    EXPECT_LT(std::abs(*match - lambda), oracle * std::abs(lambda)) << lambda;
    left.erase(match);
  }
  // nothing that is nearer to zero than the last one found is missing
  const double reach = std::abs(found[found.size() - 1]) * (1.0 - oracle);
  for (const Complex lambda : left) EXPECT_GE(std::abs(lambda), reach) << "missing " << lambda;
  for (Eigen::Index i = 0; i < sparse.lambda.size(); ++i) {
    EXPECT_LT(residual(s, sparse.lambda(i), sparse.q.col(i)), 1e-6) << sparse.lambda(i);
    EXPECT_NEAR(sparse.q.col(i).norm(), 1.0, 1e-12);
  }
}

// ---- sparse against dense -----------------------------------------------------------------------

TEST(QuadraticModes, DampedGyroscopicRotorsAgreeWithTheDenseSolver) {
  std::mt19937 random(5);
  for (int draw = 0; draw < 6; ++draw) {
    SCOPED_TRACE("draw " + std::to_string(draw));
    const Structure rotor = test::random_rotor(
        random, {.elements = 15 + 2 * draw, .is_isotropic = draw % 2 == 0, .damping = 0.05 * draw});
    expect_lowest(assemble(rotor, 200.0 * draw), 6 + draw);
  }
}

// At rest an isotropic rotor has every eigenvalue twice: both copies must be found.
TEST(QuadraticModes, EveryDoubleEigenvalueOfAnIsotropicRotorAtRestIsFoundTwice) {
  for (const int elements : {2, 4, 6}) {
    for (const double c : {0.0, 500.0}) {
      SCOPED_TRACE(std::to_string(elements) + " elements a sixth, damping " + std::to_string(c));
      const System s = assemble(test::two_disk(test::isotropic(1e6, c), elements), 0.0);
      for (const int pairs : {3, 4, 7, 8}) expect_lowest(s, pairs);
    }
  }
}

// Oil-film bearings: K is not symmetric, and one mode may be unstable.
TEST(QuadraticModes, CrossCoupledBearingsAgreeWithTheDenseSolver) {
  BearingCoefficients oil;
  oil.K << 5e6, 8e6, -6e6, 9e6;
  oil.C << 3e4, -1e4, -1e4, 6e4;
  expect_lowest(assemble(test::two_disk(oil, 4), 600.0), 8);
}

// ---- discs and bounds ---------------------------------------------------------------------------

// Every dense eigenvalue in a disc is in it, as often: pairs of an isotropic rotor at rest too, and
// four alike of twin bodies.
TEST(Discs, HoldEveryEigenvalueAsOftenAsTheDenseSolver) {
  for (const double Omega : {0.0, 300.0}) {
    Structure rotor = test::two_disk(test::isotropic(1e6, 1e5), 2);
    for (const char* name : {"twin", "other twin"}) {
      rotor.bodies.push_back({.name = name, .m = 5.0});
      rotor.bearings.push_back(test::bearing(test::body(name), test::isotropic(2e5, 50.0)));
    }
    const System s = assemble(rotor, Omega);
    const CVec exact = dense_quadratic_modes(s.M, s.D(), s.K).lambda;
    for (const Complex center : {Complex(0.0), Complex(-50.0, 250.0), Complex(-400.0, 100.0)}) {
      const DiscModes disc = DiscSolver(s.M, s.D(), s.K).around(center, 300.0, 1000);
      ASSERT_GE(disc.radius, 300.0);
      for (const Complex lambda : exact) {
        if (std::abs(lambda - center) > 300.0) continue;
        const auto alike = [&](const CVec& all) {
          return ((all.array() - lambda).abs() < oracle * std::abs(lambda)).count();
        };
        EXPECT_EQ(alike(disc.lambda), alike(exact)) << lambda << " around " << center;
      }
      const Sparse D = s.D();
      Refinement refinement(s.M, D, s.K);
      for (Eigen::Index i = 0; i < disc.lambda.size(); ++i) {
        Complex lambda = disc.lambda(i);
        CVec q = disc.q.col(i);
        EXPECT_LT(refinement.backward_error(lambda, q), unrefined) << lambda;
        refinement.improve(lambda, q, 1e-3 * std::abs(lambda));
        EXPECT_LT(refinement.backward_error(lambda, q), backward) << lambda;
        EXPECT_LT(std::abs(lambda - disc.lambda(i)), oracle * std::abs(lambda)) << lambda;
      }
    }
  }
}

// No eigenvalue is where the energies say that none can be.
TEST(EnergyBounds, LeaveOutNoEigenvalue) {
  for (const double cross : {0.0, 4e5}) {
    for (const double c : {0.0, 1e2, 1e5}) {
      BearingCoefficients b = test::isotropic(1e6, c);
      b.K(0, 1) = cross;
      b.K(1, 0) = -cross;
      Structure rotor = test::two_disk(b, 2);
      rotor.damping = {.mass = 1.0, .stiffness = 1e-5};
      const System s = assemble(rotor, 500.0);
      const EnergyBounds bounds = energy_bounds(s.D(), s.K);
      ASSERT_TRUE(bounds.are_known);
      EXPECT_EQ(bounds.skew > 0.0, cross != 0.0);
      for (const Complex l : dense_quadratic_modes(s.M, s.D(), s.K).lambda) {
        const double size = std::abs(l.real());
        EXPECT_TRUE(bounds.allow(l.real() < 0.0 ? -1 : 1, size, size, l.imag())) << l;
      }
      // they are of use: a slow mode does not decay at once, as c / k (50^2 + 10^2) + 0.4 * 10 < 50
      EXPECT_EQ(bounds.allow(-1, 50.0, 50.0, 10.0), c > 1e4) << c;
      // closed forms: the stiff shaft on its bearings has k_xy / k; damping is at least theirs
      EXPECT_GE(bounds.skew, cross / 1e6 * (1.0 - oracle));
      EXPECT_LE(bounds.skew, cross / 1e6 * loosest);
      EXPECT_GE(bounds.most_damping, c / 1e6 * (1.0 - oracle));
    }
  }
}

// ---- closed forms -------------------------------------------------------------------------------

// One freedom: lambda = -zeta w +- i w sqrt(1 - zeta^2), and two real ones for zeta > 1.
TEST(QuadraticModes, OneFreedomHasItsClosedForms) {
  constexpr double rounding = 1e-10;  // relative; QR of a 2 x 2 matrix, cancellation for zeta = 3
  const double m = 2.0, k = 800.0, w = 20.0;
  Sparse M(1, 1), D(1, 1), K(1, 1);
  M.insert(0, 0) = m;
  K.insert(0, 0) = k;
  D.insert(0, 0) = 0.0;
  for (const double zeta : {-0.2, 0.0, 1e-6, 0.3, 0.9}) {
    D.coeffRef(0, 0) = 2.0 * zeta * m * w;
    const QuadraticModes modes = dense_quadratic_modes(M, D, K);
    ASSERT_EQ(modes.lambda.size(), 1);
    EXPECT_NEAR(modes.lambda(0).real(), -zeta * w, rounding * w);
    EXPECT_NEAR(modes.lambda(0).imag(), w * std::sqrt(1.0 - zeta * zeta), rounding * w);
  }
  D.coeffRef(0, 0) = 2.0 * 3.0 * m * w;
  const auto real = ordered(dense_quadratic_modes(M, D, K).lambda);
  ASSERT_EQ(real.size(), 2u);
  EXPECT_NEAR(real[0].real(), -w * (3.0 - std::sqrt(8.0)), rounding * w);
  EXPECT_NEAR(real[1].real(), -w * (3.0 + std::sqrt(8.0)), rounding * w);
  EXPECT_EQ(real[0].imag(), 0.0);
}

// A shift moves no eigenvalue.
TEST(QuadraticModes, AnyShiftGivesTheSameEigenvalues) {
  const System s = assemble(test::two_disk(test::isotropic(1e6, 2e3)), 400.0);
  const auto unshifted = ordered(dense_quadratic_modes(s.M, s.D(), s.K).lambda);
  const auto dense = ordered(dense_quadratic_modes(s.M, s.D(), s.K, -30.0).lambda);
  const auto sparse = ordered(lowest(s, 6, -30.0).lambda);
  for (std::size_t i = 0; i < 6; ++i) {
    const double size = std::abs(unshifted[i]);
    EXPECT_LT(std::abs(nearest(dense, unshifted[i]) - unshifted[i]), oracle * size);
    EXPECT_LT(std::abs(nearest(sparse, unshifted[i]) - unshifted[i]), oracle * size);
  }
}

// Rayleigh damping C = a M + b K at rest: Re lambda = -(a + b omega^2) / 2 for every mode. With
// a damping ratio of 1e-6 in 2000 states the sign of Re is the verdict on stability.
TEST(QuadraticModes, TinyDampingKeepsItsSignInTwoThousandStates) {
  constexpr double share = 1e-2;  // of the real part, which is 1e-6 of the eigenvalue
  Structure rotor = test::two_disk(test::isotropic(1e6), 42);
  const System undamped = assemble(rotor, 0.0);
  EXPECT_GT(2 * undamped.size(), 2000);
  for (const double sign : {+1.0, -1.0}) {
    const double zeta = sign * 1e-6, first = 86.0, a = zeta * first, b = zeta / first;
    System damped = undamped;
    damped.C = a * undamped.M + b * undamped.K;
    const QuadraticModes modes = lowest(damped, 8);
    for (const Complex lambda : modes.lambda) {
      const double exact = -0.5 * (a + b * std::norm(lambda));
      EXPECT_NEAR(lambda.real(), exact, share * std::abs(exact)) << lambda;
    }
  }
}

// Overdamped dofs beside oscillating ones: bearings of 1e6 N.s/m creep.
TEST(QuadraticModes, RealEigenvaluesAreFoundAmongThePairs) {
  const System s = assemble(test::two_disk(test::isotropic(1e6, 1e6), 4), 400.0);
  const QuadraticModes modes = lowest(s, 6);
  EXPECT_GE((modes.lambda.imag().array() > 0.0).count(), 6);
  const auto is_creeping = [](Complex l) { return std::abs(l.imag()) < 0.2 * std::abs(l.real()); };
  // both bearings creep along x and y: lambda = -k / c = -1 where the rotor does not hold them
  const auto exact = ordered(dense_quadratic_modes(s.M, s.D(), s.K).lambda);
  int creeping = 0;
  for (const Complex lambda : exact) {
    if (!is_creeping(lambda) || std::abs(lambda) > 10.0) continue;
    ++creeping;
    const auto found = ordered(modes.lambda);
    EXPECT_LT(std::abs(nearest(found, lambda) - lambda), oracle * std::abs(lambda));
  }
  EXPECT_GE(creeping, 2);
}

// Twelve real eigenvalues nearer to zero than the rotor's: the number of pairs is kept.
TEST(QuadraticModes, RealEigenvaluesDoNotCountAsPairs) {
  Structure rotor = test::two_disk(test::isotropic(1e6), 4);
  for (int i = 0; i < 3; ++i) {
    const std::string name = "creeping " + std::to_string(i);
    rotor.bodies.push_back({.name = name, .m = 5.0});
    rotor.bearings.push_back(test::bearing(test::body(name), test::isotropic(2.0 + i, 100.0)));
  }
  const System s = assemble(rotor, 300.0);
  for (const int pairs : {1, 3, 6}) expect_lowest(s, pairs);
}

// M singular: a mass m on a spring k1 and a damper without mass. One real root of first order,
// lambda = -k / c, no infinite ones.
TEST(QuadraticModes, AFreedomWithoutInertiaHasOneRealRootAndNoInfiniteOnes) {
  constexpr double rounding = 1e-12;
  Sparse M(2, 2), D(2, 2), K(2, 2);
  M.insert(0, 0) = 2.0;
  K.insert(0, 0) = 800.0;
  K.insert(1, 1) = 300.0;
  D.insert(1, 1) = 15.0;
  const auto lambda = ordered(dense_quadratic_modes(M, D, K).lambda);
  ASSERT_EQ(lambda.size(), 2u);
  EXPECT_LT(std::abs(lambda[0] - Complex(0.0, 20.0)), rounding * 20.0);
  EXPECT_LT(std::abs(lambda[1] - Complex(-20.0, 0.0)), rounding * 20.0);
}

// Both solvers on a long rotor whose left bearing stands on a joint without mass.
TEST(QuadraticModes, ASingularMassMatrixAgreesWithTheDenseSolver) {
  Structure s = test::two_disk(test::isotropic(1e6, 500.0), 4);
  s.bodies = {{.name = "joint"}};
  s.bearings[0].to = test::body("joint");
  s.bearings.push_back(test::bearing(test::body("joint"), test::isotropic(2e6, 3e4)));
  const System system = assemble(s, 300.0);
  ASSERT_EQ(system.dofs.condensed, 0);
  ASSERT_EQ((system.M.diagonal().array() == 0.0).count(), 2);
  expect_lowest(system, 8);
}

TEST(QuadraticModes, EigenvectorsOfTheDenseSolverSolveTheProblem) {
  std::mt19937 random(6);
  const System s = assemble(test::random_rotor(random, {.elements = 8, .damping = 0.2}), 500.0);
  const QuadraticModes modes = dense_quadratic_modes(s.M, s.D(), s.K);
  const auto all = ordered(modes.lambda);
  for (Eigen::Index i = 0; i < modes.lambda.size(); ++i) {
    if (std::abs(modes.lambda(i)) > std::abs(all[12])) continue;  // the lowest are resolved best
    EXPECT_LT(residual(s, modes.lambda(i), modes.q.col(i)), 1e-8);
  }
}

// A rotor, one of two thousand random ones, for which Eigen's real QR iteration goes in circles: it
// is computed by complex shifts.
TEST(QuadraticModes, TheDenseSolverTakesComplexShiftsWhereRealOnesGoInCircles) {
  std::mt19937 random(11);
  random.discard(121698);
  Structure rotor = test::random_rotor(random, {.elements = 32, .damping = 0.0088440483298717152});
  rotor.damping = {.mass = 2.1181675167938092, .stiffness = 0.00057315741691693265};
  const System s = assemble(rotor, 871.14203249175762);
  const QuadraticModes modes = dense_quadratic_modes(s.M, s.D(), s.K);
  const auto all = ordered(modes.lambda);
  ASSERT_GT(all.size(), 12u);
  for (Eigen::Index i = 0; i < modes.lambda.size(); ++i) {
    if (std::abs(modes.lambda(i)) > std::abs(all[12])) continue;
    EXPECT_LT(residual(s, modes.lambda(i), modes.q.col(i)), 1e-8);
  }
  expect_lowest(s, 4);
}

}  // namespace whirl::quadratic_test
