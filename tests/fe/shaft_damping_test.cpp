// Damping of single segments, and of single modes.

#include <gtest/gtest.h>

#include "libfe/analyses/modes.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::shaft_damping_test {

using namespace test;

/// A shaft of three segments, held rigidly: its stiffness is all there is.
Structure shaft() {
  return {.shaft = {cylinder(0.2, 0.03, 2), cylinder(0.3, 0.04, 3), cone(0.2, 0.04, 0.02, 2)},
          .bearings = {rigid(node(1)), rigid(node(8))}};
}

TEST(ShaftDamping, OfAllSegmentsAlikeIsThatOfTheWholeShaft) {
  Structure single = shaft(), whole = shaft();
  const Rayleigh damping{.mass = 3.0, .stiffness = 2e-5};
  for (Segment& segment : single.shaft) segment.damping = damping;
  whole.damping = damping;
  const Mat a(assemble(single, 200.0).C), b(assemble(whole, 200.0).C);
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-13 * b.cwiseAbs().maxCoeff());
  EXPECT_GT(b.cwiseAbs().maxCoeff(), 0.0);
}

// What a segment adds is a M + b K of it alone: the rotor with that segment less the rotor with the
// segment without mass and stiffness; both are differences in the segment's density and modulus.
TEST(ShaftDamping, OfOneSegmentIsInProportionToThatSegment) {
  Structure damped = shaft(), doubled = shaft();
  damped.shaft[1].damping = {.mass = 3.0, .stiffness = 2e-5};
  doubled.shaft[1].material.rho *= 2.0;
  doubled.shaft[1].material.E *= 2.0;
  doubled.shaft[1].material.G *= 2.0;
  const System plain = assemble(shaft(), 0.0), with = assemble(damped, 0.0),
               twice = assemble(doubled, 0.0);
  const Mat expected = 3.0 * Mat(twice.M - plain.M) + 2e-5 * Mat(twice.K - plain.K);
  EXPECT_LT((Mat(with.C) - expected).cwiseAbs().maxCoeff(), 1e-9 * expected.cwiseAbs().maxCoeff());
}

// At rest and without other damping the modes have the ratios that were asked for; those above the
// list have none.
TEST(ModalDamping, GivesModesAtRestTheirRatios) {
  Structure s = shaft();
  s.bearings = {bearing(node(1), orthotropic(1e7, 3e7)), bearing(node(8), orthotropic(2e7, 5e7))};
  const auto undamped = complex_modes(assemble(s, 0.0), 6).oscillatory;
  s.modal_damping = {{0.01, 0.02, 0.0, 0.3}};
  const auto modes = complex_modes(assemble(s, 0.0), 6).oscillatory;
  constexpr double solver = 1e-9;
  for (std::size_t i = 0; i < 6; ++i) {
    const double zeta = i < 4 ? s.modal_damping.ratios[i] : 0.0;
    // the order is that of damped frequencies; this list keeps it
    EXPECT_NEAR(modes[i].damping_ratio(), zeta, solver) << i;
    EXPECT_NEAR(std::abs(modes[i].lambda), undamped[i].frequency(),
                solver * undamped[i].frequency());
  }
}

TEST(ModalDamping, OfOneRatioIsThatOfEveryMode) {
  Structure s = shaft();
  s.modal_damping = {{0.03}, true};
  for (const Mode& mode : complex_modes(assemble(s, 0.0), 12).oscillatory) {
    EXPECT_NEAR(mode.damping_ratio(), 0.03, 1e-9);
  }
}

// Added mass of a table counts as that of constants does; films carry nothing at rest and are not
// asked for anything.
TEST(ModalDamping, KnowsTablesAndNoFilms) {
  BearingCoefficients seal = isotropic(1e6);
  seal.M = 20.0 * Mat2::Identity();
  Structure s = shaft();
  s.seals = {bearing(node(4), TableBearing{{.speed = {100.0}, .rows = {seal}}})};
  s.modal_damping = {{0.03}, true};
  const auto at = [](double Omega, double) {
    if (Omega == 0.0) throw NumericalError("a film carries nothing");
    return BearingCoefficients{};
  };
  s.linearized = {{.name = "film", .from = node(4), .to = ground(), .at = at}};
  const Assembler with_film(s);
  s.linearized.clear();
  for (const Mode& mode : complex_modes(assemble(s, 0.0), 6).oscillatory) {
    EXPECT_NEAR(mode.damping_ratio(), 0.03, 1e-9);
  }
}

// Rigid-body modes have no frequency and get no damping; massless parts are condensed as before.
TEST(ModalDamping, LeavesRigidBodiesAndMasslessPartsAlone) {
  Structure free{.shaft = {cylinder(0.6, 0.03, 6)}, .modal_damping = {{0.02, 0.02}}};
  const Modes modes = complex_modes(assemble(free, 0.0), 4);
  EXPECT_FALSE(modes.rigid_body.empty());
  ASSERT_FALSE(modes.oscillatory.empty());
  EXPECT_NEAR(modes.oscillatory[0].damping_ratio(), 0.02, 1e-8);

  Structure light{.shaft = {massless_cylinder(0.6, 0.03, 6)},
                  .disks = {{.at = node(3), .m = 5.0, .Id = 0.01, .Ip = 0.02}},
                  .bearings = {rigid(node(1)), rigid(node(7))},
                  .modal_damping = {{0.05}, true}};
  const System s = assemble(light, 0.0);
  EXPECT_EQ(s.size(), 4);
  for (const Mode& mode : complex_modes(s, 4).oscillatory) {
    EXPECT_NEAR(mode.damping_ratio(), 0.05, 1e-9);
  }
}

// A pedestal whose mass along x differs: w = sqrt(k / m) of each direction.
TEST(BodyMass, MayDifferAlongXAndY) {
  const Structure s{.bodies = {{.name = "pedestal", .m = {4.0, 9.0}}},
                    .bearings = {bearing(body("pedestal"), isotropic(36e4))},
                    .gravity = 10.0};
  const Assembler assembler(s);
  const auto modes = complex_modes(assembler.at(0.0), 2).oscillatory;
  EXPECT_NEAR(modes[0].frequency(), 200.0, 1e-9);
  EXPECT_NEAR(modes[1].frequency(), 300.0, 1e-9);
  EXPECT_NEAR(assembler.gravity_load()(1), -90.0, 1e-12);
}

}  // namespace whirl::shaft_damping_test
