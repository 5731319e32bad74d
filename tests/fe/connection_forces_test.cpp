#include "libfe/analyses/connection_forces.hpp"

#include <gtest/gtest.h>

#include "libbase/numerics/constants.hpp"
#include "libfe/analyses/unbalance.hpp"
#include "libfe/assembly/excitations.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::connection_forces_test {

using test::at;
using test::isotropic;

constexpr double Omega = 80.0;  // [rad/s]

/// Displacement along x, or y, of everything by one.
Vec translation(const DofMap& dofs, int component) {
  Vec all = Vec::Zero(dofs.full_size);
  for (const Point& p : dofs.points()) all(dofs.full_index(p, component)) = 1.0;
  return all;
}

/// The two-disk rotor with an unbalance.
Structure unbalanced(Structure s) {
  s.unbalances = {{.at = at(0.5), .moment = 2e-3, .phase = 0.4}};
  return s;
}

/// Forces on all parts under the steady response.
CVec forces_of(const Structure& s, RigidRows rigid = RigidRows::nodal) {
  const Assembler assembler(s);
  UnbalanceSolver solver(assembler);
  const CVec load = sum_at(synchronous_excitations(assembler), assembler, Omega);
  return ConnectionForces(assembler, Omega, Omega, rigid).at(Omega, *solver.at(Omega), load);
}

/// The rotor's momentum: forces of a rotor in the air on its supports are loads less inertia.
Complex load_less_inertia(const Structure& s, int component) {
  const Assembler assembler(s);
  UnbalanceSolver solver(assembler);
  const CVec q = *solver.at(Omega);
  const CVec load = sum_at(synchronous_excitations(assembler), assembler, Omega);
  const Vec one = translation(assembler.dofs(), component);
  const Sparse M = assembler.full(Omega, Omega).M;
  return one.cast<Complex>().dot(load + Omega * Omega * (M * q));
}

TEST(ConnectionForces, OfElasticBearingsBearLoadAndInertia) {
  const Structure s = unbalanced(test::two_disk(isotropic(1e6, 300.0)));
  const CVec F = forces_of(s);
  ASSERT_EQ(F.size(), 4);
  for (const int k : {0, 1}) {
    const Complex expected = load_less_inertia(s, k);
    EXPECT_LT(std::abs(F(k) + F(2 + k) - expected), 1e-9 * std::abs(expected));
  }
}

TEST(ConnectionForces, OfRigidBearingsBearLoadAndInertia) {
  Structure s = unbalanced(test::two_disk(isotropic(1e6)));
  s.bearings = {test::rigid(at(0.0)), test::rigid(at(1.5))};
  const CVec F = forces_of(s);
  for (const int k : {0, 1}) {
    const Complex expected = load_less_inertia(s, k);
    EXPECT_LT(std::abs(F(k) + F(2 + k) - expected), 1e-9 * std::abs(expected));
  }
}

// A very stiff bearing has the force of a rigid one.
TEST(ConnectionForces, OfStiffBearingsTendToThoseOfRigidOnes) {
  Structure s = unbalanced(test::two_disk(isotropic(1e6)));
  s.bearings = {test::rigid(at(0.0)), test::rigid(at(1.5))};
  const CVec rigid = forces_of(s);
  const CVec stiff = forces_of(unbalanced(test::two_disk(isotropic(1e13))));
  EXPECT_LT((rigid - stiff).norm(), 1e-5 * rigid.norm());
}

// Of a motion of all coordinates both ways to write a rigid part's force are equal.
TEST(ConnectionForces, OfStaticShapesAreThoseOfNodesForTheWholeMotion) {
  Structure s = unbalanced(test::two_disk(isotropic(1e6)));
  s.bearings = {test::rigid(at(0.0)), test::bearing(at(1.5), isotropic(3e6, 200.0))};
  const CVec nodal = forces_of(s), shapes = forces_of(s, RigidRows::static_shape);
  EXPECT_LT((nodal - shapes).norm(), 1e-9 * nodal.norm());
}

// A pedestal: the bearing's force goes on to the link, less the inertia of the body between.
TEST(ConnectionForces, GoThroughAPedestal) {
  constexpr double m = 25.0, k = 8e6;
  Structure s = unbalanced(test::two_disk(isotropic(1e6, 300.0)));
  s.bodies = {{.name = "pedestal", .m = m}};
  s.bearings[0].to = test::body("pedestal");
  s.links = {test::connect(test::body("pedestal"), test::ground(), isotropic(k))};
  const Assembler assembler(s);
  UnbalanceSolver solver(assembler);
  const CVec q = *solver.at(Omega);
  const std::vector<CarryingPart> parts = carrying_parts(assembler);
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_EQ(parts[2].kind, "link");
  const CVec F = forces_of(s);
  const int x = assembler.dofs().full_index({Point::Kind::body, 0}, X);
  EXPECT_LT(std::abs(F(4) - k * q(x)), 1e-9 * std::abs(F(4)));
  EXPECT_LT(std::abs(F(0) + m * Omega * Omega * q(x) - F(4)), 1e-9 * std::abs(F(4)));
}

}  // namespace whirl::connection_forces_test
