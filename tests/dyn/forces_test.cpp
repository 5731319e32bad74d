// Forces that do not follow from the motion in the equations of motion: every method has the same
// motions, simulations settle on the steady responses, and orbits repeat with them.

#include "libfe/forces.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>

#include "libbase/error.hpp"
#include "libdyn/methods/collocation.hpp"
#include "libdyn/motions/equilibrium.hpp"
#include "libdyn/motions/frequency_response.hpp"
#include "libdyn/motions/start.hpp"
#include "libdyn/motions/transient.hpp"
#include "libdyn/motions/unbalance_study.hpp"
#include "libdyn/orbits/autonomous_orbit.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libdyn/orbits/contact_harmonics.hpp"
#include "libdyn/orbits/orbit_measure.hpp"
#include "libdyn/studies/classify.hpp"
#include "libdyn/studies/found_orbit.hpp"
#include "libdyn/studies/map.hpp"
#include "libdyn/studies/orbit_result.hpp"
#include "libdyn/studies/orbit_search.hpp"
#include "libdyn/studies/sweep.hpp"
#include "libdyn/studies/torus_branch.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libfe/unbalance.hpp"
#include "tests/support/oil_films.hpp"
#include "tests/support/trajectories.hpp"

namespace whirl::motion_forces_test {

using namespace test;

/// A rotor that tilts and spins in a pedestal, coupled across: no two coordinates are alike.
struct Coupled {
  double Omega = 60.0;
  std::vector<Force> forces{};
  double clearance = 0.0;  ///< of a ring between them; 0: none

  Model model() const {
    Model all;
    all.speed = Omega;
    all.has_speed = true;
    Structure& s = all.structure;
    s.bodies = {{.name = "rotor", .m = 3.0, .spins = true, .tilts = true, .Id = 0.05, .Ip = 0.08},
                {.name = "pedestal", .m = {4.0, 6.0}}};
    BearingCoefficients film = orthotropic(2e4, 3e4, 90.0, 120.0);
    film.K(0, 1) = 2e3;
    film.K(1, 0) = -3e3;
    film.Kt << 400.0, 30.0, 20.0, 500.0;
    film.Ct.diagonal().setConstant(2.0);
    s.bearings = {bearing(body("rotor"), film),
                  bearing(body("pedestal"), orthotropic(9e4, 5e4, 300.0, 200.0))};
    s.bearings[0].to = body("pedestal");
    s.unbalances = {{.at = body("rotor"), .moment = 1e-4, .phase = 0.5}};
    s.gravity = 9.81;
    s.forces = forces;
    if (clearance > 0.0) {
      all.contacts = {{.name = "ring",
                       .at = body("rotor"),
                       .against = body("pedestal"),
                       .clearance = clearance,
                       .friction = {.mu = 0.2, .radius = 0.05},
                       .law = Radial<>{.k = 1e6}}};
    }
    return all;
  }
  Scene scene() const { return make_scene(model()); }
};

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
                                      Vec(rest.dofs.T.transpose() * static_load(assembler)));
  const auto add = [&](double w, const CVec& load) {
    const CMat Z = (Mat(rest.K) - w * w * Mat(rest.M)).cast<Complex>() +
                   Complex(0.0, w) * Mat(rest.D()).cast<Complex>();
    const CVec q = Z.partialPivLu().solve(rest.dofs.T.transpose() * load);
    full += assembler.dofs().T * (q * std::polar(1.0, w * t)).real();
  };
  add(Omega, synchronous_load(assembler, Omega));
  for (const OscillatingLoad& load : oscillating_loads(assembler)) {
    add(load.at(Omega), load.amplitude);
  }
  return full;
}

Vec displacement(const Scene& scene, const MotionState& state) {
  return full_state(scene, state).displacement;
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
  ASSERT_EQ(system.oscillations().size(), 2u);
  EXPECT_EQ(system.repeats_after(), 6);
  for (const Oscillation& o : system.oscillations()) {
    EXPECT_NEAR(std::remainder(o.start_angle(6'000'000'001) - 2.0 * pi * o.order, 2.0 * pi), 0.0,
                1e-6 * (o.order == 0.5 ? 1e-9 : 1.0));
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
  EXPECT_FALSE(suits_collocation(scene.contacts));
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
    forces.resize(static_cast<std::size_t>(i % 7));
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

// Tolerances are told by how far a slow force moves the rotor, not by what it would do to a free mass.
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
  EXPECT_TRUE(rotor.scene().contacts.oscillations().empty());
  EXPECT_EQ(rotor.scene().contacts.constant_load(), same.scene().contacts.constant_load());
}

// So does order 1, as the response to it at rest has it: a simulation from its equilibrium stays there.
TEST(MotionForces, OfOrderOneAreConstantAtRest) {
  const Coupled rotor{.Omega = 0.0,
                      .forces = {{.at = body("rotor"), .size = 9.0, .order = 1.0, .phase = 1.0}}};
  Model model = rotor.model();
  model.structure.gravity = 0.0;
  const Scene scene = make_scene(model);
  EXPECT_TRUE(scene.contacts.cosine_load().isZero(0.0));
  EXPECT_TRUE(scene.contacts.sine_load().isZero(0.0));
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

// A frequency that no lane could follow fails at its speed, by the name of its force; others of a study
// go on.
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

/// P3, whose own motion repeats with the revolution, with forces along x.
Model rubbing(std::vector<Force> forces) {
  RotorStator rotor = P3;
  Model model = rotor.model();
  for (Force& f : forces) {
    f.at = body("rotor");
    f.size = 300.0;
  }
  model.structure.forces = std::move(forces);
  return model;
}

MotionState settled(const Model& model, const Scene& scene, long revolutions) {
  MotionState state = start_of(model, scene);
  run(scene, state, revolutions, {.tolerance = 1e-12});
  return state;
}

// Shooting and harmonic balance find the same orbit, whose period is that of the forces; a period
// that is not theirs is refused.
TEST(MotionForces, OfOrdersHaveOrbitsOfTheirPeriod) {
  const Model model = rubbing({{.order = 2.0}, {.order = 0.5}});
  const Scene scene = make_scene(model);
  const MotionState start = settled(model, scene, 400);
  const FoundOrbit shot = find_orbit_near(scene, start.y, {.period = 2});
  ASSERT_TRUE(shot.is_good()) << shot.failure.text();
  EXPECT_EQ(shot.shortest_period, 2);
  EXPECT_LT(distance(scene.contacts, shot.states[0], start.y), 1e-6);
  const FoundOrbit series = find_orbit_near(
      scene, start.y, {.method = OrbitMethod::harmonic_balance, .period = 2, .is_verified = true});
  ASSERT_TRUE(series.is_good()) << series.failure.text();
  EXPECT_EQ(series.shortest_period, 2);
  EXPECT_LT(distance(scene.contacts, shot.states[0], series.states[0]), 1e-3);
  ASSERT_TRUE(series.series && series.series->gap);
  EXPECT_LT(series.series->gap->displacement, 1e-3);
  EXPECT_THROW(find_orbit_near(scene, start.y, {.period = 1}), OptionError);
  EXPECT_THROW(
      find_orbit_near(scene, start.y, {.method = OrbitMethod::harmonic_balance, .period = 1}),
      OptionError);
}

// There is a state for every revolution of the period, each where the one before leads to.
TEST(MotionForces, OrbitsTellTheStartsOfAllRevolutions) {
  const Model model = rubbing({{.order = 0.5}});
  const Scene scene = make_scene(model);
  const FoundOrbit orbit = find_orbit_near(scene, settled(model, scene, 400).y, {.period = 4});
  ASSERT_TRUE(orbit.is_good()) << orbit.failure.text();
  ASSERT_EQ(orbit.states.size(), 4u);
  EXPECT_EQ(orbit_result(scene, orbit).displacement.cols(), 4);
  MotionState state;
  state.y = orbit.states[0];
  for (std::size_t i = 1; i < 4; ++i) {
    run(scene, state, 1, {.tolerance = 1e-13});
    EXPECT_LT(distance(scene.contacts, state.y, orbit.states[i]), 1e-8) << i;
  }
  EXPECT_GT(distance(scene.contacts, orbit.states[0], orbit.states[1]), 1e-4);
}

// Orbits begin where forces do: what leads to them ends there, however many revolutions are left out.
TEST(MotionForces, TransientsEndWhereForcesBeginAnew) {
  const Model model = rubbing({{.order = 0.5}});
  const Scene scene = make_scene(model);
  const MotionState start = start_of(model, scene);
  EXPECT_EQ(until_forces_repeat(scene.contacts, 401), 1);
  EXPECT_EQ(until_forces_repeat(scene.contacts, 402), 0);
  const Trajectory transient = run_transient(scene, start, {.revolutions = 401});
  EXPECT_EQ(transient.state.revolution, 402);
  const OrbitSearch search =
      search_orbits(scene, start, {.period = 2, .starts = 1, .discard = 401, .size = 1e-3}, {});
  ASSERT_EQ(search.orbits.size(), 1u);
  EXPECT_LT(search.orbits[0].orbit.residuals[0], 1e-5);  // as near as a motion that has settled
}

// A map or series that the forces do not fit is refused wherever it is asked for.
TEST(MotionForces, RefuseMapsAndSeriesOfOtherPeriods) {
  const Model model = rubbing({{.order = 0.5}});
  const Scene scene = make_scene(model);
  const Flow flow = flow_of(scene.contacts);
  PeriodicOrbit orbit{.period = 1, .states = {start_of(model, scene).y}};
  EXPECT_EQ(shoot(flow, orbit).size(), 0);
  EXPECT_NE(orbit.failure.text().find("repeat after 2 revolutions"), std::string::npos);
  const HarmonicProblem half = harmonic_problem(scene.contacts);
  EXPECT_NO_THROW(HarmonicEquations(half, 2, 4));
  EXPECT_THROW(HarmonicEquations(half, 1, 4), NumericalError);
  const Scene fast = make_scene(rubbing({{.order = 5.0}}));
  const HarmonicProblem fifth = harmonic_problem(fast.contacts);
  EXPECT_NO_THROW(HarmonicEquations(fifth, 1, 5));
  EXPECT_THROW(HarmonicEquations(fifth, 1, 4), NumericalError);
}

// The work of all forces is what damping and contact take: on an orbit the same by both series.
TEST(MotionForces, DoTheWorkThatIsMeasured) {
  const Model model = rubbing({{.order = 2.0}});
  const Scene scene = make_scene(model);
  const MotionState start = settled(model, scene, 400);
  const FoundOrbit orbit = find_orbit_near(scene, start.y, {.period = 1});
  ASSERT_TRUE(orbit.is_good());
  double dissipated = 0.0;
  Trajectory t{.system = &scene.contacts, .revolutions = 1};
  t.state.y = orbit.states[0];
  Vec y(8);
  std::vector<ContactForces> forces;
  const Mat C = scene.reduced.C;
  integrate_single(t, {.tolerance = 1e-13}, [&](const Step& step) {
    constexpr int parts = 40;
    for (int i = 0; i < parts; ++i) {
      const double s = (i + 0.5) / parts;
      step.at(s, y.data());
      double power = y.tail(4).dot(C * y.tail(4));
      scene.contacts.forces(step.instant(s), y.data(), step.contacts, forces);
      if (step.contacts[0].in_touch()) {
        const Vec2 on_rotor = -forces[0].normal * forces[0].n - forces[0].friction * forces[0].t();
        const Vec2 relative = scene.contacts.contacts()[0].U * y.tail(4);
        power -= on_rotor.dot(relative);
      }
      dissipated += step.h / parts * power;
    }
    return true;
  });
  const OrbitMeasure measure = measure_orbit(scene, {}, orbit.states[0], 1.0);
  EXPECT_NEAR(measure.work, dissipated, 1e-3 * std::abs(dissipated));
}

// A shaker makes a torus: it is classified so, though everything decays to it, and orbits, circles
// and branches refuse it.
TEST(MotionForces, OfTheirOwnFrequencyMakeTori) {
  const Model model = rubbing({{.frequency = 97.0}});
  const Scene scene = make_scene(model);
  EXPECT_EQ(scene.contacts.repeats_after(), 0);
  const Classification found =
      classify(scene.contacts, start_of(model, scene), {.discard = 300, .revolutions = 600});
  EXPECT_EQ(found.kind, MotionKind::quasi_periodic);
  EXPECT_LT(found.exponents(0), 0.0);
  try {
    flow_of(scene.contacts);
    FAIL() << "no error";
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("makes a torus"), std::string::npos) << error.what();
  }
  // at a speed of twice its frequency it is periodic all the same
  const Model chance = rubbing({{.frequency = 0.5 * P3.Omega}});
  const Scene locked = make_scene(chance);
  EXPECT_EQ(locked.contacts.repeats_after(), 2);
  EXPECT_EQ(classify(locked.contacts, start_of(chance, locked), {}).period, 2);
  EXPECT_THROW(flow_of(locked.contacts), ModelError);
  EXPECT_THROW(
      find_orbit_near(scene, start_of(model, scene).y, {.method = OrbitMethod::harmonic_balance}),
      ModelError);
  EXPECT_THROW(find_torus(scene, start_of(model, scene), {}), ModelError);
}

/// Without unbalance.
Model without_unbalance(double Omega, std::vector<Force> forces) {
  for (Force& f : forces) {
    f.at = body("rotor");
    f.size = 9.0;
  }
  Model model = Coupled{.Omega = Omega, .forces = std::move(forces)}.model();
  model.structure.unbalances.clear();
  return model;
}

// Alone a shaker makes a motion that repeats with it, spinning or not, and so do two in a simple ratio;
// what has the frequency of the speed, or another ratio, makes a torus.
TEST(MotionForces, OfTheirOwnFrequencyAloneArePeriodic) {
  using enum MotionKind;
  const auto kind = [](const Model& model) {
    const Scene scene = make_scene(model);
    EXPECT_EQ(scene.contacts.repeats_after(), 0);
    return classify(scene.contacts, start_of(model, scene), {.discard = 200, .revolutions = 300})
        .kind;
  };
  EXPECT_EQ(kind(without_unbalance(60.0, {{.frequency = 71.3}})), periodic);
  EXPECT_EQ(kind(without_unbalance(0.0, {{.frequency = 71.3}})), periodic);
  EXPECT_EQ(kind(without_unbalance(60.0, {{.frequency = 71.3}, {.frequency = 1.5 * 71.3}})),
            periodic);
  EXPECT_EQ(kind(without_unbalance(60.0, {{.frequency = 71.3}, {.frequency = 97.0 / 1.3}})),
            quasi_periodic);
  EXPECT_EQ(kind(without_unbalance(60.0, {{.frequency = 71.3}, {.order = 2.0}})), quasi_periodic);
  EXPECT_EQ(
      kind(Coupled{.forces = {{.at = body("rotor"), .size = 9.0, .frequency = 71.3}}}.model()),
      quasi_periodic);
}

// A sweep of one value, up and down, is one motion that goes on: the shaker is never begun anew.
TEST(MotionForces, GoOnFromValueToValueOfASweep) {
  const Coupled rotor{.forces = {{.at = body("rotor"), .size = 9.0, .frequency = 71.3}}};
  const SweepResult found =
      sweep(study_models([&](std::span<const double>) { return rotor.model(); }),
            {.values = {0.0, 1.0},
             .classify = {.discard = 20, .revolutions = 10, .exponents = 10, .tolerance = 1e-12}});
  ASSERT_EQ(found.points.size(), 4u);
  const Scene scene = rotor.scene();
  MotionState state = start_of(rotor.model(), scene);
  for (const std::size_t point : {0u, 1u, 3u, 2u}) {
    run(scene, state, 30, {.tolerance = 1e-13});
    const SweepEnd end = found.points[point].value().end;
    EXPECT_EQ(end.revolution, state.revolution);
    const Vec expected = displacement(scene, state);
    EXPECT_LT((end.displacement - expected).norm(), 1e-8 * expected.norm()) << point;
  }
  EXPECT_FALSE(found.leaves_out("end_revolution"));
}

// Periods of motions under fractions are multiples of their denominator, and proven with it.
TEST(MotionForces, OfFractionsAreClassifiedWithTheirPeriod) {
  const Model model = rubbing({{.order = 1.0 / 3.0}});
  const Scene scene = make_scene(model);
  const Classification found =
      classify(scene.contacts, start_of(model, scene), {.discard = 500, .revolutions = 200});
  EXPECT_EQ(found.kind, MotionKind::periodic);
  EXPECT_EQ(found.period, 3);
  EXPECT_TRUE(found.is_proven);
}

/// The study of the response over speeds that it chooses, to a force of twice the speed.
UnbalanceStudy response_to_twice(const Model& model, double first, double last) {
  return unbalance_study(model, Assembler(linear_structure(model)),
                         {.speeds = {first, last}, .has_given_speeds = false, .stations = {}});
}

// The peaks of an order are found where modes depend on the speed by oil films, and of free rotors: two
// masses m on a spring k meet 2x at half of sqrt(2 k / m), damped.
TEST(MotionForces, HaveThePeaksOfTheirOrdersOnFilmsAndFree) {
  MassOnFilm rotor{};
  Model on_film = rotor.model();
  on_film.films[0].is_linearized = true;
  on_film.structure.forces = {{.at = on_film.films[0].at, .size = 1.0, .order = 2.0}};
  const UnbalanceStudy film = response_to_twice(on_film, 50.0, 500.0);
  EXPECT_FALSE(film.failure) << film.failure.text();

  constexpr double m = 2.0, k = 1e4, c = 2.0;
  Model free;
  Structure& s = free.structure;
  s.bodies = {{.name = "a", .m = m, .spins = true}, {.name = "b", .m = m, .spins = true}};
  s.links = {bearing(body("a"), isotropic(k, c))};
  s.links[0].to = body("b");
  s.forces = {{.at = body("a"), .size = 1.0, .order = 2.0}};
  const UnbalanceStudy study = response_to_twice(free, 10.0, 200.0);
  EXPECT_FALSE(study.failure) << study.failure.text();
  const double w = std::sqrt(2.0 * k / m), decay = c / m;
  const double damped = std::sqrt(w * w - decay * decay);
  for (const double widths : {-1.0, 0.0, 1.0}) {
    const double expected = 0.5 * (damped + widths * decay);
    const bool is_there = std::any_of(study.speeds.begin(), study.speeds.end(), [&](double speed) {
      return std::abs(speed - expected) < 0.01 * decay;
    });
    EXPECT_TRUE(is_there) << expected;
  }
}

// In the frame of the rotor a forward force of order 1 stands still, others do not.
TEST(MotionForces, OfOtherOrdersAreRefusedInTheRotatingFrame) {
  const auto flow = [](const Force& f) {
    TwoDiskRub rotor{};
    Model model = rotor.model();
    model.structure.forces = {f};
    return rotating_flow(std::make_shared<const Scene>(make_scene(model)));
  };
  EXPECT_NO_THROW(flow({.at = node(4), .size = 5.0, .turning = Turning::forward, .order = 1.0}));
  EXPECT_THROW(flow({.at = node(4), .size = 5.0, .turning = Turning::backward, .order = 1.0}),
               NumericalError);
  EXPECT_THROW(flow({.at = node(4), .size = 5.0, .turning = Turning::forward, .order = 2.0}),
               NumericalError);
  EXPECT_THROW(flow({.at = node(4), .size = 5.0}), NumericalError);
}

}  // namespace whirl::motion_forces_test
