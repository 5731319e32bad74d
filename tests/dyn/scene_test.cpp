// From a model to where its motion starts.

#include "libdyn/system/scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "libbase/error.hpp"
#include "libdyn/motions/start.hpp"
#include "libfe/analyses/modes.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::scene_test {

using test::MassInRing;
using test::rpm;
using test::TwoDiskRub;

constexpr double rounding = 1e-10;  // of eigenvectors and solutions of 52 equations, relative

TEST(StartState, FromRestIsZero) {
  Model model = MassInRing{.gravity = 9.81}.model();
  model.start.from = StartFrom::rest;
  const MotionState state = test::start_of(model, make_scene(model));
  EXPECT_EQ(state.y, Vec::Zero(4));
  EXPECT_EQ(state.revolution, 0);
  EXPECT_EQ(state.phase, 0.0);
  EXPECT_TRUE(state.contacts.empty());  // to be found from the state
}

// The sag m g / k, at rest; without gravity nothing.
TEST(StartState, FromEquilibriumSags) {
  const MassInRing p{.gravity = 9.81};
  EXPECT_NEAR(test::start_of(p.model(), p.scene()).y(1), -p.m * p.gravity / p.k, 1e-12 * 1e-3);
  EXPECT_EQ(test::start_of(p.model(), p.scene()).y.tail(2), Vec::Zero(2));
  const MassInRing light{};
  EXPECT_EQ(test::start_of(light.model(), light.scene()).y, Vec::Zero(4));
}

TEST(StartState, FromEquilibriumOfAFreeRotorIsRefused) {
  const MassInRing p{.k = 0.0, .gravity = 9.81};
  EXPECT_THROW(test::start_of(p.model(), p.scene()), ModelError);
}

// A complex mode: q = Re(a e^(i phase) shape), q' = Re(lambda ...). Its largest lateral radius is
// a, and without contact and unbalance it moves on as e^(lambda t).
TEST(StartState, OfAModeMovesAsTheMode) {
  const double amplitude = 2e-3, phase = 0.7;
  Model model = TwoDiskRub{.speed = 4430.0 * rpm, .contact_nodes = {}}.model();
  model.reduction.method = ReductionMethod::damped;
  model.structure.unbalances.clear();
  const Scene scene = make_scene(model);
  const std::vector<Mode> modes = complex_modes(scene.system, 2).oscillatory;
  for (const int number : {1, 2}) {
    model.start.whirl = {{.mode = number, .amplitude = amplitude, .phase = phase}};
    MotionState state = test::start_of(model, scene);
    const FullState start = full_state(scene, state);
    double radius = 0.0;
    for (const Point& p : scene.system.dofs.points()) {
      radius = std::max(radius, std::hypot(start.displacement(scene.system.dofs.full_index(p, X)),
                                           start.displacement(scene.system.dofs.full_index(p, Y))));
    }
    EXPECT_NEAR(radius, amplitude, rounding * amplitude);  // circular orbits: at any phase

    const Mode& mode = modes[static_cast<std::size_t>(number - 1)];
    test::run(scene, state, 1, {.tolerance = 1e-12});
    const Complex factor =
        std::polar(amplitude, phase) * std::exp(mode.lambda * scene.contacts.period());
    const Vec expected = (scene.system.dofs.T * (factor * mode.shape)).real();
    EXPECT_LT((full_state(scene, state).displacement - expected).lpNorm<Eigen::Infinity>(),
              1e-8 * amplitude);  // of the integration and of the basis
  }
}

TEST(StartState, AddsModesToTheSag) {
  Model model = TwoDiskRub{.gravity = 9.81}.model();
  const Scene scene = make_scene(model);
  const Vec sag = test::start_of(model, scene).y;
  model.start.whirl = {{.mode = 1, .amplitude = 1e-3}};
  const Vec first = test::start_of(model, scene).y - sag;
  model.start.whirl = {{.mode = 2, .amplitude = 2e-3, .phase = 1.0}};
  const Vec second = test::start_of(model, scene).y - sag;
  model.start.whirl = {{.mode = 1, .amplitude = 1e-3}, {2, 2e-3, 1.0}};
  const Vec both = test::start_of(model, scene).y;
  EXPECT_GT(sag.norm(), 0.0);
  EXPECT_LT((both - (sag + first + second)).norm(), rounding * both.norm());
}

// A place that is moved aside and thrown is there, with that velocity; the stator stays.
TEST(StartState, OfADisplacedPlaceIsWhereItIsTold) {
  Model model = test::P1.model();
  model.structure.gravity = 0.0;
  model.start.displaced = {
      {.at = test::body("rotor"), .x = 1e-3, .y = 2e-3, .vx = 0.3, .vy = -0.4}};
  const Scene scene = make_scene(model);
  const FullState state = full_state(scene, test::start_of(model, scene));
  const Vec displacement{{1e-3, 2e-3, 0.0, 0.0}}, velocity{{0.3, -0.4, 0.0, 0.0}};
  EXPECT_LT((state.displacement - displacement).norm(), rounding * displacement.norm());
  EXPECT_LT((state.velocity - velocity).norm(), rounding * velocity.norm());
}

TEST(StartState, OfAModeThatDoesNotExistIsRefused) {
  Model model = MassInRing{}.model();
  for (const int number : {0, 3, 99}) {
    model.start.whirl = {{.mode = number, .amplitude = 1e-3}};
    EXPECT_THROW(test::start_of(model, make_scene(model)), ModelError) << number;
  }
}

// The end of a result is a start again, whatever the reduction; a basis that contains the motion
// gives the same coordinates back.
TEST(StartState, FromAResultIsWhereItEnded) {
  Model model = TwoDiskRub{.speed = 4430.0 * rpm}.model();
  const Scene scene = make_scene(model);
  MotionState end = test::start_of(model, scene);
  end.y.setRandom();
  const FullState full = full_state(scene, end);
  model.start.from = StartFrom::file;
  const MotionState same = start_state(model, scene, &full);
  EXPECT_LT(distance(scene.contacts, same.y, end.y), 1e-9 / scene.contacts.length_scale());

  Model all = model;
  all.reduction = {.method = ReductionMethod::none};
  const Scene fine = make_scene(all);
  const FullState again = full_state(fine, start_state(all, fine, &full));
  EXPECT_LT((again.displacement - full.displacement).norm(), rounding * full.displacement.norm());
  EXPECT_LT((again.velocity - full.velocity).norm(), rounding * full.velocity.norm());

  EXPECT_THROW(start_state(model, scene, nullptr), ModelError);
  const FullState foreign{Vec::Zero(4), Vec::Zero(4)};
  EXPECT_THROW(start_state(model, scene, &foreign), ModelError);
}

}  // namespace whirl::scene_test
