// Forces of contacts and films on periodic motions: the same as those of the equations of motion,
// with the slopes of differences, and Fourier integrals that kinks and jumps do not spoil.

#include "libdyn/system/contact_ports.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "libcontact/dual_functions.hpp"
#include "libdyn/orbits/contact_harmonics.hpp"
#include "tests/support/oil_films.hpp"
#include "tests/support/rotor_in_bearing.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::contact_ports_test {

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-11;
constexpr double of_differences = 2e-6;  ///< central ones of steps of 1e-5, over the slopes' size

Model ring(double cC, double kH, Friction friction) {
  Model m = test::MassInRing{.Omega = 50.0, .kC = 1e5, .cC = cC, .kH = kH}.model();
  m.contacts[0].friction = friction;
  return m;
}
Model stop(double cC, double kH, Friction friction) {
  Model m = ring(cC, kH, friction);
  m.contacts[0].geometry = geometry::Stop{.angle = -1.0};
  return m;
}
Model ellipse(double cC, double kH, Friction friction) {
  Model m = ring(cC, kH, friction);
  m.contacts[0].geometry = geometry::Ellipse{.angle = 0.4, .aspect = 1.3};
  return m;
}
Model face(Slip slip, double tolerance) {
  Model m;
  m.speed = 230.0;
  m.has_speed = true;
  Segment shaft = test::massless_cylinder(0.12, 0.01, 1);
  m.structure = test::cantilever(shaft);
  m.structure.disks = {{.name = "disk", .at = test::node(2), .m = 0.6, .Id = 4e-4, .Ip = 7e-4}};
  m.contacts = {{.name = "face",
                 .at = test::node(2),
                 .clearance = 1e-4,
                 .friction = {.mu = 0.1, .slip = slip, .tolerance = tolerance},
                 .law = Face<>{.k = 1e5, .radius = 0.05}}};
  return m;
}
Model blades(Slip slip, double tolerance) {
  Model m = test::MassInRing{.Omega = 450.0}.model();
  m.contacts[0].clearance = 1e-4;
  m.contacts[0].friction = {.mu = 0.1, .slip = slip, .tolerance = tolerance};
  m.contacts[0].law = BladeTip<>{.blades = 3,
                                 .tip_radius = 0.1,
                                 .blade_length = 0.04,
                                 .bending_stiffness = 20.0,
                                 .line_density = 0.5,
                                 .k = 1e10};
  return m;
}

/// In two revolutions the cage turns by one.
Model balls() {
  test::RotorInBearing rotor;
  rotor.bearing.cage_ratio = 0.5;
  rotor.bearing.clearance = 4e-4;
  rotor.bearing.hertz_stiffness = 1e7;
  rotor.waves = {{.race = Race::inner, .order = 3.0, .height = 1e-5}};
  return rotor.model();
}

Model squeeze(FilmTheory theory, FilmExtent extent) {
  Model m = test::MassOnFilm{}.model();
  m.films[0].law = Squeeze{.theory = theory, .extent = extent};
  return m;
}

Model damped_hertz() {
  Model m = ring(0.0, 1e7, {.mu = 0.1, .slip = Slip::forward});
  std::get<Hertz<>>(m.contacts[0].law).alpha = 8.0;  // it lets go beyond the surface
  return m;
}

struct Case {
  std::string name;
  Model model;
  double size;  ///< of the motion, in length scales
};
std::vector<Case> cases() {
  return {{"linear", ring(0.0, 0.0, {.mu = 0.1, .slip = Slip::forward}), 2.0},
          {"damped", ring(40.0, 0.0, {.mu = 0.1, .radius = 0.01}), 2.0},
          {"reversals of slip", ring(0.0, 0.0, {.mu = 0.3}), 2.0},
          {"creep", ring(0.0, 0.0, {.mu = 0.3, .tolerance = 0.05}), 2.0},
          {"hertz", ring(0.0, 1e7, {.mu = 0.1, .slip = Slip::forward}), 2.0},
          {"damped hertz", damped_hertz(), 2.0},
          {"stop", stop(0.0, 0.0, {.mu = 0.1, .slip = Slip::forward}), 2.0},
          {"damped stop", stop(40.0, 0.0, {.mu = 0.3}), 2.0},
          {"stop that creeps", stop(0.0, 1e7, {.mu = 0.3, .tolerance = 0.05}), 2.0},
          {"ellipse", ellipse(40.0, 0.0, {.mu = 0.1, .slip = Slip::forward}), 2.0},
          {"ellipse that creeps", ellipse(0.0, 1e7, {.mu = 0.3, .tolerance = 0.05}), 2.0},
          {"face", face(Slip::forward, 0.0), 2.0},
          {"face that creeps", face(Slip::actual, 5.0), 2.0},
          {"blades", blades(Slip::forward, 0.0), 2.0},
          {"blades that creep", blades(Slip::actual, 30.0), 2.0},
          {"balls", balls(), 2.0},
          {"film", test::MassOnFilm{}.model(), 0.3},
          {"squeeze film", squeeze(FilmTheory::short_bearing, FilmExtent::full), 0.3},
          {"long squeeze film", squeeze(FilmTheory::long_bearing, FilmExtent::half), 0.3},
          {"long full film", squeeze(FilmTheory::long_bearing, FilmExtent::full), 0.3}};
}

/// A motion of all coordinates with three harmonics, the same for the same seed.
Periodic motion_of(const ContactSystem& system, double size, int period = 1) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Periodic motion{Mat(system.coordinates(), 7), period, system.phase_rate()};
  for (Eigen::Index k = 0; k < 7; ++k) {
    for (Eigen::Index i = 0; i < motion.coefficients.rows(); ++i) {
      motion.coefficients(i, k) =
          size * system.state_scale()(i) * uniform(random) / (1.0 + static_cast<double>(k) / 2.0);
    }
  }
  return motion;
}

Periodic at_ports(const PortForces& forces, const Periodic& motion) {
  return {forces.U * motion.coefficients, motion.period, motion.rate};
}

// What the samples say is what the equations of motion have beyond their linear part; whatever is
// not sampled has no force.
TEST(PortForces, AreThoseOfTheEquationsOfMotion) {
  for (const Case& c : cases()) {
    const Scene scene = make_scene(c.model);
    const ContactSystem& system = scene.contacts;
    const Periodic motion = motion_of(system, c.size, 2);
    for (const PortForces& force : port_forces(system)) {
      std::vector<PortSample> samples;
      ASSERT_TRUE(force.sample(at_ports(force, motion), samples)) << c.name;
      double covered = 0.0;
      int checked = 0;
      for (const PortSample& s : samples) {
        covered += s.share;
        if (s.g.isZero(0.0)) continue;  // a jump
        const auto [x, rate] = motion.at(s.theta);
        const double phase = motion.phase(s.theta);
        Vec y(system.size()), a(system.coordinates());
        y << x, rate;
        system.acceleration(phase, y.data(), a.data());
        const Vec linear =
            system.constant_load() + std::cos(phase) * system.synchronous_load().cosine +
            std::sin(phase) * system.synchronous_load().sine - system.K() * x - system.D() * rate;
        Vec sum = Vec::Zero(a.size());  // blades that touch at once are samples of their own
        if (system.contacts().size() > 1) {
          for (const ReducedContact& one : system.contacts()) {
            const ContactForces f = kinematics(one, phase, y.data(), system.coordinates());
            if (f.depth > 0.0) ++checked;
          }
          continue;
        }
        sum += force.B * s.g;
        EXPECT_LT((sum - (a - linear)).norm(), rounding * (a.norm() + linear.norm())) << c.name;
        ++checked;
      }
      EXPECT_GT(checked, 10) << c.name;
      EXPECT_GT(covered, 0.01) << c.name;
    }
  }
}

// The equations of harmonic balance, whose forces are Fourier integrals over spans that move with
// the motion: their slopes are those of differences, jumps at touches and reversals of slip
// included.
TEST(PortForces, HaveTheSlopesOfDifferences) {
  for (const Case& c : cases()) {
    const Scene scene = make_scene(c.model);
    const HarmonicProblem problem = harmonic_problem(scene.contacts);
    for (const int period : {1, 2}) {
      const HarmonicEquations equations(problem, period, 5);
      const Mat u =
          with_harmonics(equations.U() * motion_of(scene.contacts, c.size, period).coefficients, 5);
      const auto at = equations.evaluate(u, true);
      ASSERT_TRUE(at.has_force) << c.name;
      const Mat J = equations.jacobian(at);
      const double h = 1e-5 * problem.length_scale;
      for (Eigen::Index i = 0; i < u.size(); i += 3) {
        Mat up = u, down = u;
        up(i) += h;
        down(i) -= h;
        const Mat change =
            equations.evaluate(up, false).residual - equations.evaluate(down, false).residual;
        const Vec column = Eigen::Map<const Vec>(change.data(), change.size()) / (2.0 * h);
        EXPECT_LT((column - J.col(i)).norm(), of_differences * (1.0 + J.norm()))
            << c.name << " " << i;
      }
    }
  }
}

/// A number of a model that derivatives are taken by.
struct Knob {
  std::string name;
  std::function<double*(Model&)> of;              ///< null: the model has none
  double size = 0.0;                              ///< what it is compared with; 0: with itself
  std::function<double*(Model&)> twin = nullptr;  ///< what else is the same number
};

template <class Law>
Knob of_law(std::string name, double Law::*member) {
  return {std::move(name), [member](Model& m) -> double* {
            Law* law = m.contacts.empty() ? nullptr : std::get_if<Law>(&m.contacts[0].law);
            return law ? &(law->*member) : nullptr;
          }};
}
Knob of_contact(std::string name, const std::function<double*(Contact&)>& of, double size = 0.0) {
  return {std::move(name),
          [of](Model& m) { return m.contacts.empty() ? nullptr : of(m.contacts[0]); }, size};
}
Knob of_ellipse(std::string name, double geometry::Ellipse::*member) {
  return of_contact(std::move(name), [member](Contact& c) {
    auto* ellipse = std::get_if<geometry::Ellipse>(&c.geometry);
    return ellipse ? &(ellipse->*member) : nullptr;
  });
}
Knob of_film(std::string name, const std::function<double*(OilFilm&)>& of, double size = 0.0) {
  return {std::move(name), [of](Model& m) { return m.films.empty() ? nullptr : of(m.films[0]); },
          size};
}
Knob of_bearing(std::string name, const std::function<double*(ConstantBearing&)>& of) {
  return {std::move(name), [of](Model& m) -> double* {
            auto& bearings = m.structure.bearings;
            return bearings.empty() ? nullptr
                                    : of(std::get<ConstantBearing>(bearings[0].coefficients));
          }};
}

std::vector<Knob> knobs() {
  using Blade = BladeTip<>;
  return {
      of_law("stiffness", &Radial<>::k),
      of_law("damping", &Radial<>::c),
      of_law("hertz_stiffness", &Hertz<>::k),
      of_law("dissipation", &Hertz<>::alpha),
      of_law("stiffness of a face", &Face<>::k),
      of_law("face_radius", &Face<>::radius),
      of_law("stiffness of a blade", &Blade::k),
      of_law("tip_radius", &Blade::tip_radius),
      of_law("blade_length", &Blade::blade_length),
      of_law("bending stiffness", &Blade::bending_stiffness),
      of_law("line density", &Blade::line_density),
      of_contact("clearance", [](Contact& c) { return &c.clearance; }),
      of_contact("friction", [](Contact& c) { return &c.friction.mu; }),
      of_contact("radius", [](Contact& c) { return &c.friction.radius; }),
      of_contact("slip_tolerance", [](Contact& c) { return &c.friction.tolerance; }),
      of_contact(
          "offset",
          [](Contact& c) { return takes_offset(geometry_of(c)) ? &c.offset(1) : nullptr; }, 1e-3),
      of_contact("angle",
                 [](Contact& c) {
                   auto* stop = std::get_if<geometry::Stop>(&c.geometry);
                   return stop ? &stop->angle : nullptr;
                 }),
      of_ellipse("angle of an ellipse", &geometry::Ellipse::angle),
      of_ellipse("aspect", &geometry::Ellipse::aspect),
      of_film("viscosity", [](OilFilm& f) { return &f.bearing.viscosity; }),
      of_film("clearance of a film", [](OilFilm& f) { return &f.bearing.clearance; }),
      of_film("length", [](OilFilm& f) { return &f.bearing.length; }),
      of_film("radius of a film", [](OilFilm& f) { return &f.bearing.radius; }),
      of_film(
          "offset of a film", [](OilFilm& f) { return &f.offset(0); }, 1e-4),
      of_bearing("kxx", [](ConstantBearing& b) { return &b.K(0, 0); }),
      of_bearing("kxy", [](ConstantBearing& b) { return &b.K(0, 1); }),
      of_bearing("cyy", [](ConstantBearing& b) { return &b.C(1, 1); }),
      {"unbalance",
       [](Model& m) {
         return m.structure.unbalances.empty() ? nullptr : &m.structure.unbalances[0].moment;
       }},
      {"force",
       [](Model& m) { return m.structure.forces.empty() ? nullptr : &m.structure.forces[0].size; }},
      {"mass",
       [](Model& m) { return m.structure.bodies.empty() ? nullptr : &m.structure.bodies[0].m.x; },
       0.0, [](Model& m) { return &m.structure.bodies[0].m.y; }},
      {"speed", [](Model& m) { return &m.speed; }}};
}

/// A model with a knob turned to a value.
Model turned_to(Model m, const Knob& knob, double value) {
  *knob.of(m) = value;
  if (knob.twin) *knob.twin(m) = value;
  return m;
}

/// Derivative of a residual by its stencil, of the eighth order: at displacements that are held the
/// residual is smooth but for rounding, which leaves eleven digits and more.
Mat stencil(const std::function<Mat(double)>& residual, double value, double size) {
  const double h = std::ldexp(1.0, std::ilogb(size / 2048.0));
  Mat sum;
  for (std::size_t j = 0; j < neighbor_places.size(); ++j) {
    const Mat r = neighbor_weights[j] / h * residual(value + neighbor_places[j] * h);
    sum = j == 0 ? r : Mat(sum + r);
  }
  return sum;
}

/// A model with forces, and bearings in which no harmonic resonates.
Model with_loads(Model m) {
  for (Connection& bearing : m.structure.bearings) {
    auto* at = std::get_if<ConstantBearing>(&bearing.coefficients);
    if (at) at->K *= 1.1, at->C += Mat2::Identity() * 3.0;
  }
  if (m.structure.bodies.empty()) return m;
  const Station at = test::body(m.structure.bodies[0].name);
  m.structure.unbalances = {{.at = at, .moment = 1e-4, .phase = 0.4}};
  m.structure.forces = {{.name = "second", .at = at, .size = 3.0, .order = 2.0}};
  return m;
}

// The exact derivative of the equations by every parameter of every law, jumps at touches and at
// reversals of slip and springs that hold a free rotor included.
TEST(PortForces, HaveExactSlopesByParameters) {
  constexpr double nine_digits = 1e-9;
  // integrals are exact to 1e-11, and what is left changes as Gauss points move with touches
  // (a wall that is no circle bends the force more within a touch)
  constexpr double of_integrals = 10.0 * rounding, along_walls = 4.0;
  int compared = 0;
  for (const Case& c : cases()) {
    const Model model = with_loads(c.model);
    const Scene scene = make_scene(model);
    const HarmonicProblem problem = harmonic_problem(scene.contacts);
    const HarmonicEquations equations(problem, 2, 7);
    const Mat u =
        with_harmonics(equations.U() * motion_of(scene.contacts, c.size, 2).coefficients, 7);
    for (const Knob& knob : knobs()) {
      Model at = model;
      const double* number = knob.of(at);
      if (!number || (*number == 0.0 && knob.size == 0.0)) continue;
      SCOPED_TRACE(c.name + ", " + knob.name);
      const double value = *number;
      const SystemSlope beside = slope_of(knob.name, scene, value, knob.size,
                                          [&](double p) { return turned_to(model, knob, p); });
      const auto slope = equations.slope(u, equations.evaluate(u, false).g,
                                         harmonic_slope(scene.contacts, NumberSlopes(beside)));
      ASSERT_TRUE(slope);
      const auto residual = [&](double p) {
        const Scene there = make_scene(turned_to(model, knob, p));
        const HarmonicProblem beside_it = harmonic_problem(there.contacts);
        return HarmonicEquations(beside_it, 2, 7).evaluate(u, false).residual;
      };
      const double size = knob.size > 0.0 ? knob.size : std::abs(value);
      const Mat wanted = stencil(residual, value, size);
      const bool is_at_wall =
          !c.model.contacts.empty() && is_wall(geometry_of(c.model.contacts[0]));
      const double left = of_integrals * residual(value).norm() / size;
      EXPECT_LE((*slope - wanted).norm(),
                (is_at_wall ? along_walls : 1.0) * std::max(nine_digits * wanted.norm(), left));
      if (wanted.norm() > 0.0) ++compared;
    }
  }
  EXPECT_GT(compared, 100);
}

// x = A cos theta against N = k (x - c): the force's Fourier coefficients are, with c = A cos b,
//   a_0 = k A / pi (sin b - b cos b),   a_1 = k A / pi (b - sin b cos b)
TEST(PortForces, HaveTheFourierIntegralsOfAKinkToRounding) {
  // damped, so that no springs are added to the forces
  const Scene scene = test::MassInRing{.Omega = 50.0, .c = 1.0, .kC = 1e5}.scene();
  const HarmonicProblem problem = harmonic_problem(scene.contacts);
  for (const double ratio : {1.0001, 1.1, 3.0}) {
    const double c = 1e-3, A = ratio * c, b = std::acos(1.0 / ratio), k = 1e5;
    Mat u = Mat::Zero(2, 9);
    u(0, 1) = A;
    const auto at = HarmonicEquations(problem, 1, 4).evaluate(u, false);
    // it touches on both sides: odd harmonics twice, even ones never
    EXPECT_NEAR(at.g(0, 0), 0.0, rounding * k * A);
    EXPECT_NEAR(at.g(0, 1), -2.0 * k * A / pi * (b - std::sin(b) * std::cos(b)), rounding * k * A);
    EXPECT_NEAR(at.g(1, 1), 0.0, rounding * k * A);
  }
}

// Duals: the slopes of composed functions by hand.
TEST(Dual, CarriesSlopes) {
  using D = Dual<2>;
  const D x = D::variable(0.7, 0), y = D::variable(1.3, 1);
  const D f = sqrt(x * y) / (1.0 + x) - tanh(x - 2.0 * y) + arc_cotangent(x * x);
  const double root = std::sqrt(0.91), c = 1.0 / std::pow(std::cosh(0.7 - 2.6), 2);
  EXPECT_NEAR(f.value, root / 1.7 - std::tanh(0.7 - 2.6) + std::atan2(1.0, 0.49), 1e-15);
  EXPECT_NEAR(f.slopes(0),
              1.3 / (2.0 * root * 1.7) - root / (1.7 * 1.7) - c - 1.4 / (1.0 + 0.49 * 0.49), 1e-14);
  EXPECT_NEAR(f.slopes(1), 0.7 / (2.0 * root * 1.7) + 2.0 * c, 1e-14);
  const D z = indentation(x, 3.0);
  EXPECT_NEAR(z.value + 3.0 * std::pow(z.value, 3), 0.7, 1e-15);
  EXPECT_NEAR(z.slopes(0) * (1.0 + 9.0 * z.value * z.value), 1.0, 1e-14);
}

}  // namespace whirl::contact_ports_test
