// Which scenes serve for which other models. That a family of models takes over nothing else is
// shown by tests/io/model_family_test.cpp.

#include "libdyn/system/scene_beside.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "tests/support/scenes.hpp"

namespace whirl::scene_beside_test {

using Change = std::function<void(Model&)>;

/// Whether the scene of a model serves for one that is changed; then it is that of the whole model.
bool serves(const Model& model, const Change& change) {
  const Scene scene = make_scene(model, ReductionEstimate::no);
  Model changed = model;
  change(changed);
  const auto beside = scene_beside(scene, changed);
  if (!beside) return false;
  const Scene whole = make_scene(changed, ReductionEstimate::no);
  EXPECT_EQ(beside->system.Omega, changed.speed);
  EXPECT_EQ(beside->reduced.Phi, whole.reduced.Phi);
  EXPECT_EQ(beside->contacts.K(), whole.contacts.K());
  EXPECT_EQ(beside->contacts.D(), whole.contacts.D());
  EXPECT_EQ(beside->contacts.constant_load(), whole.contacts.constant_load());
  EXPECT_EQ(beside->contacts.synchronous_load().cosine, whole.contacts.synchronous_load().cosine);
  return true;
}

Model rotor(const Reduction& how) {
  Model m = test::TwoDiskRub{}.model();
  m.reduction = how;
  Force shaken{.name = "ground", .kind = ForceKind::base_acceleration, .size = 0.1};
  shaken.frequency = 200.0;
  m.structure.forces = {{.name = "pump", .at = test::node(5), .size = 20.0, .frequency = 250.0},
                        shaken};
  return m;
}

const Change faster = [](Model& m) { m.speed *= 1.1; };
const Change heavier = [](Model& m) { m.structure.unbalances[0].moment *= 2.0; };
const Change in_gravity = [](Model& m) { m.structure.gravity = 9.81; };
const Change in_a_wider_ring = [](Model& m) { m.contacts[0].clearance *= 2.0; };
const Change pumped_faster = [](Model& m) { m.structure.forces[0].frequency = 3000.0; };
const Change shaken_harder = [](Model& m) { m.structure.forces[1].size *= 2.0; };
const Change stiffer = [](Model& m) {
  m.structure.bearings[0].coefficients = constant_bearing(test::isotropic(5e6, 5e3));
};
const Change bent = [](Model& m) {
  m.structure.bow = {.z = {0.0, 0.3, 0.6}, .x = {0.0, 1e-5, 0.0}, .y = {0.0, 0.0, 0.0}};
};

TEST(SceneBeside, ServesWhereMeshMatricesAndShapesAreTheSame) {
  const Model modal = rotor({.method = ReductionMethod::modal_residual, .modes = 8});
  for (const Change& change : {faster, heavier, in_gravity, in_a_wider_ring, pumped_faster}) {
    EXPECT_TRUE(serves(modal, change));
  }
  for (const Change& change : {stiffer, bent, shaken_harder}) {
    EXPECT_FALSE(serves(modal, change));
  }
}

// All freedoms have no shapes that a load could change.
TEST(SceneBeside, OfAWholeRotorServesForAllLoads) {
  const Model whole = rotor({.method = ReductionMethod::none});
  for (const Change& change : {faster, heavier, bent, shaken_harder, pumped_faster}) {
    EXPECT_TRUE(serves(whole, change));
  }
  EXPECT_FALSE(serves(whole, stiffer));
}

TEST(SceneBeside, ServesAtOtherSpeedsWhereTheShapesDoNotFollowTheSpeed) {
  const Model damped = rotor({.method = ReductionMethod::damped, .modes = 8});
  EXPECT_FALSE(serves(damped, faster));
  EXPECT_TRUE(serves(damped, heavier));
  const Model tolerant = rotor({.method = ReductionMethod::modal, .tolerance = 1e-2});
  EXPECT_FALSE(serves(tolerant, faster));
  EXPECT_FALSE(serves(tolerant, pumped_faster));  // a wider band may ask for more modes
  EXPECT_TRUE(serves(tolerant, heavier));
  Model turning = rotor({.method = ReductionMethod::modal_residual, .modes = 8});
  turning.structure.shaft[0].material.eta = 1e-5;  // damping that rotates
  EXPECT_TRUE(serves(turning, faster));
}

}  // namespace whirl::scene_beside_test
