// From structures to global matrices: supports, links, massless parts, loads.

#include "libfe/assembly/assemble.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libbase/numerics/dense.hpp"
#include "libbase/numerics/sparse_lu.hpp"
#include "libfe/analyses/modes.hpp"
#include "libfe/analyses/static.hpp"
#include "libfe/assembly/properties.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::assemble_test {

using test::at;
using test::node;

constexpr double rounding = 1e-12;  // relative; sums of element matrices
constexpr double solves = 1e-9;     // relative; rounding times the condition of a small stiffness

std::vector<double> frequencies(const Structure& s, double Omega, int count) {
  std::vector<double> f;
  for (const Mode& mode : complex_modes(assemble(s, Omega), count).oscillatory) {
    f.push_back(mode.frequency());
  }
  return f;
}

double largest(const Mat& A) {
  return A.size() > 0 ? A.cwiseAbs().maxCoeff() : 0.0;
}

template <class Function>
std::string message_of(const Function& f) {
  try {
    f();
  } catch (const std::exception& error) {
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return {};
}

// ---- shape of the matrices ----------------------------------------------------------------------

TEST(Assemble, MatricesAreSymmetricAndGyroscopicsSkew) {
  std::mt19937 random(1);
  for (int draw = 0; draw < 5; ++draw) {
    const System s = assemble(test::random_rotor(random, {.elements = 15, .damping = 0.1}), 300.0);
    EXPECT_LE(largest(Mat(s.M) - Mat(s.M).transpose()), rounding * largest(s.M));
    EXPECT_LE(largest(Mat(s.K) - Mat(s.K).transpose()), rounding * largest(s.K));
    EXPECT_LE(largest(Mat(s.C) - Mat(s.C).transpose()), rounding * largest(s.C));
    EXPECT_LE(largest(Mat(s.G()) + Mat(s.G()).transpose()), rounding * largest(s.G()));
    EXPECT_GT(largest(s.G()), 0.0);
    EXPECT_GT(symmetric_modes(Mat(s.M)).values(0), 0.0);
    EXPECT_TRUE(Mat(s.D()).isApprox(Mat(s.C) + 300.0 * Mat(s.G()), rounding));
  }
}

// Damping that rotates with the shaft has a matrix of its own, the same at every speed.
TEST(Assemble, CirculatoryStiffnessIsSkewAndGrowsWithTheSpeed) {
  std::mt19937 random(1);
  Structure rotor = test::random_rotor(random, {.elements = 8});
  EXPECT_FALSE(assemble(rotor, 300.0).circulates());
  for (Segment& segment : rotor.shaft) segment.material.eta = 1e-5;
  const Assembler assembler(rotor);
  EXPECT_TRUE(assembler.depends_on_speed());
  EXPECT_FALSE(assembler.tables_depend_on_speed());
  const System rest = assembler.at(0.0), s = assembler.at(300.0);
  EXPECT_TRUE(s.circulates());
  EXPECT_EQ(Mat(s.H()), Mat(rest.H()));
  EXPECT_EQ(Mat(s.K), Mat(rest.K));
  EXPECT_EQ(Mat(rest.stiffness()), Mat(rest.K));
  EXPECT_LE(largest(Mat(s.H()) + Mat(s.H()).transpose()), rounding * largest(s.H()));
  EXPECT_TRUE(Mat(s.stiffness()).isApprox(Mat(s.K) + 300.0 * Mat(s.H()), rounding));
}

// What loads a rotor does not change its mesh and its matrices: an assembler goes on with others at
// the same stations, and with nothing else.
TEST(Assemble, TakesOtherLoads) {
  std::mt19937 random(1);
  Structure rotor = test::random_rotor(random, {.elements = 8});
  rotor.unbalances = {{.at = {.kind = Station::Kind::node, .node = 2}, .moment = 1e-4}};
  const Assembler assembler(rotor);
  Structure other = rotor;
  other.unbalances[0].moment = 2e-4;
  other.gravity = 9.81;
  const auto loaded = assembler.with_loads_of(other);
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->unbalance(), Assembler(other).unbalance());
  EXPECT_EQ(loaded->unbalance(), 2.0 * assembler.unbalance());
  EXPECT_EQ(loaded->gravity_load(), Assembler(other).gravity_load());
  EXPECT_EQ(Mat(loaded->at(300.0).K), Mat(Assembler(other).at(300.0).K));

  const auto is_refused = [&](auto change) {
    Structure changed = rotor;
    change(changed);
    return !assembler.with_loads_of(changed);
  };
  EXPECT_TRUE(is_refused([](Structure& s) { s.unbalances[0].at.node = 3; }));
  EXPECT_TRUE(is_refused([](Structure& s) { s.unbalances.push_back(s.unbalances[0]); }));
  EXPECT_TRUE(is_refused([](Structure& s) { s.shaft[0].length *= 1.1; }));
  EXPECT_TRUE(is_refused([](Structure& s) { s.shaft[0].material.E *= 1.1; }));
  EXPECT_TRUE(is_refused([](Structure& s) { s.disks[0].m *= 1.1; }));
  EXPECT_TRUE(is_refused([](Structure& s) { s.damping.mass += 0.1; }));
  EXPECT_TRUE(is_refused([](Structure& s) { s.modal_damping.ratios = {0.01}; }));
  EXPECT_TRUE(is_refused([](Structure& s) {
    s.bearings[0].coefficients = constant_bearing({.K = 3e6 * Mat2::Identity()});
  }));
}

// Cross-coupled bearings make K skew in part: nothing symmetrizes it.
TEST(Assemble, CrossCoupledBearingsKeepTheirSigns) {
  BearingCoefficients c;
  c.K << 5.0, 2.0, -3.0, 7.0;
  c.C << 0.5, 0.2, -0.3, 0.7;
  const Structure s{.bodies = {{.name = "mass", .m = 1.0}},
                    .bearings = {test::bearing(test::body("mass"), c)}};
  EXPECT_EQ(Mat(assemble(s, 0.0).K), Mat(c.K));
  EXPECT_EQ(Mat(assemble(s, 0.0).C), Mat(c.C));
}

// The full vector: nodes in the order of their numbers, bodies, internal amplitudes.
TEST(Assemble, RowsOfTheDofMapPickDisplacements) {
  Structure s = test::pinned(test::cylinder(1.0, 0.05, 2));
  s.shaft[0].internal_functions = 1;
  s.bodies = {{.name = "block", .m = 1.0}, {.name = "stator", .m = 2.0, .tilts = true, .Id = 0.1}};
  const DofMap dofs = Assembler(s).at(0.0).dofs;
  EXPECT_EQ(dofs.full_size, 3 * 4 + 2 + 4 + 2 * 4);  // with shear a pair is two functions a plane
  EXPECT_EQ(dofs.size(), dofs.full_size - 4);        // two pins
  EXPECT_EQ(dofs.points().size(), 5u);
  const Vec q = Vec::LinSpaced(dofs.size(), 1.0, dofs.size());
  const Vec full = dofs.T * q;
  const Point middle{Point::Kind::node, 1}, block{Point::Kind::body, 0},
      stator{Point::Kind::body, 1};
  EXPECT_EQ(dofs.row(middle, Y).dot(q), full(5));
  EXPECT_EQ(dofs.row(block, Y).dot(q), full(13));
  EXPECT_EQ(dofs.row(stator, THETA_Y).dot(q), full(17));
  EXPECT_TRUE(dofs.row({Point::Kind::node, 0}, X).isZero(0.0));  // pinned
  EXPECT_TRUE(dofs.row(block, THETA_X).isZero(0.0));             // has none
  EXPECT_TRUE(dofs.row({}, X).isZero(0.0));                      // ground
}

// Rayleigh: C = a M + b K, with K the whole stiffness, bearings and links too.
TEST(Assemble, RayleighDampingTakesTheWholeStiffness) {
  Structure s = test::two_disk(test::orthotropic(1e6, 2e6));
  s.damping = {.mass = 3.0, .stiffness = 2e-5};
  const System system = assemble(s, 100.0);
  EXPECT_TRUE(Mat(system.C).isApprox(3.0 * Mat(system.M) + 2e-5 * Mat(system.K), rounding));
}

// ... and with the conservative part of it alone: neither cross-coupling k_xy = -k_yx of a bearing,
// nor what a torque has of it, makes damping forces across the motion. What is symmetric, k_xy =
// k_yx, does.
TEST(Assemble, RayleighDampingTakesNothingOfCrossCoupling) {
  const auto rotor = [](double kxy, double kyx) {
    BearingCoefficients bearing = test::orthotropic(1e6, 2e6);
    bearing.K(0, 1) = kxy;
    bearing.K(1, 0) = kyx;
    Structure s = test::two_disk(bearing);
    s.damping = {.stiffness = 2e-5};
    return s;
  };
  const auto C = [](const Structure& s) { return Mat(assemble(s, 100.0).C); };
  const Mat without = C(rotor(0.0, 0.0)), symmetric = C(rotor(5e5, 5e5));
  EXPECT_EQ(C(rotor(5e5, -5e5)), without);
  EXPECT_TRUE(C(rotor(7e5, 3e5)).isApprox(symmetric, rounding));
  EXPECT_NEAR((symmetric - without).cwiseAbs().maxCoeff(), 2e-5 * 5e5, 1e-9);
  Structure twisted = rotor(0.0, 0.0);
  for (Segment& segment : twisted.shaft) segment.torque = 1e4;
  EXPECT_TRUE(C(twisted).isApprox(C(twisted).transpose(), rounding));
}

// ---- rigid connections --------------------------------------------------------------------------

// Elimination is the limit of stiff springs, and the difference falls as 1 / k.
TEST(RigidBearing, IsTheLimitOfStiffOnes) {
  const double Omega = 400.0;
  Structure s = test::two_disk({});
  s.bearings = {test::rigid(at(0.0)), test::rigid(at(1.5))};
  const auto limit = frequencies(s, Omega, 6);
  const auto distance = [&](double k) {
    s.bearings = {test::bearing(at(0.0), test::isotropic(k)),
                  test::bearing(at(1.5), test::isotropic(k))};
    const auto f = frequencies(s, Omega, 6);
    double sum = 0.0;
    for (std::size_t i = 0; i < 6; ++i) sum += 1.0 - f[i] / limit[i];
    return sum;
  };
  const double soft = distance(1e10), stiff = distance(1e11);
  EXPECT_GT(stiff, 0.0);  // a spring is softer than none
  EXPECT_LT(stiff, 1e-2);
  constexpr double next_order = 0.02;  // of the ratio: the first term of the series in 1 / k
  EXPECT_NEAR(soft / stiff, 10.0, 10.0 * next_order);
}

// A body held rigidly to a node is a disk there: pinned it adds its mass, clamped its inertia too.
TEST(RigidLink, ToABodyPutsTheBodyOnTheNode) {
  const double Omega = 500.0;
  Structure disk = test::two_disk(test::orthotropic(1e6, 3e6)), body = disk;
  disk.disks.push_back({.at = at(0.75), .m = 20.0, .Id = 0.2, .Ip = 0.35});
  body.bodies = {{.name = "wheel", .m = 20.0, .spins = true, .tilts = true, .Id = 0.2, .Ip = 0.35}};
  body.links = {test::clamped(at(0.75), test::body("wheel"))};
  EXPECT_EQ(assemble(body, 0.0).size(), assemble(disk, 0.0).size());

  Structure point_mass = test::two_disk(test::orthotropic(1e6, 3e6)), pinned = point_mass;
  point_mass.disks.push_back({.at = at(0.75), .m = 20.0});
  pinned.bodies = {{.name = "mass", .m = 20.0}};
  pinned.links = {test::rigid(test::body("mass"), at(0.75))};

  const auto a = frequencies(disk, Omega, 8), b = frequencies(body, Omega, 8);
  const auto c = frequencies(point_mass, Omega, 8), d = frequencies(pinned, Omega, 8);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(b[i], a[i], solves * a[i]);
    EXPECT_NEAR(d[i], c[i], solves * c[i]);
  }
  EXPECT_GT(std::abs(a[4] / c[4] - 1.0), 1e-3);  // the inertia of tilt is seen
}

// Cantilever with a force at its tip: w = F L^3 / (3 E I) + F L / (kappa G A), theta = F L^2 / (2 E
// I).
TEST(ClampedBearing, MakesACantilever) {
  const Segment shaft = test::cylinder(0.7, 0.06, 3);
  const System s = assemble(test::cantilever(shaft), 0.0);
  EXPECT_EQ(s.size(), 3 * 4);
  const double F = 1000.0, L = 0.7, EI = test::EI(shaft);
  const double kGA =
      shear_coefficient({}, shaft.left, shaft.material.nu) * shaft.material.G * shaft.left.A();
  const Point tip{Point::Kind::node, 3};
  const Vec q = SparseLu(s.K).solve(F * s.dofs.row(tip, X));
  const double w = F * L * L * L / (3.0 * EI) + F * L / kGA, theta = F * L * L / (2.0 * EI);
  EXPECT_NEAR(s.dofs.row(tip, X).dot(q), w, solves * w);
  EXPECT_NEAR(s.dofs.row(tip, THETA_Y).dot(q), theta, solves * theta);
}

// Cantilever of Euler and Bernoulli: omega = (beta L)^2 sqrt(E I / (rho A L^4)),
// beta L = 1.875104068711961, 4.694091132974175. [Blevins1979], table 8-1
TEST(ClampedBearing, CantileverHasItsPublishedFrequencies) {
  constexpr double discretization = 1e-7;  // eight elements and one pair of internal functions
  Segment shaft = test::cylinder(0.7, 0.03, 8, Theory::euler_bernoulli);
  shaft.internal_functions = 1;
  const auto f = frequencies(test::cantilever(shaft), 0.0, 4);
  const double unit =
      std::sqrt(test::EI(shaft) / (shaft.material.rho * shaft.left.A() * std::pow(0.7, 4)));
  EXPECT_NEAR(f[0], std::pow(1.875104068711961, 2) * unit, discretization * f[0]);
  EXPECT_NEAR(f[2], std::pow(4.694091132974175, 2) * unit, 10.0 * discretization * f[2]);
}

// ---- massless parts -----------------------------------------------------------------------------

// Disk at a of a pinned massless shaft of length L = a + b: k = 3 E I L / (a^2 b^2); 48 E I / L^3
// amid.
TEST(MasslessShaft, IsCondensedToTheStiffnessOfClosedForms) {
  const test::Jeffcott jeffcott;
  const System s = assemble(jeffcott.structure(), 0.0);
  ASSERT_EQ(s.size(), 2);
  EXPECT_EQ(s.dofs.condensed, 6);  // tilts of three nodes
  EXPECT_TRUE(Mat(s.M).isApprox(jeffcott.m * Mat2::Identity(), rounding));
  EXPECT_LT(largest(Mat(s.K) - jeffcott.k() * Mat2::Identity()), solves * jeffcott.k());

  Structure off_center = test::pinned(test::massless_cylinder(0.8, 0.02, 0));
  off_center.disks.push_back({.at = at(0.2), .m = 1.0});
  const double k = 3.0 * test::EI(off_center.shaft[0]) * 0.8 / (0.04 * 0.36);
  EXPECT_LT(largest(Mat(assemble(off_center, 0.0).K) - k * Mat2::Identity()), solves * k);
}

// C = b K for the whole rotor: also for what is left of it.
TEST(MasslessShaft, IsCondensedWithStiffnessProportionalDamping) {
  const test::Jeffcott jeffcott;
  Structure structure = jeffcott.structure();
  structure.damping.stiffness = 1e-4;
  const System s = assemble(structure, 0.0);
  ASSERT_EQ(s.size(), 2);
  EXPECT_LT(largest(Mat(s.C) - 1e-4 * jeffcott.k() * Mat2::Identity()), solves * largest(s.C));
}

// Rotating damping: C = eta k, and K = [k, Omega eta k; -Omega eta k, k].
TEST(MasslessShaft, IsCondensedWithInternalDamping) {
  const test::Jeffcott jeffcott;
  const double eta = 1e-4, Omega = 700.0, k = jeffcott.k();
  Structure structure = jeffcott.structure();
  structure.shaft[0].material.eta = eta;
  const System s = assemble(structure, Omega);
  ASSERT_EQ(s.size(), 2);
  Mat2 K;
  K << k, Omega * eta * k, -Omega * eta * k, k;
  EXPECT_LT(largest(Mat(s.stiffness()) - K), solves * k);
  EXPECT_LT(largest(Mat(s.C) - eta * k * Mat2::Identity()), solves * eta * k);
}

// Mass - k1 - massless body - k2 - ground: k = k1 k2 / (k1 + k2).
TEST(MasslessBody, BetweenTwoSpringsMakesThemOne) {
  const double k1 = 3e5, k2 = 5e5;
  const Structure structure{
      .bodies = {{.name = "mass", .m = 2.0}, {.name = "joint"}},
      .bearings = {test::bearing(test::body("joint"), test::isotropic(k2))},
      .links = {test::connect(test::body("mass"), test::body("joint"), test::isotropic(k1))}};
  const System s = assemble(structure, 0.0);
  ASSERT_EQ(s.size(), 2);
  EXPECT_EQ(s.dofs.condensed, 2);
  const double k = k1 * k2 / (k1 + k2);
  EXPECT_LT(largest(Mat(s.K) - k * Mat2::Identity()), rounding * k);
  // the joint moves as the springs divide the way
  const Vec q = Vec2(1.0, 0.0);
  EXPECT_NEAR(s.dofs.row({Point::Kind::body, 1}, X).dot(q), k1 / (k1 + k2), rounding);
}

// Mass on k2, and on k1 in series with a damper c (Maxwell), the joint without mass:
//   (m s^2 + k2) (c s + k1) + k1 c s = 0
// has one real root, the creep of the damper, and one pair.
TEST(MasslessBody, WithADamperOfItsOwnStays) {
  const double m = 2.0, k1 = 3e5, k2 = 5e5, c = 150.0;
  const Structure structure{
      .bodies = {{.name = "mass", .m = m}, {.name = "joint"}},
      .bearings = {test::bearing(test::body("mass"), test::isotropic(k2)),
                   test::bearing(test::body("joint"), test::isotropic(0.0, c))},
      .links = {test::connect(test::body("mass"), test::body("joint"), test::isotropic(k1))}};
  const System s = assemble(structure, 0.0);
  EXPECT_EQ(s.size(), 4);
  EXPECT_EQ(s.dofs.condensed, 0);
  EXPECT_EQ((Mat(s.M).diagonal().array() == 0.0).count(), 2);

  // companion matrix of m c s^3 + m k1 s^2 + c (k1 + k2) s + k1 k2
  Eigen::Matrix3d companion;
  companion << 0, 1, 0, 0, 0, 1, -k1 * k2 / (m * c), -(k1 + k2) / m, -k1 / c;
  const Eigen::Vector3cd roots = companion.eigenvalues();
  const Modes modes = complex_modes(s, 10);
  ASSERT_EQ(modes.overdamped.size(), 2u);  // along x and along y
  ASSERT_EQ(modes.oscillatory.size(), 2u);
  for (const Complex root : roots) {
    if (root.imag() < 0.0) continue;
    const bool is_real = root.imag() == 0.0;
    for (const std::size_t i : {0, 1}) {
      const Complex found = is_real ? modes.overdamped[i] : modes.oscillatory[i].lambda;
      EXPECT_LT(std::abs(found - root), solves * std::abs(root));
    }
  }
}

// The same with a damper c1 beside k1, of which c is 0.5 %: what the joint's own damper adds to the
// common ratio of damping and stiffness is small, and is no rounding.
//   (m s^2 + k2) ((c + c1) s + k1) + (c1 s + k1) c s = 0
TEST(MasslessBody, WithASmallDamperOfItsOwnStays) {
  const double m = 2.0, k1 = 3e5, k2 = 5e5, c1 = 150.0, c = 0.005 * c1;
  const Structure structure{
      .bodies = {{.name = "mass", .m = m}, {.name = "joint"}},
      .bearings = {test::bearing(test::body("mass"), test::isotropic(k2)),
                   test::bearing(test::body("joint"), test::isotropic(0.0, c))},
      .links = {test::connect(test::body("mass"), test::body("joint"), test::isotropic(k1, c1))}};
  const System s = assemble(structure, 0.0);
  EXPECT_EQ(s.dofs.condensed, 0);
  const auto left = [&](Complex z) {
    return (m * z * z + k2) * ((c + c1) * z + k1) + (c1 * z + k1) * c * z;
  };
  const Modes modes = complex_modes(s, 10);
  ASSERT_EQ(modes.oscillatory.size(), 2u);
  for (const Mode& mode : modes.oscillatory) {
    EXPECT_LT(std::abs(left(mode.lambda)), solves * k1 * k2);
  }
}

TEST(MasslessBody, WithoutSupportHasNoMotion) {
  const Structure structure{.bodies = {{.name = "mass", .m = 1.0}, {.name = "nothing"}},
                            .bearings = {test::bearing(test::body("mass"), test::isotropic(1.0))}};
  EXPECT_THROW(assemble(structure, 0.0), NumericalError);
  const std::string message = message_of([&] { assemble(structure, 0.0); });
  EXPECT_NE(message.find("neither inertia nor stiffness"), std::string::npos);
}

// ---- loads and supports -------------------------------------------------------------------------

// Nodal loads of gravity add up to the weight, along -y, with internal functions too; bodies too.
TEST(Gravity, LoadAddsUpToTheWeight) {
  std::mt19937 random(2);
  Structure s = test::random_rotor(random, {.elements = 10});
  for (Segment& segment : s.shaft) segment.internal_functions = 2;
  s.bodies = {{.name = "stator", .m = 40.0, .tilts = true, .Id = 1.0},
              {.name = "wheel", .m = 7.0, .spins = true}};
  s.gravity = 9.81;
  const Assembler assembler(s);
  const Vec load = assembler.gravity_load();
  const DofMap dofs = assembler.at(0.0).dofs;
  double fx = 0.0, fy = 0.0;
  for (const Point& p : dofs.points()) {
    fx += load(dofs.full_index(p, X));
    fy += load(dofs.full_index(p, Y));
  }
  const double weight = (rotor_properties(assembler.structure(), assembler.mesh()).mass + 40.0) *
                        9.81;  // the stator is no rotor
  EXPECT_NEAR(fy, -weight, rounding * weight);
  EXPECT_NEAR(fx, 0.0, rounding * weight);
}

/// What is missing in the equations of the full vector under a load that lasts.
Vec support_forces(const Assembler& assembler, const Vec& q, const Vec& load) {
  return assembler.full(0.0, 0.0).K * (assembler.dofs().T * q) - load;
}

// A force F at a quarter of the span: supports carry 3 F / 4 and F / 4, nothing else is held.
TEST(SupportForces, OfRigidBearingsFollowTheLever) {
  const Structure structure = test::pinned(test::cylinder(1.0, 0.04, 4));
  const Assembler assembler(structure);
  const System s = assembler.at(0.0);
  Vec load = Vec::Zero(s.dofs.full_size);
  load(4 * 1 + 0) = 800.0;
  const Vec q = SparseLu(s.K).solve(Vec(s.dofs.T.transpose() * load));
  Vec expected = Vec::Zero(s.dofs.full_size);
  expected(4 * 0 + 0) = -600.0;
  expected(4 * 4 + 0) = -200.0;
  EXPECT_LT(largest(support_forces(assembler, q, load) - expected), solves * 1e6);
}

// A weight W at the end of a cantilever: the clamp pushes up with W and turns with -W L about x.
TEST(SupportForces, OfAClampHoldTheMoment) {
  const Structure structure = test::cantilever(test::cylinder(0.7, 0.06, 2));
  const Assembler assembler(structure);
  const System s = assembler.at(0.0);
  Vec load = Vec::Zero(s.dofs.full_size);
  load(4 * 2 + 1) = -1000.0;
  const Vec q = SparseLu(s.K).solve(Vec(s.dofs.T.transpose() * load));
  const Vec force = support_forces(assembler, q, load);
  EXPECT_NEAR(force(Y), 1000.0, solves * 1e3);
  EXPECT_NEAR(force(THETA_X), -700.0, solves * 1e3);
}

// u_x = U e^(i p), u_y = -i u_x: f_x = U cos(Omega t + p), f_y = U sin(Omega t + p).
TEST(Unbalance, TurnsFromXToY) {
  Structure s = test::two_disk(test::isotropic(1e6));
  s.unbalances = {{.at = at(0.5), .moment = 2e-3, .phase = 0.3}};
  const CVec u = Assembler(s).unbalance();
  const Complex e = std::polar(1.0, 0.7);  // e^(i Omega t)
  EXPECT_NEAR((u(8) * e).real(), 2e-3 * std::cos(1.0), rounding);
  EXPECT_NEAR((u(9) * e).real(), 2e-3 * std::sin(1.0), rounding);
  EXPECT_EQ((u.array() != Complex(0.0)).count(), 2);
}

// ---- wrong models -------------------------------------------------------------------------------

TEST(Connections, ThatCannotBeAreReported) {
  const auto two_blocks = [] {
    return Structure{.bodies = {{.name = "a", .m = 1.0}, {.name = "b", .m = 1.0}}};
  };
  Structure clamp = two_blocks();
  clamp.bearings = {test::clamped(test::body("a"))};
  EXPECT_NE(message_of([&] { Assembler{clamp}; }).find("tilts"), std::string::npos);

  Structure loop = two_blocks();
  loop.bearings = {test::rigid(test::body("a")), test::rigid(test::body("b"))};
  loop.links = {test::rigid(test::body("a"), test::body("b"))};
  EXPECT_NE(message_of([&] { Assembler{loop}; }).find("already"), std::string::npos);

  Structure itself = test::pinned(test::cylinder(1.0, 0.05, 2));
  itself.links = {test::connect(at(0.5), node(2), test::isotropic(1.0))};
  EXPECT_NE(message_of([&] { Assembler{itself}; }).find("same place"), std::string::npos);
}

// A structure that rigid bearings hold at every point has no equation of motion: solvers of nothing
// ended by a signal.
TEST(Assemble, NothingThatCanMoveIsAnError) {
  Structure held{.bodies = {{.name = "rotor", .m = 1.0}}};
  held.bearings = {test::rigid(test::body("rotor"))};
  try {
    Assembler assembler(held);
    ADD_FAILURE() << "no error";
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("nothing can move"), std::string::npos);
  }
}

TEST(Connections, AllWrongOnesAreReportedTogether) {
  Structure s{.bodies = {{.name = "a", .m = 1.0}}};
  s.bearings = {test::clamped(test::body("a")), test::clamped(test::body("a"))};
  s.links = {test::connect(test::body("a"), test::body("a"), test::isotropic(1.0))};
  try {
    Assembler{s};
    FAIL() << "no error";
  } catch (const ModelError& error) {
    EXPECT_EQ(error.problems().size(), 3u);
  }
}

}  // namespace whirl::assemble_test
