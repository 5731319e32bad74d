// Derivatives of motions by parameters, against differences of motions in quadruple precision.

#include "libdyn/taylor/motion_slopes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libdyn/taylor/batch.hpp"
#include "tests/support/bladed_disk.hpp"
#include "tests/support/oil_films.hpp"
#include "tests/support/overhung_disk.hpp"
#include "tests/support/rotor_in_bearing.hpp"
#include "tests/support/saturated_magnet.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::motion_slopes_test {

using test::RotorStator;

/// A number of a model that derivatives are taken by.
struct Knob {
  std::string name;
  std::function<double&(Model&)> of;
  double size = 0.0;                             ///< where it is zero
  std::function<void(Model&)> follow = nullptr;  ///< sets what else is the same number

  Model set(Model m, double value) const {
    of(m) = value;
    if (follow) follow(m);
    return m;
  }
};

Radial<>& radial(Model& m, std::size_t i = 0) {
  return std::get<Radial<>>(m.contacts[i].law);
}
Knob stiffness() {
  return {"stiffness", [](Model& m) -> double& { return radial(m).k; }};
}
Knob damping() {
  return {"damping", [](Model& m) -> double& { return radial(m).c; }};
}
Knob hertz() {
  return {"hertz", [](Model& m) -> double& { return std::get<Hertz<>>(m.contacts[0].law).k; }};
}
Knob dissipation(double size = 0.0) {
  return {"dissipation",
          [](Model& m) -> double& { return std::get<Hertz<>>(m.contacts[0].law).alpha; }, size};
}
Knob friction(std::size_t i = 0) {
  return {"friction", [i](Model& m) -> double& { return m.contacts[i].friction.mu; }};
}
Knob clearance(std::size_t i = 0) {
  return {"clearance", [i](Model& m) -> double& { return m.contacts[i].clearance; }};
}
Knob offset(int axis, double size) {
  return {"offset", [axis](Model& m) -> double& { return m.contacts[0].offset(axis); }, size};
}
Knob radius() {
  return {"radius", [](Model& m) -> double& { return m.contacts[0].friction.radius; }};
}
Knob slip_tolerance() {
  return {"slip_tolerance", [](Model& m) -> double& { return m.contacts[0].friction.tolerance; }};
}
Knob speed() {
  return {"speed", [](Model& m) -> double& { return m.speed; }};
}
Knob unbalance() {
  return {"unbalance", [](Model& m) -> double& { return m.structure.unbalances[0].moment; }};
}
Knob mass(std::size_t body) {
  return {"mass", [body](Model& m) -> double& { return m.structure.bodies[body].m.x; }, 0.0,
          [body](Model& m) { m.structure.bodies[body].m.y = m.structure.bodies[body].m.x; }};
}
ConstantBearing& coefficients(Model& m, std::size_t i) {
  return std::get<ConstantBearing>(m.structure.bearings[i].coefficients);
}
Knob bearing_stiffness(std::size_t i) {
  return {"kxx", [i](Model& m) -> double& { return coefficients(m, i).K(0, 0); }};
}
Knob bearing_damping(std::size_t i) {
  return {"cyy", [i](Model& m) -> double& { return coefficients(m, i).C(1, 1); }};
}

/// A motion whose derivatives are looked at.
struct Rig {
  Model model;
  long settle = 0;  ///< revolutions before
  long revolutions = 1;
};

constexpr double asked = 1e-9;  ///< relative difference of slopes, at most

/// A model whose knobs are turned together.
Model turned(Model model, const std::vector<Knob>& knobs, const Vec& by) {
  for (std::size_t i = 0; i < knobs.size(); ++i) {
    model = knobs[i].set(model, knobs[i].of(model) + by(static_cast<Eigen::Index>(i)));
  }
  return model;
}

MotionState settled(const Scene& scene, const Rig& rig) {
  MotionState state = test::start_of(rig.model, scene);
  test::run(scene, state, rig.settle, {.tolerance = 1e-12});
  return state;
}

SystemSlope slope(const Scene& scene, const Model& model, const Knob& knob) {
  Model at = model;
  return slope_of(knob.name, scene, knob.of(at), knob.size,
                  [&](double value) { return knob.set(model, value); });
}

/// Change of the end of a motion with the knobs turned as far as `by` says, of that: a difference
/// of the fourth order.
Vec quad_change(const Rig& rig, const Scene& scene, const MotionState& start,
                const std::vector<Knob>& knobs, const Vec& by) {
  const auto change = [&](double times) {
    Vec sum = Vec::Zero(scene.contacts.size());
    for (const double sign : {1.0, -1.0}) {
      const Scene beside = make_scene(turned(rig.model, knobs, sign * times * by));
      EXPECT_EQ(beside.reduced.Phi, scene.reduced.Phi);  // every freedom
      Trajectory t{.system = &beside.contacts, .state = start, .revolutions = rig.revolutions};
      integrate_quad(t, {.tolerance = 1e-19, .order = 22});
      EXPECT_EQ(t.outcome, Outcome::reached_end) << t.failure;
      if (sign > 0.0) {
        sum = t.state.y;
      } else {
        sum -= t.state.y;
      }
      sum += sign * t.lower_digits;
    }
    return sum;
  };
  return (8.0 * change(1.0) - change(2.0)) / 12.0;
}

/// How far knobs are turned, of themselves: coefficients that are rounded to double leave 3e-11,
/// and curvature of motions that are not wild less.
constexpr double turn = 0x1p-18;

/// That a column is what it is alone, in another lane, bit by bit, and that the motion is, too.
void expect_same_alone(const ContactSystem& system, const MotionState& start, double end,
                       const std::vector<SystemSlope>& parameters, const SlopeOptions& options,
                       const MotionSlopes& together) {
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto alone = motion_slopes(system, start, {{end}}, {&parameters[i], 1}, options);
    EXPECT_EQ(alone.states, together.states) << i;
    EXPECT_EQ(alone.by_parameter[0].col(0),
              together.by_parameter[0].col(static_cast<Eigen::Index>(i)))
        << i;
  }
}

/// Compares derivatives at the end, for all knobs turned together, each so that what it does adds
/// up with what the first one does.
MotionSlopes expect_differences(const Rig& rig, const std::vector<Knob>& knobs,
                                double least = asked) {
  const Scene scene = make_scene(rig.model);
  const ContactSystem& system = scene.contacts;
  const MotionState start = settled(scene, rig);
  std::vector<SystemSlope> parameters;
  for (const Knob& knob : knobs) parameters.push_back(slope(scene, rig.model, knob));
  const double end = static_cast<double>(rig.revolutions) * system.period();
  const SlopeOptions options{.tolerance = 1e-16, .by_start = false, .held = HeldSample::phase};
  const MotionSlopes found = motion_slopes(system, start, {{end}}, parameters, options);
  EXPECT_EQ(found.outcome, Outcome::reached_end) << found.failure;
  expect_same_alone(system, start, end, parameters, options, found);

  const Vec to_scale = system.state_scale().cwiseInverse();
  const auto count = static_cast<Eigen::Index>(knobs.size());
  Vec size(count), effect(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    Model model = rig.model;
    const Knob& knob = knobs[static_cast<std::size_t>(i)];
    size(i) = std::exp2(std::floor(std::log2(knob.size > 0.0 ? knob.size : knob.of(model))));
    const Vec change = to_scale.cwiseProduct(found.by_parameter[0].col(i)) * size(i);
    effect(i) = change.cwiseAbs().maxCoeff();
    EXPECT_GT(effect(i), 0.0) << knob.name;
  }
  Vec by(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double share = std::max(effect.minCoeff() / effect(i), 0.25);
    const double along = found.by_parameter[0].col(i).cwiseProduct(to_scale).dot(
        found.by_parameter[0].col(0).cwiseProduct(to_scale));
    by(i) = std::copysign(turn * size(i) * std::exp2(std::floor(std::log2(share))), along);
  }
  const Vec known = to_scale.cwiseProduct(quad_change(rig, scene, start, knobs, by));
  const Vec told = to_scale.cwiseProduct(found.by_parameter[0] * by);
  EXPECT_LT((told - known).cwiseAbs().maxCoeff(), least * known.cwiseAbs().maxCoeff());
  return found;
}

long jumps(const MotionSlopes& m) {
  return std::count_if(m.events.begin(), m.events.end(), [](const auto& e) { return e.jumps; });
}

TEST(MotionSlopes, AreTheLimitOfDifferencesThroughSixtyImpacts) {
  const auto found = expect_differences(
      {.model = test::P1.model(), .settle = 100, .revolutions = 6},
      {stiffness(), friction(), clearance(), offset(0, 1e-3), offset(1, 1e-3), speed(), unbalance(),
       mass(0), mass(1), bearing_stiffness(0), bearing_damping(1)});
  EXPECT_GE(found.events.size(), 50u);
}

TEST(MotionSlopes, AreTheLimitOfDifferencesWithDampedContacts) {
  RotorStator p = test::P1;
  p.cC = 2e4;
  const auto found =
      expect_differences({.model = p.model(), .settle = 50, .revolutions = 6},
                         {stiffness(), damping(), friction(), clearance(), speed(), mass(1)});
  EXPECT_GE(found.events.size(), 50u);
  EXPECT_GE(jumps(found), 15);
}

// In contact for long, in few revolutions: quadruple precision takes its time near the surfaces of
// laws that have no series there.
TEST(MotionSlopes, AreTheLimitOfDifferencesOfHertzContacts) {
  RotorStator p = test::P1;
  p.kH = 1.5e8;
  const auto found =
      expect_differences({.model = p.model(), .settle = 50, .revolutions = 30},
                         {hertz(), dissipation(1.0), friction(), clearance(), speed()});
  EXPECT_GE(found.events.size(), 50u);
}

TEST(MotionSlopes, AreTheLimitOfDifferencesOfDampedHertzContacts) {
  RotorStator p = test::P1;
  p.kH = 1.5e8;
  p.alpha = 0.5;
  const auto found = expect_differences({.model = p.model(), .settle = 50, .revolutions = 30},
                                        {dissipation(), hertz(), friction(), clearance(), speed()});
  EXPECT_GE(found.events.size(), 50u);
  EXPECT_EQ(jumps(found), 0);
}

// Shaken on a stop below it, so that the contact lets go and pushes again, and comes off.
TEST(MotionSlopes, AreTheLimitOfDifferencesWhereDampedHertzContactsLetGo) {
  Model model =
      test::MassInRing{
          .k = 50.0, .c = 5.0, .U = 1.7e-3, .kH = 1e5, .alpha = 30.0, .mu = 0.1, .gravity = 9.81}
          .model();
  model.contacts[0].geometry = geometry::Stop{.angle = -0.5 * test::pi};
  const auto found = expect_differences({.model = model, .settle = 10, .revolutions = 10},
                                        {dissipation(), hertz(), clearance(), speed()});
  const auto pulls = std::count_if(found.events.begin(), found.events.end(),
                                   [](const auto& e) { return e.kind == EventKind::pull; });
  EXPECT_GE(pulls, 10);
}

TEST(MotionSlopes, AreTheLimitOfDifferencesIntoRolling) {
  const RotorStator rolling{.Omega = 151.8462, .kC = 3.07445e6, .mu = 0.2625};
  const auto found =
      expect_differences({.model = rolling.model(), .settle = 25, .revolutions = 29},
                         {stiffness(), friction(), clearance(), radius(), speed(), mass(1)});
  EXPECT_GE(jumps(found), 1);
}

TEST(MotionSlopes, AreTheLimitOfDifferencesWhereContactsStickAndSlip) {
  const RotorStator p{.Omega = 151.8462, .kC = 3.07445e6, .mu = 0.5, .R = 0.005};
  const auto found =
      expect_differences({.model = p.model(), .settle = 10, .revolutions = 6},
                         {stiffness(), friction(), clearance(), radius(), speed(), mass(1)});
  EXPECT_GE(found.events.size(), 50u);
  EXPECT_GE(jumps(found), 15);
  EXPECT_TRUE(found.grazes.empty());
}

TEST(MotionSlopes, AreTheLimitOfDifferencesWithSmoothedFriction) {
  RotorStator p = test::P1;
  p.slip_tolerance = 1.0;
  const auto found =
      expect_differences({.model = p.model(), .settle = 50, .revolutions = 6},
                         {stiffness(), friction(), radius(), slip_tolerance(), speed()});
  EXPECT_GE(found.events.size(), 50u);
}

TEST(MotionSlopes, AreTheLimitOfDifferencesAtAStop) {
  RotorStator p = test::P1;
  p.cC = 1e3;
  Model model = p.model();
  model.contacts[0].geometry = geometry::Stop{.angle = 2.2};
  const auto found = expect_differences(
      {.model = model, .settle = 20, .revolutions = 30},
      {stiffness(), damping(), friction(), clearance(), offset(0, 1e-3), speed()});
  EXPECT_GE(found.events.size(), 50u);
}

TEST(MotionSlopes, AreTheLimitOfDifferencesAtAnEllipse) {
  const Knob aspect{"aspect", [](Model& m) -> double& {
                      return std::get<geometry::Ellipse>(m.contacts[0].geometry).aspect;
                    }};
  const Knob angle{"angle", [](Model& m) -> double& {
                     return std::get<geometry::Ellipse>(m.contacts[0].geometry).angle;
                   }};
  RotorStator p = test::P1;
  p.cC = 1e3;
  p.slip_tolerance = 1.0;
  Model model = p.model();
  model.contacts[0].geometry = geometry::Ellipse{.angle = 0.4, .aspect = 1.2};
  const auto found = expect_differences(
      {.model = model, .settle = 20, .revolutions = 10},
      {stiffness(), damping(), friction(), clearance(), offset(0, 1e-3), aspect, angle, speed()});
  EXPECT_GE(found.events.size(), 20u);
}

TEST(MotionSlopes, AreTheLimitOfDifferencesAtAFace) {
  const Knob face_stiffness{
      "face stiffness", [](Model& m) -> double& { return std::get<Face<>>(m.contacts[1].law).k; }};
  const Knob face_radius{"face radius", [](Model& m) -> double& {
                           return std::get<Face<>>(m.contacts[1].law).radius;
                         }};
  const Knob disk_mass{"disk", [](Model& m) -> double& { return m.structure.disks[0].m; }};
  const Knob spin_inertia{"Ip", [](Model& m) -> double& { return m.structure.disks[0].Ip; }};
  const auto found = expect_differences(
      {.model = test::overhung_disk_with_smooth_face(), .settle = 20, .revolutions = 8},
      {face_stiffness, face_radius, friction(1), clearance(1), stiffness(), speed(), disk_mass,
       spin_inertia});
  EXPECT_GE(found.events.size(), 50u);
}

BladeTip<>& tips(Model& m) {
  return std::get<BladeTip<>>(m.contacts[0].law);
}

TEST(MotionSlopes, AreTheLimitOfDifferencesOfBlades) {
  const std::vector<Knob> knobs{
      {"tip stiffness", [](Model& m) -> double& { return tips(m).k; }},
      {"tip radius", [](Model& m) -> double& { return tips(m).tip_radius; }},
      {"blade length", [](Model& m) -> double& { return tips(m).blade_length; }},
      {"bending stiffness", [](Model& m) -> double& { return tips(m).bending_stiffness; }},
      friction(),
      clearance(),
      speed()};
  const auto found =
      expect_differences({.model = test::bladed_disk(), .settle = 5, .revolutions = 13}, knobs);
  EXPECT_GE(found.events.size(), 50u);
}

geometry::RollingElements& elements(Model& m) {
  return std::get<geometry::RollingElements>(m.contacts[0].geometry);
}

TEST(MotionSlopes, AreTheLimitOfDifferencesOfRollingBearings) {
  const auto of_shape = [](std::size_t i, double geometry::RaceShape::*member) {
    return [=](Model& m) -> double& { return elements(m).shapes[i].*member; };
  };
  const std::vector<Knob> knobs{{"play", [](Model& m) -> double& { return elements(m).play; }},
                                {"height", of_shape(0, &geometry::RaceShape::height)},
                                {"sharpness", of_shape(2, &geometry::RaceShape::sharpness)},
                                hertz(),
                                speed(),
                                mass(0)};
  const Rig rig{.model = test::rotors_in_bearings().back().model(), .settle = 2};
  EXPECT_GE(expect_differences(rig, knobs).events.size(), 4u);
  // steps of the cage's ratio are rounded to doubles: known to 1e-8 or so
  expect_differences(rig, {{"cage", [](Model& m) -> double& { return elements(m).cage; }}}, 1e-6);
}

TEST(MotionSlopes, AreTheLimitOfDifferencesOfRollers) {
  const std::vector<Knob> knobs{
      {"line", [](Model& m) -> double& { return std::get<Line<>>(m.contacts[0].law).k; }}};
  expect_differences(
      {.model = test::rotors_in_bearings()[2].model(), .settle = 5, .revolutions = 7}, knobs);
}

TEST(MotionSlopes, AreTheLimitOfDifferencesOfSaturatedMagnets) {
  for (const test::InMagneticBearing& rotor : test::saturated_magnets()) {
    const std::vector<Knob> knobs{speed(), unbalance(), mass(0)};
    EXPECT_GE(expect_differences({.model = rotor.model(), .settle = 2}, knobs).events.size(), 2u);
  }
}

TEST(MotionSlopes, AreTheLimitOfDifferencesOnOilFilms) {
  std::vector<Knob> knobs{
      {"viscosity", [](Model& m) -> double& { return m.films[0].bearing.viscosity; }},
      {"film clearance", [](Model& m) -> double& { return m.films[0].bearing.clearance; }},
      {"film length", [](Model& m) -> double& { return m.films[0].bearing.length; }},
      speed(),
      unbalance()};
  test::MassOnFilm mass;
  mass.U = 1e-3;
  Model model = mass.model();
  for (const Knob& knob : {stiffness(), friction(), clearance()}) knobs.push_back(knob);
  model.contacts.push_back({.name = "ring",
                            .at = model.films[0].at,
                            .clearance = 0.4 * mass.bearing.clearance,
                            .friction = {.mu = 0.1, .slip = Slip::forward},
                            .law = Radial<>{.k = 1e8}});
  const auto found = expect_differences({.model = model, .settle = 5, .revolutions = 5}, knobs);
  EXPECT_GE(found.events.size(), 50u);
  const test::TwoDisksOnFilms disks;
  expect_differences({.model = disks.model(), .settle = 20, .revolutions = 1}, knobs);
}

TEST(MotionSlopes, AreTheLimitOfDifferencesUnderForcesOfOtherFrequencies) {
  Model model = test::P1.model();
  const Station rotor = test::body("rotor");
  model.structure.forces = {{.at = rotor, .size = 300.0, .frequency = 97.0},
                            {.at = rotor, .size = 200.0, .angle = 0.3, .order = 0.5}};
  const std::vector<Knob> knobs{
      speed(),
      {"force", [](Model& m) -> double& { return m.structure.forces[0].size; }},
      {"frequency", [](Model& m) -> double& { return m.structure.forces[0].frequency; }},
      {"of order 1/2", [](Model& m) -> double& { return m.structure.forces[1].size; }}};
  expect_differences({.model = model, .settle = 20, .revolutions = 3}, knobs);
}

/// A motion with damped impacts and two parameters, one of them the speed.
struct DampedImpacts {
  Model model;
  Scene scene;
  MotionState start;
  std::vector<SystemSlope> parameters;

  DampedImpacts() : model(damped()), scene(make_scene(model)) {
    start = settled(scene, {.model = model, .settle = 50});
    for (const Knob& knob : {friction(), speed()}) {
      parameters.push_back(slope(scene, model, knob));
    }
  }
  static Model damped() {
    RotorStator p = test::P1;
    p.cC = 2e4;
    return p.model();
  }
  double period() const { return scene.contacts.period(); }
};

/// Largest difference of matrices of slopes, relative.
double difference(const Mat& a, const Mat& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

// What happens in two windows is what happens in one:  dy2 = (dy2 / dy1) dy1 + dy2|y1.
TEST(MotionSlopes, OfTwoWindowsMakeThoseOfOne) {
  const DampedImpacts m;
  const double first = 1.37 * m.period(), second = 2.21 * m.period();
  for (const HeldSample held : {HeldSample::time, HeldSample::phase}) {
    const SlopeOptions how{.tolerance = 1e-15, .held = held};
    const ContactSystem& system = m.scene.contacts;
    const auto whole = motion_slopes(system, m.start, {{first, first + second}}, m.parameters, how);
    const auto half = motion_slopes(system, m.start, {{first}}, m.parameters, how);
    const auto rest = motion_slopes(system, half.end, {{second}}, m.parameters, how);
    constexpr double bound = 1e-11;
    EXPECT_LT(difference(rest.by_start[0] * half.by_start[0], whole.by_start[1]), bound);
    Mat by = rest.by_parameter[0] + rest.by_start[0] * half.by_parameter[0];
    if (held == HeldSample::time) by = by.leftCols(1).eval();  // the speed turns the next start
    EXPECT_LT(difference(by, whole.by_parameter[1].leftCols(by.cols())), bound);
  }
}

// At a fixed time the rotor has turned further with the speed:  y_p|time = y_p|phase + t y' /
// Omega. Steps that end at events, as deviations need them, do not change it, not even just behind
// a jump of the acceleration.
TEST(MotionSlopes, AtFixedTimeAndAtFixedPhaseDifferByHowFarItTurns) {
  const DampedImpacts m;
  const ContactSystem& system = m.scene.contacts;
  SlopeOptions how{.tolerance = 1e-15, .by_start = false};
  const double late = 3.4 * m.period();
  const auto events = motion_slopes(system, m.start, {{late}}, m.parameters, how).events;
  const auto hit = std::ranges::find_if(events, &MotionEvent::jumps);
  ASSERT_NE(hit, events.end());
  for (const double time : {late, hit->time + 1e-3 * m.period()}) {
    how.held = HeldSample::phase;
    how.deviations = Mat();
    const auto at_phase = motion_slopes(system, m.start, {{time}}, m.parameters, how);
    how.held = HeldSample::time;
    const auto at_time = motion_slopes(system, m.start, {{time}}, m.parameters, how);
    how.deviations = Mat::Identity(8, 1);
    const auto deviating = motion_slopes(system, m.start, {{time}}, m.parameters, how);
    const MotionState& end = at_time.end;
    Vec rate(system.size()), a(system.coordinates());
    system.acceleration(end.instant(), end.y.data(), end.contacts, a.data());
    rate << end.y.tail(system.coordinates()), a;
    const Vec turned = at_phase.by_parameter[0].col(1) + time / system.Omega() * rate;
    EXPECT_LT(difference(at_time.by_parameter[0].col(1), turned), 1e-11);
    EXPECT_EQ(at_time.by_parameter[0].col(0), at_phase.by_parameter[0].col(0));
    EXPECT_EQ(at_time.states, at_phase.states);
    EXPECT_LT(difference(deviating.by_parameter[0], at_time.by_parameter[0]), 1e-10);
  }
}

// Nothing depends on what else is asked for, bit by bit.
TEST(MotionSlopes, AreInLanesWhatTheyAreAlone) {
  const DampedImpacts m;
  const std::vector<double> times{0.0, 0.5 * m.period(), 4.0 * m.period()};
  const auto together = motion_slopes(m.scene.contacts, m.start, times, m.parameters, {});
  EXPECT_EQ(together.by_start[0], Mat::Identity(8, 8));
  EXPECT_EQ(together.by_parameter[0], Mat::Zero(8, 2));
  for (std::size_t i = 0; i < m.parameters.size(); ++i) {
    const auto alone =
        motion_slopes(m.scene.contacts, m.start, times, {&m.parameters[i], 1}, {.by_start = false});
    EXPECT_EQ(alone.states, together.states);
    for (std::size_t k = 0; k < times.size(); ++k) {
      EXPECT_EQ(alone.by_parameter[k].col(0),
                together.by_parameter[k].col(static_cast<Eigen::Index>(i)));
    }
  }
  const auto motion = motion_slopes(m.scene.contacts, m.start, times, {}, {.by_start = false});
  EXPECT_EQ(motion.states, together.states);
  EXPECT_EQ(motion.end.y, together.end.y);
  EXPECT_EQ(motion.events.size(), together.events.size());
}

// In a permanent rub slopes move faster than the motion: their steps have more terms, and are
// fewer. Impacts end steps before that counts.
TEST(MotionSlopes, TakeMoreTermsWhereTheyAloneMakeStepsShort) {
  const auto found = [](const RotorStator& rotor, double tolerance, int order) {
    const Model model = rotor.model();
    const Scene scene = make_scene(model);
    const MotionState start = settled(scene, {.model = model, .settle = 100});
    const std::vector parameters{slope(scene, model, stiffness())};
    return motion_slopes(scene.contacts, start, {{10.0 * scene.contacts.period()}}, parameters,
                         {.tolerance = tolerance, .order = order, .by_start = false});
  };
  constexpr double tolerance = 1e-10;
  const int usual = order_for(tolerance);
  const MotionSlopes rub = found(test::P3, tolerance, 0);
  EXPECT_LT(rub.cost.steps, found(test::P3, tolerance, usual).cost.steps / 2);
  EXPECT_LT(difference(rub.by_parameter[0], found(test::P3, 1e-15, 20).by_parameter[0]), 1e-7);
  const MotionSlopes impacts = found(test::P1, tolerance, 0);
  EXPECT_EQ(impacts.by_parameter[0], found(test::P1, tolerance, usual).by_parameter[0]);
}

// Derivatives by the start are the tangents of the engine.
TEST(MotionSlopes, ByTheStartAreItsTangents) {
  const DampedImpacts m;
  const auto found =
      motion_slopes(m.scene.contacts, m.start, {{2.0 * m.period()}}, {}, {.tolerance = 1e-15});
  Trajectory t{.system = &m.scene.contacts, .state = m.start, .revolutions = 2};
  integrate_single(t, {.tolerance = 1e-15, .tangent = true});
  EXPECT_LT(difference(found.by_start[0], t.tangent), 1e-11);
  EXPECT_EQ(found.end.revolution, t.state.revolution);
  EXPECT_EQ(found.end.phase, t.state.phase);
}

TEST(MotionSlopes, RefuseParametersWithoutADerivative) {
  RotorStator p = test::P1;
  const auto refuses = [&](Knob knob, double size) {
    const Scene scene = p.scene();
    knob.size = size;
    const std::vector<SystemSlope> parameters{slope(scene, p.model(), knob)};
    MotionState start;
    start.y = Vec::Zero(8);
    EXPECT_THROW(motion_slopes(scene.contacts, start, {{1e-3}}, parameters), NumericalError)
        << knob.name;
  };
  p.mu = 0.0;
  refuses(friction(), 0.1);
  p = test::P1;
  p.Omega = 0.0;
  refuses(speed(), 1.0);
}

// x = a sin(omega t) turns back at omega t = pi / 2, short of a damped ring or just beyond.
TEST(MotionSlopes, SayWhereAGrazeIs) {
  test::MassInRing p{.Omega = 30.0, .cC = 100.0};
  const double omega = 100.0, a = 1e-3, margin = 1e-8;
  const auto with_clearance = [&](double gap, double damping) {
    p.clearance = gap;
    p.cC = damping;
    const Scene scene = p.scene();
    MotionState start;
    start.y = Vec::Zero(4);
    start.y(2) = a * omega;
    std::vector<SystemSlope> parameters{slope(scene, p.model(), clearance())};
    return motion_slopes(scene.contacts, start, {{0.02}}, parameters,
                         {.tolerance = 1e-14, .by_start = false});
  };
  for (const bool is_passed : {false, true}) {
    const auto found = with_clearance(a * (is_passed ? 1.0 - margin : 1.0 + margin), 100.0);
    ASSERT_EQ(found.grazes.size(), 1u);
    const Graze& graze = found.grazes[0];
    EXPECT_EQ(graze.contact, 0);
    EXPECT_EQ(graze.kind, EventKind::touch);
    EXPECT_EQ(graze.is_passed, is_passed);
    EXPECT_NEAR(graze.time, test::pi / (2.0 * omega), 2e-6);  // sqrt(2 margin) / omega before
    EXPECT_NEAR(graze.margin, margin, 1e-3 * margin);
    // a motion beside it that does not touch does not notice the ring
    EXPECT_EQ(found.by_parameter[0].isZero(0.0), !is_passed);
    EXPECT_EQ(found.events.empty(), !is_passed);
  }
  // a touch that is none too slight, and a force that grows from nothing
  EXPECT_TRUE(with_clearance(0.9 * a, 100.0).grazes.empty());
  EXPECT_TRUE(with_clearance(a * (1.0 + margin), 0.0).grazes.empty());
}

// Between these radii a contact that slides ceases to stop on its way: just there its slip comes
// down to zero and goes up again.
TEST(MotionSlopes, SayWhereSlipAllButStops) {
  RotorStator p{.Omega = 151.8462, .kC = 3.07445e6, .mu = 0.5, .R = 0.005};
  MotionState start;
  {
    const Scene scene = p.scene();
    start = settled(scene, {.model = p.model(), .settle = 10});
  }
  for (const bool is_passed : {false, true}) {
    p.R = 0.0076043632684 * (is_passed ? 1.0 - 1e-8 : 1.0 + 1e-8);
    const Scene scene = p.scene();
    const auto found = motion_slopes(scene.contacts, start, {{scene.contacts.period()}}, {},
                                     {.tolerance = 1e-13, .by_start = false});
    ASSERT_EQ(found.grazes.size(), 1u);
    EXPECT_EQ(found.grazes[0].kind, EventKind::slip_stop);
    EXPECT_EQ(found.grazes[0].is_passed, is_passed);
    EXPECT_LT(found.grazes[0].margin, 1e-7);
    EXPECT_GT(found.grazes[0].margin, 0.0);
  }
}

}  // namespace whirl::motion_slopes_test
