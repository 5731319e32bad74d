// Orbits, tori and studies of rotors under forces repeat as their forces do.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "libbase/error.hpp"
#include "libdyn/linear/unbalance_study.hpp"
#include "libdyn/motions/start.hpp"
#include "libdyn/motions/transient.hpp"
#include "libdyn/orbits/autonomous_orbit.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libdyn/orbits/contact_harmonics.hpp"
#include "libdyn/orbits/orbit_measure.hpp"
#include "libdyn/studies/classify.hpp"
#include "libdyn/studies/found_orbit.hpp"
#include "libdyn/studies/orbit_result.hpp"
#include "libdyn/studies/orbit_search.hpp"
#include "libdyn/studies/sweep.hpp"
#include "libdyn/studies/torus_branch.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libdyn/taylor/batch.hpp"
#include "tests/dyn/forces.hpp"
#include "tests/support/oil_films.hpp"

namespace whirl::motion_forces_test {

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

// Orbits begin where forces do: what leads to them ends there, however many revolutions are left
// out.
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

// Alone a shaker makes a motion that repeats with it, spinning or not, and so do two in a simple
// ratio; what has the frequency of the speed, or another ratio, makes a torus.
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

// The peaks of an order are found where modes depend on the speed by oil films, and of free rotors:
// two masses m on a spring k meet 2x at half of sqrt(2 k / m), damped.
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
