// Rotors on oil films in time: closed forms, agreement of methods, tangents, and what happens at
// the wall.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "libbase/error.hpp"
#include "libdyn/motions/equilibrium.hpp"
#include "libdyn/studies/classify.hpp"
#include "libdyn/taylor/batch.hpp"
#include "tests/support/oil_films.hpp"
#include "tests/support/trajectories.hpp"

namespace whirl::oil_film_test {

using std::numbers::pi;
using test::MassOnFilm;
using test::TwoDisksOnFilms;

std::vector<AnyMethod> methods() {
  return {Taylor{}, Dop853{}, CvodeAdams{}, CvodeBdf{}, Arkode{}, ArkodeDirk{}, Rk4{}};
}

template <class Rotor>
MotionState settled(const Rotor& rotor, const Scene& scene, long revolutions) {
  MotionState state = test::start_of(rotor.model(), scene);
  const Integration run = test::run(scene, state, revolutions, {.tolerance = 1e-11});
  EXPECT_EQ(run.outcome, Outcome::reached_end) << run.failure;
  return state;
}

Trajectory quad(const ContactSystem& system, const MotionState& start, long revolutions,
                const BatchOptions& options) {
  Trajectory t{.system = &system, .state = start, .revolutions = revolutions};
  integrate_quad(t, options);
  EXPECT_EQ(t.outcome, Outcome::reached_end) << t.failure;
  return t;
}

// V(u) of the short bearing on the line of the squeeze, w = 0.
double V(double u) {
  const double Q = (1.0 - u) * (1.0 + u), root = std::sqrt(Q);
  return (2.0 + u * 2.0 / root * std::atan2(root, -u)) / Q;
}

// Without spin and weight a journal thrown from the center is stopped by the oil alone:
//
//   m C e'' = -2 s e' V'(e)   =>   m C e' = m C v - 2 s (V(e) - V(0))
//
// with s = viscosity R L^3 / (4 C^2). It creeps to where this is zero, with a mass that makes it
// creep at 40 / s; thrown hard, that is near the wall.
TEST(OilFilm, StopsAThrownJournalWhereTheImpulseSays) {
  const auto expect_stop = [](double e, const AnyMethod& method) {
    MassOnFilm rotor{.Omega = 0.0, .gravity = 0.0};
    const double C = rotor.bearing.clearance, s = Short::factor(rotor.bearing), de = 1e-6;
    rotor.m = 2.0 * s * (V(e + de) - V(e - de)) / (2.0 * de) / 40.0;
    const Scene scene = rotor.scene();
    const double v = 2.0 * s * (V(e) - V(0.0)) / rotor.m;  // [m/s]
    MotionState state = test::state_of(Vec2::Zero(), {0.6 * v, -0.8 * v});
    const Integration run = test::run(scene, state, 1, {.tolerance = 1e-10, .method = method});
    EXPECT_EQ(run.outcome, Outcome::reached_end) << run.failure;
    constexpr double bound = 1e-6;  // what steps of 1e-10 add up to at the wall, and creeping
    EXPECT_NEAR(state.y(0) / C, 0.6 * e, bound) << name_of_method(method);
    EXPECT_NEAR(state.y(1) / C, -0.8 * e, bound) << name_of_method(method);
  };
  for (const AnyMethod& method : methods()) {
    if (!std::holds_alternative<Rk4>(method)) expect_stop(0.9, method);  // its first steps jump
  }
  for (const AnyMethod& method :
       {AnyMethod(Taylor{}), AnyMethod(Dop853{}), AnyMethod(ArkodeDirk{})})
    expect_stop(0.9975, method);
}

// Ocvirk's bearing: the weight and the eccentricity at which it lies, below to the side of the
// spin.
TEST(OilFilm, CarriesAJournalWhereTheTextbookSays) {
  for (const double e : {0.05, 0.5, 0.95}) {
    MassOnFilm rotor;
    const double Q = 1.0 - e * e;
    const double load = Short::factor(rotor.bearing) * rotor.Omega * e *
                        std::sqrt(16.0 * e * e + pi * pi * Q) / (Q * Q);
    rotor.m = load / rotor.gravity;
    rotor.offset = {2e-3, -1e-3};
    const Scene scene = rotor.scene();
    const MotionState start = test::start_of(rotor.model(), scene);
    const Vec2 place = (Vec2(start.y.head(2)) - rotor.offset) / rotor.bearing.clearance;
    EXPECT_NEAR(place.norm(), e, 1e-10);
    EXPECT_NEAR(place(0) / -place(1), pi * std::sqrt(Q) / (4.0 * e), 1e-8 * pi / (4.0 * e));
    // and stays there
    MotionState state = start;
    const Integration run = test::run(scene, state, 1, {.tolerance = 1e-12});
    EXPECT_EQ(run.outcome, Outcome::reached_end) << run.failure;
    EXPECT_LT(distance(scene.contacts, state.y, start.y), 1e-8);
  }
}

// A shaft of finite elements, reduced to few shapes, that nothing but two films holds: both carry
// half of its weight, and it starts there.
TEST(OilFilm, CarriesAReducedShaft) {
  Model model;
  model.speed = 300.0;
  model.has_speed = true;
  Structure& s = model.structure;
  s.shaft = {test::cylinder(0.6, 0.04, 12)};
  s.shaft[0].material = test::steel(7800.0);
  s.disks = {{.at = test::node(7), .m = 20.0, .Id = 0.1, .Ip = 0.2}};
  s.unbalances = {{.at = test::node(7), .moment = 4e-4}};
  s.gravity = 9.81;
  for (const int node : {2, 12}) {
    model.films.push_back(
        {.name = "film",
         .at = test::node(node),
         .bearing = {.radius = 0.02, .length = 0.016, .clearance = 5e-5, .viscosity = 0.02}});
  }
  const Scene scene = make_scene(model);
  const ContactSystem& system = scene.contacts;
  EXPECT_LT(system.coordinates(), 30);
  const MotionState start = test::start_of(model, scene);
  const double weight = 9.81 * (20.0 + 7800.0 * pi * 0.02 * 0.02 * 0.6);
  for (const ReducedFilm& film : system.films()) {
    const Vec2 force = film_force(film, start.y.data(), system.coordinates());
    EXPECT_NEAR(force(0), 0.0, 1e-6 * weight);
    EXPECT_NEAR(force(1), 0.5 * weight, 1e-6 * weight);
  }
  MotionState a = start, b = start;
  const Integration taylor = test::run(scene, a, 2, {.tolerance = 1e-11}),
                    bdf = test::run(scene, b, 2, {.tolerance = 1e-11, .method = CvodeBdf{}});
  EXPECT_EQ(taylor.outcome, Outcome::reached_end) << taylor.failure;
  EXPECT_EQ(bdf.outcome, Outcome::reached_end) << bdf.failure;
  EXPECT_LT(distance(system, a.y, b.y), 1e-5);
}

TEST(OilFilm, SaysThatItCarriesNothingWithoutSpin) {
  const MassOnFilm rotor{.Omega = 0.0};
  const Scene scene = rotor.scene();
  try {
    test::start_of(rotor.model(), scene);
    ADD_FAILURE() << "found an equilibrium";
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("oil films"), std::string::npos) << error.what();
  }
}

// At rest in the center the squeeze is zero and the film has no Taylor series.
TEST(OilFilm, CanStartAtRestInTheCenter) {
  const MassOnFilm rotor{.U = 2e-5};
  const Scene scene = rotor.scene();
  const MotionState start = test::state_of(Vec::Zero(4));
  const Trajectory exact = quad(scene.contacts, start, 2, {.tolerance = 1e-22, .order = 24});
  for (const AnyMethod& method : methods()) {
    MotionState state = start;
    const Integration run = test::run(scene, state, 2, {.tolerance = 1e-11, .method = method});
    EXPECT_EQ(run.outcome, Outcome::reached_end) << run.failure;
    const double bound = std::holds_alternative<Taylor>(method) ? 1e-9 : 1e-5;
    EXPECT_LT(distance(scene.contacts, state.y, exact.state.y), bound) << name_of_method(method);
  }
}

struct Agreement {
  AnyMethod method;
  double tolerance, bound;
};

// Two films and two rubbing disks, 1/1: every method against quadruple precision, whose own error
// is shown by another order and tolerance.
TEST(OilFilm, MovesTheTwoDisksAlikeByEveryMethod) {
  const TwoDisksOnFilms rotor;
  const Scene scene = rotor.scene();
  const ContactSystem& system = scene.contacts;
  const MotionState start = settled(rotor, scene, 60);
  const Trajectory exact = quad(system, start, 1, {.tolerance = 1e-22, .order = 24}),
                   other = quad(system, start, 1, {.tolerance = 1e-18, .order = 20});
  EXPECT_LT(
      distance(system, exact.state.y - other.state.y, other.lower_digits - exact.lower_digits),
      1e-14);
  for (const auto& [method, tolerance, bound] :
       {Agreement{Taylor{}, 1e-13, 1e-11}, Agreement{Dop853{}, 1e-13, 1e-10},
        Agreement{CvodeAdams{}, 1e-12, 1e-8}, Agreement{CvodeBdf{}, 1e-12, 1e-7},
        Agreement{Arkode{}, 1e-12, 1e-8}, Agreement{ArkodeDirk{}, 1e-11, 1e-7},
        Agreement{Rk4{}, 1e-13, 1e-3}}) {
    MotionState state = start;
    const Integration run = test::run(scene, state, 1, {.tolerance = tolerance, .method = method});
    EXPECT_EQ(run.outcome, Outcome::reached_end) << run.failure;
    EXPECT_LT(distance(system, state.y, exact.state.y), bound) << name_of_method(method);
  }
}

// Steps of fixed size: a step of order N leaves (h / radius)^(N+2) in the velocity. In quadruple
// precision: in double what is left at steps this short is below rounding.
TEST(OilFilm, KeepsTheOrderOfTheSeries) {
  const MassOnFilm rotor{.m = 2.0, .U = 1e-4};
  const Scene scene = rotor.scene();
  const ContactSystem& system = scene.contacts;
  const MotionState start = settled(rotor, scene, 10);
  const Trajectory exact = quad(system, start, 1, {.tolerance = 1e-28});
  std::vector<double> number, error;
  for (const double steps : {80.0, 113.0, 160.0, 226.0, 320.0}) {
    const Trajectory t =
        quad(system, start, 1, {.fixed_step = system.period() / steps, .order = 8});
    number.push_back(steps);
    error.push_back(
        distance(system, t.state.y - exact.state.y, exact.lower_digits - t.lower_digits));
  }
  EXPECT_NEAR(test::order_of(number, error), 9.0, 0.3);
}

/// Speeds and viscosities around those of the study.
test::Trajectories sample(int count, long revolutions) {
  test::Trajectories all;
  for (int i = 0; i < count; ++i) {
    all.add(TwoDisksOnFilms{.Omega = 250.0 + 35.0 * i, .viscosity = 0.005 + 0.003 * (i % 7)},
            revolutions);
  }
  return all;
}

void expect_same_as_alone(const BatchOptions& options, int count, long revolutions) {
  const test::Trajectories all = sample(count, revolutions);
  std::vector<Trajectory> batch = all.all;
  integrate_batch(batch, options);
  for (std::size_t i = 0; i < batch.size(); ++i) {
    Trajectory alone = all.all[i];
    integrate_single(alone, options);
    EXPECT_EQ(alone.outcome, Outcome::reached_end) << alone.failure;
    EXPECT_EQ(batch[i].state.y, alone.state.y) << i;
    EXPECT_EQ(batch[i].cost.steps, alone.cost.steps) << i;
    EXPECT_EQ(batch[i].cost.events, alone.cost.events) << i;
    EXPECT_EQ(batch[i].sections, alone.sections) << i;
    EXPECT_EQ(batch[i].exponents, alone.exponents) << i;
    EXPECT_EQ(batch[i].tangent, alone.tangent) << i;
  }
}

TEST(OilFilm, GivesEachTrajectoryOfABatchWhatItIsAlone) {
  expect_same_as_alone({.tolerance = 1e-9, .sections = true}, 20, 20);
}
TEST(OilFilm, GivesEachTrajectoryOfABatchItsExponents) {
  expect_same_as_alone({.tolerance = 1e-8, .exponents = true}, 6, 2);
}

// RK4 in lanes takes the steps of RK4 alone.
TEST(OilFilm, MovesAlikeByRk4InLanes) {
  const test::Trajectories all = sample(6, 1);
  std::vector<Trajectory> batch = all.all;
  const IntegrationOptions fine{.tolerance = 1e-13};  // near the wall RK4 is at its limit with 1000
  integrate_batch_rk4(batch, fine);
  for (std::size_t i = 0; i < batch.size(); ++i) {
    MotionState state = all.all[i].state;
    const Integration run = Rk4::integrate(*all.all[i].system, state, 1, fine, {});
    EXPECT_EQ(run.outcome, Outcome::reached_end) << run.failure;
    EXPECT_EQ(batch[i].outcome, Outcome::reached_end) << batch[i].failure;
    EXPECT_LT(distance(*all.all[i].system, batch[i].state.y, state.y), 1e-9) << i;
  }
}

/// Largest difference of a tangent from central differences of motions, in scaled coordinates.
double tangent_error(const ContactSystem& system, const MotionState& start) {
  constexpr double h = 1e-6;
  const auto end = [&](MotionState from, bool tangent) {
    Trajectory t{.system = &system, .state = std::move(from), .revolutions = 1};
    integrate_single(t, {.tolerance = 1e-14, .tangent = tangent});
    EXPECT_EQ(t.outcome, Outcome::reached_end) << t.failure;
    return t;
  };
  const Mat tangent = end(start, true).tangent;
  const Vec& scale = system.state_scale();
  double worst = 0.0;
  for (int i = 0; i < system.size(); ++i) {
    MotionState up = start, down = start;
    up.y(i) += h * scale(i);
    down.y(i) -= h * scale(i);
    const Vec change = (end(up, false).state.y - end(down, false).state.y) / (2.0 * h);
    worst = std::max(
        worst, ((change - tangent.col(i) * scale(i)).cwiseQuotient(scale)).cwiseAbs().maxCoeff());
  }
  return worst;
}

// One revolution of the tangent, which is the films' analytic Jacobian along the motion.
TEST(OilFilm, HasTheTangentOfItsMotions) {
  for (const double Omega : {300.0, 460.0}) {  // free, and with rubs
    const TwoDisksOnFilms rotor{.Omega = Omega};
    const Scene scene = rotor.scene();
    EXPECT_LT(tangent_error(scene.contacts, settled(rotor, scene, 60)), 1e-7) << Omega;
  }
}

// The exponents sum to the mean divergence of the flow, of which the films have a part of their
// own.
TEST(OilFilm, HasExponentsThatSumToTheDivergence) {
  const TwoDisksOnFilms rotor;
  const Scene scene = rotor.scene();
  Trajectory t{.system = &scene.contacts, .state = settled(rotor, scene, 60), .revolutions = 5};
  integrate_single(t, {.tolerance = 1e-11, .exponents = true});
  EXPECT_NEAR(t.exponents.sum() / t.divergence, 1.0, 1e-8);
}

// Beyond the clearance there is no film: an error by every method, with its name and its place.
TEST(OilFilm, RefusesAJournalOutsideItsBearing) {
  const MassOnFilm rotor;
  const Scene scene = rotor.scene();
  for (const double e : {1.0, 1.2}) {
    const MotionState start = test::state_of({0.0, -e * rotor.bearing.clearance}, {0.0, 0.0});
    const auto expect_refused = [&](Outcome outcome, const Failure& failure, std::string_view who) {
      EXPECT_EQ(outcome, Outcome::left_bearing) << who << ": " << failure;
      EXPECT_NE(failure.text().find("\"film\""), std::string::npos) << who << ": " << failure;
      EXPECT_NE(failure.text().find("of its clearance"), std::string::npos)
          << who << ": " << failure;
    };
    for (const AnyMethod& method : methods()) {
      MotionState state = start;
      const Integration run = test::run(scene, state, 1, {.method = method});
      expect_refused(run.outcome, run.failure, name_of_method(method));
    }
    Trajectory t{.system = &scene.contacts, .state = start, .revolutions = 1};
    Trajectory in_quad = t;
    std::vector<Trajectory> lanes(3, t), rk4_lanes(3, t);
    lanes[1].state = rk4_lanes[1].state = test::start_of(rotor.model(), scene);  // a good one
    integrate_quad(in_quad, {});
    expect_refused(in_quad.outcome, in_quad.failure, "quad");
    integrate_batch(lanes, {});
    integrate_batch_rk4(rk4_lanes, {});
    for (const auto* batch : {&lanes, &rk4_lanes}) {
      expect_refused((*batch)[0].outcome, (*batch)[0].failure, "batch");
      EXPECT_EQ((*batch)[1].outcome, Outcome::reached_end) << (*batch)[1].failure;
    }
  }
}

// A heavy rotor on thin oil comes within 0.5 % of the wall. Steps of fixed size leave the bearing,
// which RK4 must say; those with error control follow the wall.
TEST(OilFilm, FollowsTheWall) {
  MassOnFilm rotor{.Omega = 200.0, .m = 60.0, .U = 0.15};
  rotor.bearing.viscosity = 0.001;
  const Scene scene = rotor.scene();
  const ContactSystem& system = scene.contacts;
  const MotionState start = test::state_of(Vec::Zero(4));
  double nearest = 0.0;
  MotionState state = start;
  const Observer watch = [&](const Step& step) {
    Vec y(4);
    step.at(1.0, y.data());
    nearest = std::max(nearest, eccentricity(system.films()[0], y.data(), 2));
    return true;
  };
  const Integration taylor = test::run(scene, state, 3, {.tolerance = 1e-12}, watch);
  ASSERT_EQ(taylor.outcome, Outcome::reached_end) << taylor.failure;
  EXPECT_GT(nearest, 0.995);
  const Trajectory exact = quad(system, start, 3, {.tolerance = 1e-20, .order = 22});
  EXPECT_LT(distance(system, state.y, exact.state.y), 1e-7);
  for (const AnyMethod& method : {AnyMethod(Dop853{}), AnyMethod(CvodeBdf{})}) {
    MotionState other = start;
    const Integration run = test::run(scene, other, 3, {.tolerance = 1e-12, .method = method});
    ASSERT_EQ(run.outcome, Outcome::reached_end) << run.failure;
    EXPECT_LT(distance(system, other.y, exact.state.y), 1e-4) << name_of_method(method);
  }
  MotionState coarse = start;
  const Integration rk4 =
      test::run(scene, coarse, 3, {.fixed_step = system.period() / 250.0, .method = Rk4{}});
  EXPECT_EQ(rk4.outcome, Outcome::left_bearing) << rk4.failure;
  EXPECT_EQ(system.left_bearing(coarse.y.data()), nullptr);  // the last good state
}

TEST(OilFilm, IsNotForCollocation) {
  const TwoDisksOnFilms rotor;
  const Scene scene = rotor.scene();
  EXPECT_EQ(name_of_method(suitable_method(scene.contacts)), "taylor");
  MotionState state = test::start_of(rotor.model(), scene);
  EXPECT_THROW(test::run(scene, state, 1, {.method = Collocation{}}), ModelError);
}

// A journal in a bearing on springs: the film pushes both, action and reaction.
TEST(OilFilm, PushesTheBearingBack) {
  MassOnFilm rotor{.U = 2e-5};
  Model model = rotor.model();
  model.structure.bodies.push_back({.name = "housing", .m = 3.0});
  model.films[0].against = test::body("housing");
  const Scene scene = make_scene(model);
  const ContactSystem& system = scene.contacts;
  Vec y(8), a(4);
  y << 2e-5, -3e-5, 1e-5, 2e-5, 0.01, 0.02, -0.01, 0.03;
  system.acceleration(0.3, y.data(), a.data());
  const double turning = 2e-5 * rotor.Omega * rotor.Omega;
  EXPECT_NEAR(10.0 * a(0) + 3.0 * a(2), turning * std::cos(0.3), 1e-10);
  EXPECT_NEAR(10.0 * a(1) + 3.0 * a(3), turning * std::sin(0.3) - 13.0 * 9.81, 1e-10);
}

/// Impacts of a ring per revolution and its duty cycle, over revolutions at a speed.
struct Rub {
  double impacts, duty;
};

/// Goes on from a motion at another speed, as an up-sweep does: the state is carried over.
Rub carried_to(double Omega, MotionState& state, long revolutions) {
  const TwoDisksOnFilms rotor{.Omega = Omega};
  const Scene scene = rotor.scene();
  const BatchOptions options{.tolerance = 1e-8, .measures = true};
  Trajectory t{.system = &scene.contacts, .revolutions = revolutions};
  t.state = state.y.size() > 0 ? test::state_of(state.y) : test::start_of(rotor.model(), scene);
  integrate_single(t, {.tolerance = 1e-8});
  EXPECT_EQ(t.outcome, Outcome::reached_end) << t.failure;
  t.revolutions = 16;
  integrate_single(t, options);
  EXPECT_EQ(t.outcome, Outcome::reached_end) << t.failure;
  state = t.state;
  return {t.contacts[0].impacts / 16.0, t.contacts[0].in_touch / (16.0 * scene.contacts.period())};
}

// "Double-rotor system under the coupling of rubbing and oil-film force", found with the usual set
// of data by an independent program: no rub at 200 rad/s, the rub begins at 334.6, at 460 one
// impact a revolution, duty cycle 0.109.
TEST(TwoDisksOnFilms, RubAsAnIndependentProgramFindsOnTheWayUp) {
  constexpr double digits = 1e-3;  // of its duty cycle
  MotionState state;
  EXPECT_EQ(carried_to(200.0, state, 30).impacts, 0.0);
  EXPECT_EQ(carried_to(334.0, state, 100).impacts, 0.0);
  EXPECT_EQ(carried_to(335.2, state, 100).impacts, 1.0);
  const Rub rub = carried_to(460.0, state, 100);
  EXPECT_EQ(rub.impacts, 1.0);
  EXPECT_NEAR(rub.duty, 0.109, digits);
}

// At 660 rad/s three impacts in four revolutions, at 705 six in eight (printed); duty cycle 0.089,
// of the independent program.
TEST(TwoDisksOnFilms, RubInFourAndInEightRevolutions) {
  constexpr double digits = 1e-3;
  MotionState state;
  for (const double Omega : {600.0, 630.0}) carried_to(Omega, state, 100);
  const Rub four = carried_to(660.0, state, 150);
  EXPECT_EQ(four.impacts, 0.75);
  EXPECT_NEAR(four.duty, 0.089, digits);
  EXPECT_EQ(carried_to(705.0, state, 150).impacts, 0.75);
}

}  // namespace whirl::oil_film_test
