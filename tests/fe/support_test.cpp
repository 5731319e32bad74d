// Supports with states, as state spaces, transfer functions, poles and residues.

#include "libfe/parts/support.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/analyses/connection_forces.hpp"
#include "libfe/analyses/modes.hpp"
#include "libfe/analyses/reduce.hpp"
#include "libfe/analyses/reduction_error.hpp"
#include "libfe/analyses/static.hpp"
#include "libfe/assembly/assemble.hpp"
#include "libfe/eigen/dynamic_stiffness.hpp"
#include "libfe/mesh/elements/state_coordinates.hpp"
#include "libfe/parts/transfer_function.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::support_test {

constexpr Complex i{0.0, 1.0};

/// Random numbers of a fixed seed.
Mat random_matrix(std::mt19937& random, Eigen::Index rows, Eigen::Index cols) {
  std::normal_distribution<double> normal;
  return Mat::NullaryExpr(rows, cols, [&] { return normal(random); });
}

/// What a law is in coordinates, at a frequency.
CMat stiffness_at(const StateCoordinates& c, Complex s) {
  const CMat Z = s * s * CMat::Identity(c.size(), c.size()) + s * c.C_w.cast<Complex>() +
                 c.K_w.cast<Complex>();
  const CMat in = c.B_0.cast<Complex>() + s * c.B_1.cast<Complex>();
  const CMat out = c.C_0.cast<Complex>() + s * c.C_1.cast<Complex>();
  return c.D.cast<Complex>() + out * Z.partialPivLu().solve(in);
}

/// Largest distance of a law from what its coordinates make of it, relative.
double misfit(const StateSpace& law) {
  const StateCoordinates c = state_coordinates(law);
  double worst = 0.0;
  for (const Complex s : {0.3 + 0.0 * i, 2.0 * i, -0.1 + 50.0 * i, 1e4 * i}) {
    const CMat expected = law.stiffness_at(s), found = stiffness_at(c, s);
    worst = std::max(worst, (found - expected).norm() / expected.norm());
  }
  return worst;
}

TEST(StateCoordinates, AreTheSameLaw) {
  std::mt19937 random(7);
  for (const int n : {0, 1, 2, 3, 6, 9}) {
    const StateSpace law{random_matrix(random, n, n), random_matrix(random, n, 2),
                         random_matrix(random, 3, n), random_matrix(random, 3, 2)};
    EXPECT_LT(misfit(law), 1e-11) << n;
  }
}

TEST(StateCoordinates, OfPolesThatAreTheSame) {
  const Mat B = Mat::Ones(3, 1), C = Mat::Ones(1, 3), D = Mat::Zero(1, 1);
  Mat defective = Mat::Zero(3, 3);
  defective << -2.0, 1.0, 0.0, 0.0, -2.0, 1.0, 0.0, 0.0, -2.0;
  EXPECT_LT(misfit({defective, B, C, D}), 1e-11);
  EXPECT_LT(misfit({-2.0 * Mat::Identity(3, 3), B, C, D}), 1e-11);
  Mat integrators = Mat::Zero(3, 3);
  integrators(0, 1) = integrators(1, 2) = 1.0;
  EXPECT_LT(misfit({integrators, B, C, D}), 1e-11);
}

TEST(StateCoordinates, PairStates) {
  const Mat B = Mat::Ones(4, 1), C = Mat::Ones(1, 4), D = Mat::Zero(1, 1);
  const StateCoordinates four =
      state_coordinates({Vec::LinSpaced(4, -4.0, -1.0).asDiagonal().toDenseMatrix(), B, C, D});
  EXPECT_EQ(four.size(), 2);
  EXPECT_FALSE(four.idle[0] || four.idle[1]);
  const StateCoordinates one =
      state_coordinates({Mat::Constant(1, 1, -5.0), Mat::Ones(1, 1), Mat::Ones(1, 1), D});
  ASSERT_EQ(one.size(), 1);
  EXPECT_EQ(*one.idle[0], -10.0);
  // the second state has a zero of the output for its eigenvalue
  EXPECT_NEAR(one.C_0(0, 0) - 10.0 * one.C_1(0, 0), 0.0, 1e-14);
}

TEST(TransferFunctions, AreDynamicStiffnesses) {
  // a mass on a spring and damper, seen at the mass: F / U
  const TransferFunction stiffness{{4.0, 500.0, 4e6}, {1.0}};
  const auto at = [](const TransferFunction& f, Complex s) {
    return state_space(f).stiffness_at(s)(0, 0);
  };
  const Complex s = 3.0 + 700.0 * i, expected = 4.0 * s * s + 500.0 * s + 4e6;
  EXPECT_LT(std::abs(at(stiffness, s) - expected), 1e-14 * std::abs(expected));
  for (const auto& [form, function] :
       {std::pair(TransferForm::receptance, TransferFunction{{1.0}, {4.0, 500.0, 4e6}}),
        std::pair(TransferForm::mobility, TransferFunction{{1.0, 0.0}, {4.0, 500.0, 4e6}}),
        std::pair(TransferForm::impedance, TransferFunction{{4.0, 500.0, 4e6}, {1.0, 0.0}}),
        std::pair(TransferForm::dynamic_stiffness, stiffness)}) {
    const Complex found = at(dynamic_stiffness_of(function, form), s);
    EXPECT_LT(std::abs(found - expected), 1e-14 * std::abs(expected)) << name_of(form);
  }
  const TransferFunction high{{2.0, 3.0, 5.0, 7.0, 1e9}, {1e-3, 2.0, 4e3}};
  const Complex numerator = (((2.0 * s + 3.0) * s + 5.0) * s + 7.0) * s + 1e9;
  const Complex ratio = numerator / ((1e-3 * s + 2.0) * s + 4e3);
  EXPECT_LT(std::abs(at(high, s) - ratio), 1e-13 * std::abs(ratio));
}

TEST(TransferFunctions, ThatNoSupportHasAreRefused) {
  EXPECT_THROW(state_space(TransferFunction{{1.0, 0.0, 0.0, 0.0}, {1.0}}), NumericalError);
  EXPECT_THROW(state_space(TransferFunction{{1.0}, {0.0, 0.0}}), NumericalError);
  EXPECT_THROW(state_space(TransferFunction{{1.0}, {1.0, std::nan("")}}), NumericalError);
}

TEST(PolesAndResidues, OfMatrices) {
  const Complex p{-3.0, 40.0};
  CMat R(2, 2);
  R << 1.0 + 2.0 * i, 3.0 - i, 0.5 * i, 4.0;
  const CMat q = (CMat(2, 2) << 2.0, 1.0, -1.0, 3.0).finished();
  const Mat D = Mat::Identity(2, 2);
  const StateSpace law = state_space({{p, R}, {Complex(-7.0), q}}, D);
  EXPECT_EQ(law.states(), 6);
  const Complex s = 0.7 + 33.0 * i;
  const CMat expected =
      D.cast<Complex>() + R / (s - p) + R.conjugate() / (s - std::conj(p)) + q / (s + 7.0);
  EXPECT_LT((law.stiffness_at(s) - expected).norm(), 1e-13 * expected.norm());
}

// ---- a pedestal ---------------------------------------------------------------------------------

constexpr double mp = 4.0, kp = 4e6, cp = 500.0, kb = 1e6;

/// Its dynamic stiffness, kb - kb^2 / (mp s^2 + cp s + kp + kb).
TransferFunction pedestal() {
  return {{kb * mp, kb * cp, kb * kp}, {mp, cp, kp + kb}};
}

/// The law of both directions between a station and the ground.
Support support(const Station& at, const StateSpace& law) {
  const std::vector<InterfaceCoordinate> both{{.at = at, .x = 1.0, .y = 0.0},
                                              {.at = at, .x = 0.0, .y = 1.0}};
  return {.name = "pedestal", .sees = both, .acts_on = both, .law = law.repeated(2)};
}

Structure jeffcott() {
  Structure s;
  s.bodies = {{.name = "disk", .m = 10.0, .spins = true}};
  return s;
}

/// The same on a pedestal that is a body.
Structure on_body(Structure s, const Station& journal) {
  s.bodies.push_back({.name = "pedestal", .m = mp});
  s.links.push_back(test::connect(journal, test::body("pedestal"), test::isotropic(kb)));
  s.links.back().name = "bearing";
  s.bearings.push_back(test::bearing(test::body("pedestal"), test::isotropic(kp, cp)));
  return s;
}

Structure on_states(Structure s, const Station& journal) {
  s.supports.push_back(support(journal, state_space(pedestal())));
  return s;
}

// acceptance: eigenvalues of 10 kg on the pedestal, by an assembly of its own
TEST(Supports, PedestalHasTheEigenvaluesOfItsBody) {
  const Modes found = complex_modes(assemble(on_states(jeffcott(), test::body("disk")), 0.0), 4);
  ASSERT_EQ(found.oscillatory.size(), 4u);
  EXPECT_TRUE(found.overdamped.empty());
  for (std::size_t k = 0; k < 4; ++k) {
    const Complex expected =
        k < 2 ? Complex(-1.11777498, 280.48856036) : Complex(-61.38222502, 1125.73651201);
    EXPECT_LT(std::abs(found.oscillatory[k].lambda - expected), 1e-8);
  }
  const Modes body = complex_modes(assemble(on_body(jeffcott(), test::body("disk")), 0.0), 4);
  for (std::size_t k = 0; k < 4; ++k) {
    const Complex expected = body.oscillatory[k].lambda;
    EXPECT_LT(std::abs(found.oscillatory[k].lambda - expected), 1e-12 * std::abs(expected));
  }
}

// acceptance: poles and residues of the same pedestal
TEST(Supports, PedestalByPolesAndResidues) {
  const Complex pole{-62.5, 1116.28569372}, residue{0.0, 111978502.19117};
  const StateSpace law =
      state_space({{pole, CMat::Constant(1, 1, residue)}}, Mat::Constant(1, 1, kb));
  const CMat exact = state_space(pedestal()).stiffness_at(300.0 * i);
  EXPECT_LT((law.stiffness_at(300.0 * i) - exact).norm(), 1e-9 * exact.norm());
  Structure s = jeffcott();
  s.supports.push_back(support(test::body("disk"), law));
  const Modes found = complex_modes(assemble(s, 0.0), 1);
  EXPECT_LT(std::abs(found.oscillatory[0].lambda - Complex(-1.11777498, 280.48856036)), 1e-7);
}

/// A shaft with a disk, held on the right by a bearing, on the left by nothing yet.
Structure shaft() {
  Structure s;
  s.shaft = {test::cylinder(1.2, 0.06, 24)};
  s.disks = {{.name = "wheel", .at = test::at(0.5), .m = 30.0, .Id = 0.4, .Ip = 0.7}};
  s.bearings = {test::bearing(test::at(1.2), test::isotropic(2e7, 1e3))};
  return s;
}

TEST(Supports, PedestalUnderAShaftHasTheModesOfItsBody) {
  for (const double Omega : {0.0, 400.0}) {
    const Modes found = complex_modes(assemble(on_states(shaft(), test::at(0.0)), Omega), 10);
    const Modes body = complex_modes(assemble(on_body(shaft(), test::at(0.0)), Omega), 10);
    ASSERT_EQ(found.oscillatory.size(), 10u);
    for (std::size_t k = 0; k < 10; ++k) {
      const Complex expected = body.oscillatory[k].lambda;
      EXPECT_LT(std::abs(found.oscillatory[k].lambda - expected), 1e-12 * std::abs(expected)) << k;
    }
  }
}

TEST(Supports, StaticEquilibriumIsThatOfTheStiffnessAtRest) {
  Structure s = on_states(shaft(), test::at(0.0));
  s.gravity = 9.81;
  Structure springs = shaft();
  springs.gravity = 9.81;
  const double series = kb * kp / (kb + kp);
  springs.bearings.push_back(test::bearing(test::at(0.0), test::isotropic(series)));
  const Assembler assembler(s), plain(springs);
  const Vec found = static_equilibrium(assembler, 0.0).displacement;
  const Vec expected = static_equilibrium(plain, 0.0).displacement;
  EXPECT_LT((found.head(expected.size()) - expected).norm(), 1e-11 * expected.norm());
  // the last of what carries is the pedestal, which bears what its springs do
  const Vec2 load = static_equilibrium(assembler, 0.0).bearings.back().force;
  EXPECT_LT((load - static_equilibrium(plain, 0.0).bearings.back().force).norm(),
            1e-10 * load.norm());
}

TEST(Supports, ForceOnAPedestalIsThatOfItsSpring) {
  const Assembler states(on_states(shaft(), test::at(0.0))), body(on_body(shaft(), test::at(0.0)));
  const Vec load = Vec::Unit(states.dofs().full_size, 40),
            of_body = load.head(body.dofs().full_size);
  const auto force = [](const Assembler& assembler, const Vec& load_, const char* name) {
    const double w = 700.0, Omega = 200.0;
    const System system = assembler.uncondensed(Omega);
    const CVec q =
        DynamicStiffness(system).solve(w, Omega, assembler.dofs().T.transpose() * load_).value();
    const CVec all = ConnectionForces(assembler, Omega, w).at(w, assembler.dofs().T * q, load_);
    const auto parts = carrying_parts(assembler);
    const auto at = std::ranges::find(parts, name, &CarryingPart::name) - parts.begin();
    return CVec(all.segment<2>(2 * at));
  };
  const CVec found = force(states, load, "pedestal"), expected = force(body, of_body, "bearing");
  EXPECT_LT((found - expected).norm(), 1e-11 * expected.norm());
}

/// Coordinates that a rotor is reduced to, with contact in the middle.
ReducedSystem reduced(const Structure& structure, ReductionMethod method, ReductionError& error) {
  const Assembler assembler(structure);
  const System system = assembler.at(300.0);
  const Point middle = assembler.point(test::at(0.5));
  return reduce(system, {.method = method, .tolerance = 1e-4, .band = 1200.0},
                {system.dofs.row(middle, X), system.dofs.row(middle, Y)}, {}, &error);
}

TEST(Supports, ReductionKeepsTheirStates) {
  for (const ReductionMethod method : {ReductionMethod::modal_residual, ReductionMethod::damped}) {
    ReductionError error, of_body;
    const ReducedSystem found = reduced(on_states(shaft(), test::at(0.0)), method, error);
    const ReducedSystem body = reduced(on_body(shaft(), test::at(0.0)), method, of_body);
    EXPECT_TRUE(error.within_tolerance) << name_of(method);
    EXPECT_LE(found.size(), body.size() + 4)
        << name_of(method);  // a state of x and y, and its push
    EXPECT_LT((found.M - Mat::Identity(found.size(), found.size())).norm(), 1e-10);
  }
}

TEST(Supports, AreNeitherHeavyNorDampedWithTheRotor) {
  Structure s = on_states(jeffcott(), test::body("disk"));
  s.gravity = 9.81;
  s.damping = {.mass = 3.0, .stiffness = 1e-4};
  const Assembler assembler(s);
  EXPECT_NEAR(assembler.gravity_load().sum(), -98.1, 1e-12);
  const System damped = assembler.at(0.0);
  s.damping = {};
  const System plain = Assembler(s).at(0.0);
  Mat expected = Mat::Zero(4, 4);
  expected(0, 0) = expected(1, 1) =
      30.0;  // 3 / s times 10 kg; the disk has no stiffness of its own
  EXPECT_LT((Mat(damped.C) - Mat(plain.C) - expected).norm(), 1e-12);
}

TEST(Supports, ModalDampingIsThatOfTheRotorOnThemAtRest) {
  Structure s = on_states(jeffcott(), test::body("disk"));
  s.modal_damping = {.ratios = {0.02, 0.02}};
  const System damped = assemble(s, 0.0);
  const double k = kb * kp / (kb + kp);
  EXPECT_NEAR(damped.C.coeff(0, 0), 2.0 * 0.02 * std::sqrt(k * 10.0), 1e-9);
}

// ---- controllers --------------------------------------------------------------------------------

constexpr double m = 10.0, ks = 1e6, ki = 200.0;

/// A body on a magnetic bearing: negative stiffness, and a controller.
Structure levitated(const StateSpace& controller) {
  Structure s = jeffcott();
  s.bearings = {test::bearing(test::body("disk"), test::isotropic(-ks))};
  s.supports.push_back(support(test::body("disk"), controller));
  return s;
}

// acceptance: proportional-derivative control is a spring and a damper
TEST(Supports, ProportionalDerivativeControl) {
  const double P = 1e4, D = 20.0;
  const StateSpace law = state_space(TransferFunction{{ki * D, ki * P}, {1.0}});
  const Modes found = complex_modes(assemble(levitated(law), 0.0), 2);
  ASSERT_EQ(found.oscillatory.size(), 2u);
  const Complex expected{-200.0, 244.94897427831781};
  EXPECT_LT(std::abs(found.oscillatory[0].lambda - expected), 1e-12 * std::abs(expected));
}

// acceptance: an amplifier of first order, 2000 rad/s
TEST(Supports, AmplifierHasOneStateAndNoOtherPole) {
  const double P = 1e4, D = 20.0, w = 2000.0;
  const StateSpace law = state_space(TransferFunction{{ki * D * w, ki * P * w}, {1.0, w}});
  ASSERT_EQ(law.states(), 1);
  const Modes found = complex_modes(assemble(levitated(law), 0.0), 2);
  ASSERT_EQ(found.oscillatory.size(), 2u);
  for (const Mode& mode : found.oscillatory) {
    EXPECT_LT(std::abs(mode.lambda - Complex(-175.46915025, 300.81832902)), 1e-7);
  }
  ASSERT_EQ(found.overdamped.size(), 2u);
  for (const Complex pole : found.overdamped) EXPECT_NEAR(pole.real(), -1649.0616995, 1e-6);
}

TEST(Supports, IntegratorBringsTheRotorBack) {
  const double P = 1e4, D = 20.0, I = 1e5;
  const StateSpace law = state_space(TransferFunction{{ki * D, ki * P, ki * I}, {1.0, 0.0}});
  Structure s = levitated(law);
  s.gravity = 9.81;
  const Assembler assembler(s);
  EXPECT_LT(static_equilibrium(assembler, 0.0).displacement.head(2).norm(), 1e-18);
  // m s^3 + ki D s^2 + (ki P - ks) s + ki I
  const Modes found = complex_modes(assembler.at(0.0), 2);
  const auto at = [&](Complex l) { return ((m * l + ki * D) * l + (ki * P - ks)) * l + ki * I; };
  ASSERT_EQ(found.overdamped.size(), 2u);
  EXPECT_LT(std::abs(at(found.overdamped[0])), 1e-8 * ki * I);
  EXPECT_LT(std::abs(at(found.oscillatory[0].lambda)), 1e-8 * ki * I);
}

TEST(Supports, IntegratorsThatNothingMovesAreARootAtZero) {
  Structure s = jeffcott();
  s.bearings = {test::bearing(test::body("disk"), test::isotropic(1e6))};
  s.supports.push_back(
      support(test::body("disk"), state_space(TransferFunction{{0.0}, {1.0, 0.0}})));
  const Modes found = complex_modes(assemble(s, 0.0), 4);
  ASSERT_EQ(found.oscillatory.size(), 2u);
  EXPECT_NEAR(found.oscillatory[0].frequency(), std::sqrt(1e5), 1e-9);
  ASSERT_EQ(found.overdamped.size(), 2u);
  EXPECT_NEAR(std::abs(found.overdamped[0]), 0.0, 1e-9);
}

TEST(Supports, MayActElsewhereThanTheySee) {
  Structure s;
  s.bodies = {{.name = "a", .m = 2.0}, {.name = "b", .m = 3.0}};
  for (const char* name : {"a", "b"})
    s.bearings.push_back(test::bearing(test::body(name), test::isotropic(1e4)));
  s.supports = {{.name = "control",
                 .sees = {{.at = test::body("a"), .to = test::body("b"), .x = 0.6, .y = 0.8}},
                 .acts_on = {{.at = test::body("b"), .x = 0.0, .y = 1.0}},
                 .law = {Mat(0, 0), Mat(0, 1), Mat(1, 0), Mat::Constant(1, 1, 7.0), {}, {}}}};
  Mat expected = 1e4 * Mat::Identity(4, 4);
  expected.row(3) += 7.0 * (Vec(4) << 0.6, 0.8, -0.6, -0.8).finished().transpose();
  EXPECT_LT((Mat(assemble(s, 0.0).K) - expected).norm(), 1e-12);
}

}  // namespace whirl::support_test
