// A bent shaft in the equations of motion that simulations and orbits are integrated with.

#include <gtest/gtest.h>

#include <cmath>

#include "libbase/numerics/dense.hpp"
#include "libdyn/system/model.hpp"
#include "libdyn/system/scene.hpp"
#include "libfe/analyses/unbalance.hpp"
#include "libfe/parts/bow.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::bow_motion_test {

using namespace test;

Model bent_rotor(double Omega, ReductionMethod method) {
  Model model;
  model.speed = Omega;
  model.has_speed = true;
  model.reduction.method = method;
  model.structure = {.shaft = {cylinder(0.8, 0.03, 8)},
                     .disks = {{.at = node(4), .m = 6.0, .Id = 0.02, .Ip = 0.04}},
                     .bearings = {bearing(node(1), orthotropic(4e6, 6e6, 800.0, 500.0)),
                                  bearing(node(9), orthotropic(5e6, 7e6, 600.0, 900.0))},
                     .unbalances = {{.at = node(4), .moment = 2e-4, .phase = 0.5}},
                     .bow = {.z = {0.0, 0.3, 0.8}, .x = {0.0, 8e-5, 0.0}, .y = {0.0, 5e-5, 0.0}}};
  return model;
}

// The steady response of `unbalance` is a motion: its accelerations are -Omega^2 times itself.
TEST(BowMotion, HasTheSteadyResponseForAMotion) {
  for (const double Omega : {50.0, 300.0}) {
    const Scene scene = make_scene(bent_rotor(Omega, ReductionMethod::none));
    const auto q = UnbalanceSolver(scene.assembler).at(Omega);
    ASSERT_TRUE(q);
    const auto n = q->size();
    ASSERT_EQ(scene.contacts.coordinates(), n);
    for (const double phase : {0.0, 1.1, 4.0}) {
      const Complex turn = std::polar(1.0, phase);
      Vec y(2 * n), a(n);
      y << (*q * turn).real(), (*q * turn * Complex(0.0, Omega)).real();
      scene.contacts.acceleration(phase, y.data(), a.data());
      const Vec expected = -Omega * Omega * (*q * turn).real();
      // accelerations are differences of elastic forces that are some 1e6 times as large
      EXPECT_LT((a - expected).norm(), 1e-6 * expected.norm()) << phase;
    }
  }
}

// The reduction has the shape of the bow: at a speed of nearly nothing the shaft lies in it.
TEST(BowMotion, IsInTheFewShapesOfAReduction) {
  const double Omega = 0.01;
  const Model model = bent_rotor(Omega, ReductionMethod::modal_residual);
  const Scene scene = make_scene(model);
  const ReducedSystem& r = scene.reduced;
  EXPECT_LT(r.size(), 20);
  const CMat Z =
      (r.K - Omega * Omega * r.M).cast<Complex>() + Complex(0.0, Omega) * r.D().cast<Complex>();
  CVec load(r.size());
  load.real() = scene.contacts.synchronous_load().cosine;
  load.imag() = -scene.contacts.synchronous_load().sine;
  const CVec eta = DenseLu<CMat>(Z).solve(CMat(r.M * load));
  const CVec full = scene.displacement_map() * eta;
  const auto states = bow_states(model.structure.bow, scene.assembler.mesh().z);
  for (std::size_t i = 0; i < states.size(); ++i) {
    EXPECT_NEAR(std::abs(full(static_cast<Eigen::Index>(4 * i)) - states[i].r), 0.0, 1e-9) << i;
  }
}

/// The same with a tube around it that turns the other way and is bent instead of it.
Model bent_tube(double Omega, ReductionMethod method) {
  Model model = bent_rotor(Omega, method);
  Structure& s = model.structure;
  s.unbalances.clear();
  Segment tube = cylinder(0.6, 0.09, 6);
  tube.left.inner = tube.right.inner = 0.07;
  s.rotors = {{.name = "tube", .ratio = -1.5, .z = 0.1, .shaft = {tube}, .bow = s.bow}};
  s.bow = {};
  const auto on_tube = [](double z) {
    return Station{.kind = Station::Kind::position, .z = z, .rotor = "tube"};
  };
  s.bearings.push_back(bearing(on_tube(0.1), orthotropic(4e6, 6e6, 800.0, 500.0)));
  s.bearings.push_back(connect(at(0.7), on_tube(0.7), orthotropic(5e6, 4e6, 300.0, 400.0)));
  return model;
}

// The response of `unbalance` to the bow of a further shaft is a motion of its order.
TEST(BowMotion, OfAFurtherShaftIsOneOfItsOrder) {
  constexpr double Omega = 200.0, order = 1.5;
  const Scene scene = make_scene(bent_tube(Omega, ReductionMethod::none));
  const std::vector<Excitation> loads = other_excitations(scene.assembler);
  ASSERT_EQ(loads.size(), 1u);
  ASSERT_EQ(loads[0].order, order);
  CVec q;
  for_each_oscillation(scene.assembler, loads[0], {Omega},
                       [&](Eigen::Index, double, const CVec& full) { q = full; });
  const auto n = q.size();
  ASSERT_EQ(scene.contacts.coordinates(), n);
  for (const double phase : {0.0, 1.1, 4.0}) {
    const CVec turned = q * std::polar(1.0, order * phase);
    Vec y(2 * n), a(n);
    y << turned.real(), (turned * Complex(0.0, order * Omega)).real();
    scene.contacts.acceleration(phase, y.data(), a.data());
    const Vec expected = -order * order * Omega * Omega * turned.real();
    EXPECT_LT((a - expected).norm(), 1e-6 * expected.norm()) << phase;
  }
}

// The reduction has the shape of that bow, too.
TEST(BowMotion, OfAFurtherShaftIsInTheFewShapesOfAReduction) {
  const Model model = bent_tube(0.01, ReductionMethod::modal_residual);
  const Scene scene = make_scene(model);
  const ReducedSystem& r = scene.reduced;
  EXPECT_LT(r.size(), 24);
  const ReducedExcitation& load = scene.contacts.excitations().back();
  CVec reduced(r.size());
  reduced.real() = load.cosine;
  reduced.imag() = -load.sine;
  const CVec eta = DenseLu<CMat>(CMat(r.K.cast<Complex>())).solve(CMat(r.M * reduced));
  const CVec full = scene.displacement_map() * eta;
  CVec expected;
  for_each_oscillation(scene.assembler, other_excitations(scene.assembler).at(0), {0.01},
                       [&](Eigen::Index, double, const CVec& q) { expected = q; });
  EXPECT_LT((full - expected).norm(), 1e-5 * expected.norm());
  EXPECT_GT(expected.cwiseAbs().maxCoeff(), 5e-5);
}

}  // namespace whirl::bow_motion_test
