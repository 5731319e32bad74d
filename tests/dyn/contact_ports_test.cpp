// Forces of contacts and films on periodic motions: the same as those of the equations of motion, with
// the slopes of differences, and Fourier integrals that kinks and jumps do not spoil.

#include "libdyn/system/contact_ports.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "libcontact/dual_functions.hpp"
#include "libdyn/orbits/contact_harmonics.hpp"
#include "tests/support/oil_films.hpp"
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
          {"face", face(Slip::forward, 0.0), 2.0},
          {"face that creeps", face(Slip::actual, 5.0), 2.0},
          {"blades", blades(Slip::forward, 0.0), 2.0},
          {"blades that creep", blades(Slip::actual, 30.0), 2.0},
          {"film", test::MassOnFilm{}.model(), 0.3}};
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

// What the samples say is what the equations of motion have beyond their linear part; whatever is not
// sampled has no force.
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
        const Vec linear = system.constant_load() + std::cos(phase) * system.cosine_load() +
                           std::sin(phase) * system.sine_load() - system.K() * x -
                           system.D() * rate;
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

// The equations of harmonic balance, whose forces are Fourier integrals over spans that move with the
// motion: their slopes are those of differences, jumps at touches and reversals of slip included.
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
