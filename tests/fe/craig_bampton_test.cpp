// Casings in the coordinates of their interface and few modes.

#include "libfe/analyses/craig_bampton.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <complex>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/analyses/modes.hpp"
#include "libfe/assembly/assemble.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::craig_bampton_test {

/// The law of as many coordinates.
Support support_of(const StructureMatrices<Mat>& reduced, std::size_t ports) {
  Support support;
  support.sees = support.acts_on = std::vector<InterfaceCoordinate>(ports);
  set_law(support, reduced);
  return support;
}

constexpr Complex i{0.0, 1.0};

/// Masses on a line between springs and dampers, held at the left end.
StructureMatrices<Sparse> chain_of(int n) {
  Mat M = Mat::Zero(n, n), C = Mat::Zero(n, n), K = Mat::Zero(n, n);
  for (int k = 0; k < n; ++k) {
    M(k, k) = 2.0 + 0.1 * k;
    const double spring = 1e6 * (1.0 + 0.03 * k), damper = 40.0 + k;
    for (auto& [A, value] : {std::pair<Mat&, double>(K, spring), {C, damper}}) {
      A(k, k) += value;
      if (k == 0) continue;
      A(k - 1, k - 1) += value;
      A(k, k - 1) -= value;
      A(k - 1, k) -= value;
    }
    if (k > 0) M(k, k - 1) = M(k - 1, k) = 0.3;
  }
  return {M.sparseView(), C.sparseView(), K.sparseView()};
}

/// Dynamic stiffness of coordinates, all others free.
CMat stiffness_of(const StructureMatrices<Sparse>& s, const std::vector<int>& at, Complex l) {
  const CMat Z =
      l * l * Mat(s.M).cast<Complex>() + l * Mat(s.C).cast<Complex>() + Mat(s.K).cast<Complex>();
  const CMat receptance = Z.inverse()(at, at);
  return receptance.inverse();
}

TEST(CraigBampton, WithAllModesIsTheStructure) {
  const StructureMatrices<Sparse> whole = chain_of(14);
  const std::vector<int> at{13, 4};
  const StateSpace law = support_of(craig_bampton(whole, at, 100), 2).law;
  EXPECT_EQ(law.states(), 24);
  for (const Complex s : {5.0 + 0.0 * i, 200.0 * i, -3.0 + 900.0 * i, 4000.0 * i}) {
    const CMat expected = stiffness_of(whole, at, s);
    EXPECT_LT((law.stiffness_at(s) - expected).norm(), 1e-11 * expected.norm()) << s;
  }
}

TEST(CraigBampton, MatricesStaySymmetric) {
  const Support support = support_of(craig_bampton(chain_of(30), {29, 10}, 6), 2);
  const StateCoordinates& c = *support.coordinates;
  EXPECT_EQ(c.B_0, Mat(-c.C_0.transpose()));
  EXPECT_EQ(c.B_1, Mat(-c.C_1.transpose()));
  EXPECT_LT((c.D - c.D.transpose()).norm(), 1e-12 * c.D.norm());
  EXPECT_LT((c.C_w - c.C_w.transpose()).norm(), 1e-12 * c.C_w.norm());
  // and are the law that its state space is
  const Complex s = -2.0 + 300.0 * i;
  const CMat Z = s * s * CMat::Identity(c.size(), c.size()) + s * c.C_w.cast<Complex>() +
                 c.K_w.cast<Complex>();
  const CMat in = c.B_0.cast<Complex>() + s * c.B_1.cast<Complex>();
  const CMat out = c.C_0.cast<Complex>() + s * c.C_1.cast<Complex>();
  const CMat found = c.D.cast<Complex>() + s * support.law.D_rate.cast<Complex>() +
                     s * s * support.law.D_inertia.cast<Complex>() + out * Z.inverse() * in;
  const CMat expected = support.law.stiffness_at(s);
  EXPECT_LT((found - expected).norm(), 1e-12 * expected.norm());
}

TEST(CraigBampton, ConvergesWithItsModes) {
  const StructureMatrices<Sparse> whole = chain_of(60);
  const std::vector<int> at{59};
  double before = 1.0;
  for (const int modes : {4, 8, 16}) {
    const StateSpace law = support_of(craig_bampton(whole, at, modes), 1).law;
    const Complex s = 60.0 * i;
    const CMat expected = stiffness_of(whole, at, s);
    const double error = (law.stiffness_at(s) - expected).norm() / expected.norm();
    EXPECT_LT(error, 0.2 * before) << modes;
    before = error;
  }
}

// Coordinates without inertia follow the others, as if they were condensed.
TEST(CraigBampton, TakesLumpedMasses) {
  StructureMatrices<Sparse> lumped = chain_of(12);
  Mat M = Mat::Zero(12, 12);
  for (int k = 0; k < 12; k += 2) M(k, k) = 3.0 + k;
  lumped.M = M.sparseView();
  lumped.C.resize(0, 0);
  const std::vector<int> at{10};
  const StateSpace law = support_of(craig_bampton(lumped, at, 100), 1).law;
  EXPECT_EQ(law.states(), 10);  // of the five inner masses
  for (const Complex s : {20.0 * i, 300.0 * i, -1.0 + 700.0 * i}) {
    const CMat Z = s * s * M.cast<Complex>() + Mat(lumped.K).cast<Complex>();
    const Complex expected = 1.0 / Z.inverse()(10, 10);
    EXPECT_LT(std::abs(law.stiffness_at(s)(0, 0) - expected), 1e-10 * std::abs(expected)) << s;
  }
}

TEST(CraigBampton, NeedsAStructureThatIsHeld) {
  StructureMatrices<Sparse> loose = chain_of(4);
  Mat K(loose.K);
  K.row(3).setZero();
  K.col(3).setZero();
  loose.K = K.sparseView();
  EXPECT_THROW(craig_bampton(loose, {0}, 3), NumericalError);
}

// A pedestal by its matrices: its mass, and the node that the bearing is at.
TEST(CraigBampton, PedestalHasTheEigenvaluesOfItsBody) {
  const double mp = 4.0, kp = 4e6, cp = 500.0, kb = 1e6;
  Mat M = Mat::Zero(2, 2), C = Mat::Zero(2, 2), K(2, 2);
  M(1, 1) = mp;
  C(1, 1) = cp;
  K << kb, -kb, -kb, kb + kp;
  Structure s;
  s.bodies = {{.name = "disk", .m = 10.0, .spins = true}};
  for (const double x : {1.0, 0.0}) {
    Support support{.name = "pedestal"};
    support.sees = support.acts_on = {{.at = test::body("disk"), .x = x, .y = 1.0 - x}};
    set_law(support, craig_bampton({M.sparseView(), C.sparseView(), K.sparseView()}, {0}, 1));
    EXPECT_EQ(support.law.states(), 2);
    s.supports.push_back(support);
  }
  const System system = assemble(s, 0.0);
  EXPECT_LT((Mat(system.K) - Mat(system.K).transpose()).norm(), 1e-12 * Mat(system.K).norm());
  const Modes found = complex_modes(system, 4);
  ASSERT_EQ(found.oscillatory.size(), 4u);
  EXPECT_LT(std::abs(found.oscillatory[0].lambda - Complex(-1.11777498, 280.48856036)), 1e-8);
  EXPECT_LT(std::abs(found.oscillatory[2].lambda - Complex(-61.38222502, 1125.73651201)), 1e-8);
}

}  // namespace whirl::craig_bampton_test
