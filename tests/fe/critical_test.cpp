// Critical speeds, undamped from the pencil and damped from the modes.

#include "libfe/analyses/critical.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/analyses/campbell.hpp"
#include "libfe/eigen/hermitian.hpp"
#include "libfe/eigen/quadratic.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::critical_test {

using test::at;

constexpr double solves = 1e-9;  // relative; a small pencil, and a condensed shaft

std::vector<double> speeds_of(const std::vector<Critical>& criticals, Whirl whirl) {
  std::vector<double> speeds;
  for (const Critical& c : criticals) {
    if (c.whirl == whirl) speeds.push_back(c.speed);
  }
  return speeds;
}

/// Positive roots w of (K11 - m w^2) (K22 - J w^2) = K12^2, ascending.
std::vector<double> roots(const Mat2& K, double m, double J) {
  // m J s^2 - (K11 J + K22 m) s + det K = 0 for s = w^2
  const double a = m * J, b = -(K(0, 0) * J + K(1, 1) * m), c = K.determinant();
  std::vector<double> w;
  for (const double sign : {-1.0, 1.0}) {
    const double s = (-b + sign * std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
    if (s > 0.0) w.push_back(std::sqrt(s));
  }
  std::sort(w.begin(), w.end());
  return w;
}

// ---- closed forms -------------------------------------------------------------------------------

// Overhung disk: (K11 - m w^2) (K22 - (Id - Ip) w^2) = K12^2 forward, Id + Ip backward.
// A disk with Ip > Id has one forward critical speed, one with Ip < Id has two.
TEST(CriticalSpeeds, OfAnOverhungDiskAreTheClosedForm) {
  for (const double Ip : {0.09, 0.02}) {
    const test::Overhung rotor{.Ip = Ip};
    const auto criticals = critical_speeds(Assembler(rotor.structure()), {});
    const auto forward = roots(rotor.K(), rotor.m, rotor.Id - Ip);
    const auto backward = roots(rotor.K(), rotor.m, rotor.Id + Ip);
    ASSERT_EQ(forward.size(), Ip > rotor.Id ? 1u : 2u);
    const auto found_forward = speeds_of(criticals, Whirl::forward);
    const auto found_backward = speeds_of(criticals, Whirl::backward);
    ASSERT_EQ(found_forward.size(), forward.size());
    ASSERT_EQ(found_backward.size(), 2u);
    EXPECT_EQ(criticals.size(), forward.size() + 2);
    for (std::size_t i = 0; i < forward.size(); ++i) {
      EXPECT_NEAR(found_forward[i], forward[i], solves * forward[i]);
    }
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(found_backward[i], backward[i], solves * backward[i]);
    }
  }
}

// Excitation n times per turn, w = n Omega: Id -+ Ip / n in the same formula, Omega = w / n.
TEST(CriticalSpeeds, OfHigherOrdersAreTheClosedForm) {
  const test::Overhung rotor;
  for (const double order : {0.5, 2.0, 3.0}) {
    const auto criticals =
        critical_speeds(Assembler(rotor.structure()), {.count = 4, .order = order});
    const auto forward = roots(rotor.K(), rotor.m, rotor.Id - rotor.Ip / order);
    const auto found = speeds_of(criticals, Whirl::forward);
    ASSERT_EQ(found.size(), forward.size()) << "order " << order;
    for (std::size_t i = 0; i < forward.size(); ++i) {
      EXPECT_NEAR(found[i], forward[i] / order, solves * found[i]) << "order " << order;
    }
  }
}

// Jeffcott rotor with damping: w_d = w sqrt(1 - zeta^2) is the damped critical speed, and there is
// none for zeta > 1.
TEST(CriticalSpeeds, DampedOnesOfAJeffcottRotorAreTheClosedForm) {
  const test::Jeffcott jeffcott;
  const double w = jeffcott.omega();
  for (const double zeta : {0.0, 1e-4, 0.1, 0.5, 1.5}) {
    Structure s = jeffcott.structure();
    const double c = 2.0 * zeta * std::sqrt(jeffcott.k() * jeffcott.m);
    s.bearings.push_back(test::bearing(test::node(2), test::isotropic(0.0, c)));
    const auto criticals = critical_speeds(Assembler(s), {});
    ASSERT_EQ(criticals.size(), 2u);
    for (const Critical& critical : criticals) {
      EXPECT_NEAR(critical.speed, w, solves * w);
      if (zeta > 1.0) {
        EXPECT_TRUE(std::isnan(critical.damped_speed));
      } else {
        EXPECT_NEAR(critical.damped_speed, w * std::sqrt(1.0 - zeta * zeta), solves * w);
      }
    }
  }
}

// ---- self-consistency ---------------------------------------------------------------------------

// At a critical speed a mode of the rotor that spins with it has its frequency and its shape.
TEST(CriticalSpeeds, AreFrequenciesOfTheRotorThatSpinsWithThem) {
  constexpr double eigensolvers = 1e-8;  // relative; Arnoldi to 1e-10 in hundreds of dofs
  std::mt19937 random(8);
  for (int draw = 0; draw < 6; ++draw) {
    SCOPED_TRACE("draw " + std::to_string(draw));
    const Assembler rotor(
        test::random_rotor(random, {.elements = draw < 3 ? 12 : 45}));  // dense, sparse
    for (const Critical& c : critical_speeds(rotor, {.count = 5})) {
      const System s = rotor.at(c.speed);
      const Modes modes = complex_modes(s, 10);
      double nearest = 1e300, agreement = 0.0;
      for (const Mode& mode : modes.oscillatory) {
        const double distance = std::abs(mode.frequency() / c.speed - 1.0);
        if (distance > nearest) continue;
        nearest = distance;
        agreement = mac(mode.shape, c.shape, s.M);
      }
      EXPECT_LT(nearest, eigensolvers);
      EXPECT_GT(agreement, 0.999);
      EXPECT_NEAR(c.damped_speed, c.speed, eigensolvers * c.speed);  // no damping
    }
  }
}

// ---- sparse and dense ---------------------------------------------------------------------------

// Lanczos on the real form of twice the size against the dense pencil: the same, each once.
TEST(CriticalSpeeds, OfLongRotorsAreThoseOfTheDensePencil) {
  constexpr double lanczos = 1e-8;  // relative; stiffness of short elements is conditioned to 1e9
  for (const bool is_isotropic : {true, false}) {
    const Structure s =
        test::two_disk(is_isotropic ? test::isotropic(1e6) : test::orthotropic(1e6, 2e5), 7);
    const System system = assemble(s, 0.0);
    ASSERT_GT(system.size(), 150);
    const HermitianModes dense =
        largest_hermitian(system.M, system.G(), 1.0, system.K, system.size());
    for (const int count : {1, 5, 8}) {
      const auto criticals = critical_speeds(Assembler(s), {.count = count});
      ASSERT_EQ(criticals.size(), static_cast<std::size_t>(count));
      for (int i = 0; i < count; ++i) {
        const double exact = 1.0 / std::sqrt(dense.nu(i));
        EXPECT_NEAR(criticals[static_cast<std::size_t>(i)].speed, exact, lanczos * exact);
      }
    }
  }
}

// (M - i g G) q = nu K q and q^H K q = I, of both branches.
TEST(HermitianModes, SolveThePencilAndAreOrthonormalInStiffness) {
  constexpr double orthogonality = 1e-8;
  for (const int elements : {2, 7}) {
    const System s = assemble(test::two_disk(test::orthotropic(1e6, 2e5), elements), 0.0);
    const HermitianModes modes = largest_hermitian(s.M, s.G(), 0.7, s.K, 6);
    ASSERT_EQ(modes.nu.size(), 6);
    const CMat KQ = s.K * modes.q;
    EXPECT_LT((modes.q.adjoint() * KQ - CMat::Identity(6, 6)).cwiseAbs().maxCoeff(), orthogonality);
    const CMat left = s.M * modes.q - Complex(0, 0.7) * (s.G() * modes.q);
    CMat small = modes.q.adjoint() * left;
    small.diagonal() -= modes.nu;
    EXPECT_LT(small.cwiseAbs().maxCoeff(), orthogonality * modes.nu(0));
    for (int i = 1; i < 6; ++i) EXPECT_LE(modes.nu(i), modes.nu(i - 1));
  }
}

// ---- bearings by a table ------------------------------------------------------------------------

// k = a + b Omega at order n: m n^2 Omega^2 = a + b Omega,
//   Omega = (b + sqrt(b^2 + 4 a m n^2)) / (2 m n^2)
TEST(CriticalSpeeds, OfABearingByATableSatisfyTheStiffnessAtThemselves) {
  const double m = 2.0, a = 2e4, b = 150.0;
  const TableBearing table{
      {.speed = {0.0, 2000.0}, .rows = {test::isotropic(a), test::isotropic(a + 2000.0 * b)}}};
  const Structure s{.bodies = {{.name = "block", .m = m}},
                    .bearings = {test::bearing(test::body("block"), AnyBearing(table))}};
  for (const double order : {1.0, 2.0}) {
    const double M = m * order * order;
    const double exact = (b + std::sqrt(b * b + 4.0 * a * M)) / (2.0 * M);
    const auto criticals = critical_speeds(Assembler(s), {.count = 2, .order = order});
    ASSERT_EQ(criticals.size(), 2u) << "order " << order;
    for (const Critical& c : criticals) {
      EXPECT_NEAR(c.speed, exact, solves * exact) << "order " << order;
      EXPECT_NEAR(c.damped_speed, exact, solves * exact) << "order " << order;
    }
  }
}

// Stiffness that falls with speed, k = a - b Omega, and differs along x and y.
TEST(CriticalSpeeds, OfASofteningTableAreFoundForBothDirections) {
  const double m = 2.0, a = 2e5, b = 100.0;
  const TableBearing table{
      {.speed = {0.0, 1000.0},
       .rows = {test::orthotropic(a, 3.0 * a), test::orthotropic(a - 1e3 * b, 3.0 * a - 1e3 * b)}}};
  const Structure s{.bodies = {{.name = "block", .m = m}},
                    .bearings = {test::bearing(test::body("block"), AnyBearing(table))}};
  const auto criticals = critical_speeds(Assembler(s), {.count = 2});
  ASSERT_EQ(criticals.size(), 2u);
  for (const int i : {0, 1}) {
    const double stiffness = i == 0 ? a : 3.0 * a;
    const double exact = (-b + std::sqrt(b * b + 4.0 * stiffness * m)) / (2.0 * m);
    EXPECT_NEAR(criticals[static_cast<std::size_t>(i)].speed, exact, solves * exact);
  }
}

// ---- wrong models -------------------------------------------------------------------------------

TEST(CriticalSpeeds, NeedSupports) {
  for (const auto& bearing : {test::isotropic(0.0), test::orthotropic(1e6, 0.0)}) {
    try {
      critical_speeds(Assembler(test::two_disk(bearing)), {});
      FAIL() << "no error";
    } catch (const ModelError& error) {
      EXPECT_NE(std::string(error.what()).find("critical speeds need supports"), std::string::npos);
    }
  }
}

// ---- strong dampers -----------------------------------------------------------------------------

/// A plain shaft of 2 m and 150 mm on two bearings of 20 MN/m and 1e5 N.s/m.
Structure on_strong_dampers(int elements) {
  const BearingCoefficients film = test::isotropic(2e7, 1e5);
  return {.shaft = {test::cylinder(2.0, 0.15, elements)},
          .bearings = {test::bearing(at(0.0), film), test::bearing(at(2.0), film)}};
}

// In a mesh of 1500 elements rounding keeps the equation of a damped critical speed above its
// tolerance.
TEST(CriticalSpeeds, DampedOnesOfAFineMeshAreThoseOfACoarseOne) {
  constexpr double mesh = 1e-5;  // relative: what elements leave out, and rounding
  const auto damped = [](int elements) {
    const Structure s = test::two_disk(test::orthotropic(1e6, 1.6e6, 300.0, 500.0), elements);
    std::vector<double> speeds;
    for (const Critical& c : critical_speeds(Assembler(s), {.count = 4})) {
      speeds.push_back(c.damped_speed);
    }
    return speeds;
  };
  const std::vector<double> fine = damped(250), coarse = damped(6);
  ASSERT_EQ(fine.size(), coarse.size());
  for (std::size_t i = 0; i < fine.size(); ++i) {
    EXPECT_NEAR(fine[i], coarse[i], mesh * coarse[i]) << i;
  }
}

// Creeping and overdamped motions stand between the modes: undamped speeds come nevertheless, a
// damped one for some of them, and the others say why not. Damped ones against the dense solver.
TEST(CriticalSpeeds, ComeOnStrongDampersAndSayWhereThereIsNoDampedOne) {
  const Assembler rotor(on_strong_dampers(20));
  ASSERT_GT(rotor.at(0.0).size(), 75);  // found by shift and invert
  const auto criticals = critical_speeds(rotor, {});
  ASSERT_EQ(criticals.size(), 6u);
  int damped = 0;
  for (const Critical& c : criticals) {
    EXPECT_EQ(std::isnan(c.damped_speed), !c.note.empty()) << c.speed;
    if (std::isnan(c.damped_speed)) continue;
    ++damped;
    const System s = rotor.at(c.damped_speed);
    const CVec lambda = dense_quadratic_modes(s.M, s.D(), s.K).lambda;
    const double nearest = (lambda.imag().array() - c.damped_speed).abs().minCoeff();
    EXPECT_LT(nearest, 1e2 * solves * c.damped_speed);  // QR of a wide spectrum
  }
  EXPECT_GE(damped, 2);
}

TEST(CriticalSpeeds, ComeOnStrongDampersInFineMeshesToo) {
  const auto coarse = critical_speeds(Assembler(on_strong_dampers(20)), {.has_damped = false});
  const auto fine = critical_speeds(Assembler(on_strong_dampers(40)), {});
  ASSERT_EQ(fine.size(), coarse.size());
  for (std::size_t i = 0; i < fine.size(); ++i) {
    EXPECT_NEAR(fine[i].speed, coarse[i].speed, 1e-4 * fine[i].speed);  // h^4
    EXPECT_TRUE(std::isnan(coarse[i].damped_speed));
  }
}

}  // namespace whirl::critical_test
