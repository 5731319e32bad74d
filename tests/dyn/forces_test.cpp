// Forces that do not follow from the motion in the equations of motion: every method has the same
// motions, and simulations settle on the steady responses.

#include "tests/dyn/forces.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <string>

#include "libbase/error.hpp"
#include "libdyn/linear/frequency_response.hpp"
#include "libdyn/methods/collocation.hpp"
#include "libdyn/motions/equilibrium.hpp"
#include "libdyn/motions/start.hpp"
#include "libdyn/studies/map.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libfe/analyses/unbalance.hpp"
#include "libfe/assembly/excitations.hpp"

namespace whirl::motion_forces_test {

/// One of every kind.
std::vector<Force> every_kind() {
  return {{.at = body("rotor"), .size = 8.0, .angle = 1.0},
          {.at = body("pedestal"), .size = 5.0, .angle = 0.3, .order = 1.0, .phase = 0.2},
          {.at = body("rotor"), .size = 6.0, .turning = Turning::backward, .order = 2.0},
          {.kind = ForceKind::moment, .at = body("rotor"), .size = 0.7, .order = 1.5, .phase = 2.0},
          {.at = body("rotor"), .size = 9.0, .turning = Turning::forward, .frequency = 71.3},
          {.kind = ForceKind::base_acceleration, .size = 1.5, .angle = 0.9, .frequency = 23.7}};
}

/// Displacements of all points in the steady motion at an instant, by the solvers of libfe.
Vec steady(const Assembler& assembler, double Omega, double t) {
  const auto points = assembler.dofs().points();
  const System rest = assembler.uncondensed(Omega);
  Vec full = assembler.dofs().T * Mat(rest.K).partialPivLu().solve(
                                      Vec(rest.dofs.T.transpose() * static_load(assembler, Omega)));
  const auto add = [&](double w, const CVec& load) {
    const CMat Z = (Mat(rest.K) - w * w * Mat(rest.M)).cast<Complex>() +
                   Complex(0.0, w) * Mat(rest.D()).cast<Complex>();
    const CVec q = Z.partialPivLu().solve(rest.dofs.T.transpose() * load);
    full += assembler.dofs().T * (q * std::polar(1.0, w * t)).real();
  };
  add(Omega, sum_at(synchronous_excitations(assembler), assembler, Omega));
  for (const Excitation& load : other_excitations(assembler)) {
    add(load.frequency_at(Omega), load.amplitude);
  }
  return full;
}

double time_of(const Scene& scene, const MotionState& state) {
  return static_cast<double>(state.revolution) * scene.contacts.period() +
         state.phase / scene.contacts.phase_rate();
}

// After hundreds of damping times only the sum of all steady responses is left, at any instant.
TEST(MotionForces, SimulationsSettleOnTheSteadyResponses) {
  const Coupled rotor{.forces = every_kind()};
  const Scene scene = rotor.scene();
  MotionState state = start_of(rotor.model(), scene);
  run(scene, state, 150, {.tolerance = 1e-13});
  for (int i = 0; i < 3; ++i) {
    run(scene, state, 1, {.tolerance = 1e-13});
    const Vec expected = steady(scene.assembler, rotor.Omega, time_of(scene, state));
    EXPECT_LT((displacement(scene, state) - expected).norm(), 1e-10 * expected.norm());
  }
}

// The response of whirl frf is that of a simulation with the force.
TEST(MotionForces, FrequencyResponsesAreThoseOfSimulations) {
  constexpr double w = 2.0 * pi * 40.0, F = 3.0;
  const NamedPoint at_rotor{{Point::Kind::body, 0}, "rotor"};
  const NamedPoint at_pedestal{{Point::Kind::body, 1}, "pedestal"};
  using enum Direction;
  for (const Direction along : {x, y, forward, backward, theta_y}) {
    Force force{.at = body("rotor"), .size = F, .frequency = w};
    if (along == y) force.angle = pi / 2.0;
    if (along == forward) force.turning = Turning::forward;
    if (along == backward) force.turning = Turning::backward;
    if (along == theta_y) {
      force.kind = ForceKind::moment;
      force.angle = pi / 2.0;
    }
    Coupled rotor{.forces = {force}};
    const Scene scene = rotor.scene();
    MotionState state = start_of(rotor.model(), scene);
    run(scene, state, 150, {.tolerance = 1e-13});
    Coupled quiet{};
    const Scene without = quiet.scene();  // what the force does is the difference
    MotionState other = start_of(quiet.model(), without);
    run(without, other, 150, {.tolerance = 1e-13});
    const Vec moved = displacement(scene, state) - displacement(without, other);
    const FrequencyResponse found =
        frequency_response(scene.assembler, rotor.Omega, {w}, {{at_rotor, along}},
                           {{at_rotor, x},
                            {at_rotor, y},
                            {at_rotor, theta_x},
                            {at_rotor, theta_y},
                            {at_pedestal, x},
                            {at_pedestal, y}});
    const Complex turn = std::polar(F, w * time_of(scene, state));
    ASSERT_EQ(moved.size(), std::ssize(found.pairs));
    for (Eigen::Index i = 0; i < moved.size(); ++i) {
      const ResponsePair& pair = found.pairs[static_cast<std::size_t>(i)];
      const double size = F * std::abs(pair.receptance(0));  // zero where nothing couples
      EXPECT_NEAR(moved(i), (pair.receptance(0) * turn).real(), 1e-8 * size + 1e-17)
          << name_of(along) << " " << pair.to;
    }
  }
}

// A motion that nothing approximates: closed-form accelerations far from the start.
TEST(MotionForces, KeepTheirPhaseOverMillionsOfRevolutions) {
  const Coupled rotor{.forces = {{.at = body("rotor"), .size = 1.0, .order = 0.5},
                                 {.at = body("rotor"), .size = 1.0, .order = 1.0 / 3.0}}};
  const ContactSystem system = rotor.scene().contacts;
  ASSERT_EQ(system.other_loads().size(), 2u);
  EXPECT_EQ(system.repeats_after(), 6);
  for (const ReducedExcitation& o : system.other_loads()) {
    EXPECT_NEAR(std::remainder(start_angle(o.ratio, 6'000'000'001) - 2.0 * pi * o.order, 2.0 * pi),
                0.0, 1e-6 * (o.order == 0.5 ? 1e-9 : 1.0));
  }
}

/// The end of some revolutions by a method.
Vec end_of(const Coupled& rotor, const Scene& scene, std::string_view method, double tolerance,
           double step = 0.0) {
  MotionState state = start_of(rotor.model(), scene);
  const Integration done =
      run(scene, state, 7,
          {.tolerance = tolerance, .fixed_step = step, .method = method_named(method)});
  EXPECT_EQ(done.outcome, Outcome::reached_end) << method;
  return state.y;
}

// Every integrator but collocation, with and without contact; tolerances of a step are 1e-12.
TEST(MotionForces, AreTheSameForEveryMethod) {
  for (const double clearance : {0.0, 2e-4}) {
    const Coupled rotor{.forces = every_kind(), .clearance = clearance};
    const Scene scene = rotor.scene();
    const Vec reference = end_of(rotor, scene, "taylor", 1e-15);
    for (const std::string_view method : method_names()) {
      if (method == "collocation") continue;
      const bool is_fixed = method == "rk4";
      if (is_fixed && clearance > 0.0) continue;  // it has no events
      const Vec end = end_of(rotor, scene, method, 1e-12, is_fixed ? 2e-5 : 0.0);
      EXPECT_LT(distance(scene.contacts, end, reference), clearance > 0.0 ? 1e-6 : 1e-7) << method;
    }
    Trajectory quad{
        .system = &scene.contacts, .state = start_of(rotor.model(), scene), .revolutions = 7};
    integrate_quad(quad, {.tolerance = 1e-24});
    EXPECT_LT(distance(scene.contacts, quad.state.y, reference), 1e-10);
  }
}

TEST(MotionForces, CollocationRefusesThem) {
  const Coupled rotor{.forces = every_kind()};
  const Scene scene = rotor.scene();
  EXPECT_FALSE(Collocation::abilities.can(scene.contacts));
  MotionState state = start_of(rotor.model(), scene);
  EXPECT_THROW(run(scene, state, 1, {.method = method_named("collocation")}), ModelError);
}

// Lanes with other forces, fewer or none beside them change no bit; RK4 in lanes is RK4.
TEST(MotionForces, InLanesAreThoseAlone) {
  std::vector<Coupled> rotors;
  for (int i = 0; i < 9; ++i) {
    std::vector<Force> forces = every_kind();
    for (Force& f : forces) {
      if (f.frequency > 0.0) f.frequency *= 1.0 + 0.1 * i;
    }
    forces.resize(static_cast<std::size_t>(i) % (forces.size() + 1));
    rotors.push_back({.Omega = 50.0 + i, .forces = forces, .clearance = 2e-4});
  }
  Trajectories together, alone, stepped;
  for (const Coupled& rotor : rotors) {
    for (Trajectories* t : {&together, &alone, &stepped}) t->add(rotor, 6);
  }
  const BatchOptions how{.tolerance = 1e-10, .threads = 1};
  integrate_batch(together.all, how);
  for (Trajectory& t : alone.all) integrate_single(t, how);
  const IntegrationOptions fixed{.fixed_step = 1e-4};
  integrate_batch_rk4(stepped.all, fixed);
  for (std::size_t i = 0; i < rotors.size(); ++i) {
    EXPECT_EQ(together.all[i].state.y, alone.all[i].state.y) << i;
    MotionState state = start_of(rotors[i].model(), *stepped.scenes[i]);
    run(*stepped.scenes[i], state, 6, {.fixed_step = 1e-4, .method = method_named("rk4")});
    EXPECT_LT(distance(stepped.scenes[i]->contacts, state.y, stepped.all[i].state.y), 1e-2) << i;
  }
}

// A constant force is part of where a simulation starts.
TEST(MotionForces, ConstantOnesAreInTheStart) {
  const Coupled rotor{.forces = {{.at = body("rotor"), .size = 20.0}}};
  Model model = rotor.model();
  model.structure.gravity = 0.0;
  const Scene scene = make_scene(model);
  const MotionState state = start_of(model, scene);
  EXPECT_GT(displacement(scene, state)(0), 1e-4);
  EXPECT_EQ(state.y.head(scene.contacts.coordinates()), equilibrium(scene.contacts));
}

// Tolerances are told by how far a slow force moves the rotor, not by what it would do to a free
// mass.
TEST(MotionForces, ThatAreSlowHaveTheScaleOfWhatTheyMove) {
  const Coupled still{.forces = {{.at = body("rotor"), .size = 50.0}}};
  const Coupled slow{.forces = {{.at = body("rotor"), .size = 50.0, .frequency = 1e-3}}};
  EXPECT_LT(slow.scene().contacts.length_scale(), 2.0 * still.scene().contacts.length_scale());
}

// What is zero is no load: motions without it repeat as if it were not there.
TEST(MotionForces, OfSizeZeroAreNone) {
  const Coupled rotor{.forces = {{.at = body("rotor"), .size = 0.0, .frequency = 3.0}}};
  EXPECT_EQ(rotor.scene().contacts.repeats_after(), 1);
}

// Order 1 of a speed that is zero stands still.
TEST(MotionForces, OfAnOrderAreConstantAtRest) {
  const Coupled rotor{.Omega = 0.0, .forces = {{.at = body("rotor"), .size = 9.0, .order = 3.0}}};
  Coupled same = rotor;
  same.forces[0].order = 0.0;
  EXPECT_TRUE(rotor.scene().contacts.other_loads().empty());
  EXPECT_EQ(rotor.scene().contacts.constant_load(), same.scene().contacts.constant_load());
}

// So does order 1, as the response to it at rest has it: a simulation from its equilibrium stays
// there.
TEST(MotionForces, OfOrderOneAreConstantAtRest) {
  const Coupled rotor{.Omega = 0.0,
                      .forces = {{.at = body("rotor"), .size = 9.0, .order = 1.0, .phase = 1.0}}};
  Model model = rotor.model();
  model.structure.gravity = 0.0;
  const Scene scene = make_scene(model);
  EXPECT_TRUE(scene.contacts.synchronous_load().is_zero());
  MotionState state = start_of(model, scene);
  const Vec full = steady(scene.assembler, 0.0, 0.0);
  EXPECT_LT((displacement(scene, state) - full).norm(), 1e-12 * full.norm());
  const Vec before = state.y;
  run(scene, state, 2, {.tolerance = 1e-12});
  EXPECT_LT(distance(scene.contacts, state.y, before), 1e-10);
}

/// The band that a shaft at rest is reduced for under a force of a frequency; 0: without one.
double band_at_rest(double frequency) {
  Model model = TwoDiskRub{.speed = 0.0}.model();
  model.reduction = {.method = ReductionMethod::modal_residual};
  if (frequency > 0.0) {
    model.structure.forces = {{.at = node(4), .size = 5.0, .frequency = frequency}};
  }
  return make_scene(model).error.band;
}

// A slow force takes nothing off the band that is chosen without it, a fast one widens it.
TEST(MotionForces, WidenTheBandOfAReduction) {
  const double own = band_at_rest(0.0);
  EXPECT_GT(own, 10.0);
  EXPECT_EQ(band_at_rest(1.0), own);
  EXPECT_EQ(band_at_rest(2.0 * own), 3.0 * own);
}

// A frequency that no lane could follow fails at its speed, by the name of its force; others of a
// study go on.
TEST(MotionForces, ThatAreTooFastFailAtTheirSpeed) {
  const auto model_at = [](std::span<const double> values) {
    return Coupled{
        .Omega = values[0],
        .forces = {{.name = "horn", .at = body("rotor"), .size = 1.0, .frequency = 71.0}}}
        .model();
  };
  const MapResult points = map(study_models(model_at),
                               {.grid = {.axes = {{60.0, 0.001}}},
                                .classify = {.discard = 20, .revolutions = 20, .exponents = 20}});
  ASSERT_TRUE(points.points[0] && points.points[1]);
  EXPECT_FALSE(points.points[0]->has_failed());
  EXPECT_NE(points.points[1]->failure.text().find("force \"horn\""), std::string::npos)
      << points.points[1]->failure.text();
}

}  // namespace whirl::motion_forces_test
