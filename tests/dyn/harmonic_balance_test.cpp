// Harmonic balance: closed forms of one harmonic, exponential convergence, and orbits of rotors
// with every kind of force against shooting, with measured orders.

#include "libdyn/orbits/harmonic_balance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libbase/error.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libdyn/orbits/contact_harmonics.hpp"
#include "libdyn/orbits/hill.hpp"
#include "libdyn/system/contact_measures.hpp"
#include "libdyn/system/contact_ports.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libfe/analyses/unbalance.hpp"
#include "tests/support/bladed_disk.hpp"
#include "tests/support/flows.hpp"
#include "tests/support/oil_films.hpp"
#include "tests/support/overhung_disk.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::harmonic_balance_test {

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-10;  ///< of residuals of 1e-11 and flows at 1e-13

/// An equation of one coordinate with g(phase, x, x') as a port.
HarmonicProblem oscillator(double a, double damping, double F, double w,
                           std::function<void(double, double, PortSample&)> g) {
  HarmonicProblem p{.K = Mat::Constant(1, 1, a),
                    .D = Mat::Constant(1, 1, damping),
                    .loads = {{1.0, Vec::Constant(1, F), Vec::Zero(1)}},
                    .rate = w,
                    .scale = Vec::Ones(2)};
  const Mat one = Mat::Ones(1, 1);
  p.forces.push_back(smooth_force(
      "spring", one, one,
      [g = std::move(g)](double phase, const PortVec& u, const PortVec&, PortSample& s) {
        g(phase, u(0), s);
        return true;
      }));
  return p;
}
HarmonicProblem problem_of(const test::Duffing& d) {
  return oscillator(d.a, 2.0 * d.zeta, d.F, d.w, [b = d.b](double, double x, PortSample& s) {
    s.g(0) = -b * x * x * x;
    s.by_u(0, 0) = -3.0 * b * x * x;
  });
}
/// x'' + (a - 2 q cos 2 t) x = 0 over pi, 2 t is the phase.
HarmonicProblem mathieu(double a, double q) {
  return oscillator(a, 0.0, 0.0, 2.0, [q](double phase, double x, PortSample& s) {
    s.g(0) = 2.0 * q * std::cos(phase) * x;
    s.by_u(0, 0) = 2.0 * q * std::cos(phase);
  });
}

Vec settled(const Scene& scene, const Model& model, long revolutions) {
  Trajectory t{
      .system = &scene.contacts, .state = test::start_of(model, scene), .revolutions = revolutions};
  integrate_single(t, {});
  EXPECT_EQ(t.outcome, Outcome::reached_end) << t.failure;
  return t.state.y;
}

/// Largest distance of a multiplier from the nearest of others.
double difference(const CVec& a, const CVec& of) {
  double worst = 0.0;
  for (const Complex& x : a) {
    double nearest = 1e300;
    for (const Complex& y : of) nearest = std::min(nearest, std::abs(x - y));
    worst = std::max(worst, nearest);
  }
  return worst;
}

/// Errors of harmonic balance against the orbit of shooting.
struct Errors {
  std::vector<double> harmonics, displacement, multiplier;
  bool verdict = false;  ///< on stability, with the last number of harmonics
};
Errors errors_of(const Scene& scene, const Vec& start, int period, std::vector<int> harmonics) {
  const ContactSystem& system = scene.contacts;
  const PeriodicOrbit exact = find_orbit(flow_of(system), start, {.period = period});
  EXPECT_TRUE(exact.is_good()) << exact.failure;
  const HarmonicProblem problem = harmonic_problem(system);
  const Mat coefficients = harmonic_start(system, start, period);
  Errors errors;
  for (const int H : harmonics) {
    const HarmonicOrbit orbit =
        find_harmonic_orbit(problem, coefficients, {.period = period, .harmonics = H * period});
    EXPECT_TRUE(orbit.is_good()) << H << ": " << orbit.failure;
    double error = 0.0;
    for (int i = 0; i < period; ++i) {
      const Vec gap = (orbit.state(i) - exact.states[static_cast<std::size_t>(i)])
                          .cwiseQuotient(system.state_scale());
      error = std::max(error, gap.head(system.coordinates()).cwiseAbs().maxCoeff());
    }
    const HillStability hill = hill_stability(problem, orbit);
    EXPECT_FALSE(hill.failure) << hill.failure;
    errors.verdict = hill.is_stable() == exact.is_stable();
    errors.harmonics.push_back(H);
    errors.displacement.push_back(error);
    errors.multiplier.push_back(difference(hill.multipliers, exact.multipliers));
  }
  return errors;
}

// One harmonic of Duffing's equation, x = A cos(w t - phi):
//   ((a - w^2 + 3/4 b A^2)^2 + (2 zeta w)^2) A^2 = F^2
TEST(HarmonicBalance, OfOneHarmonicIsDuffingsClosedForm) {
  for (const double w : {0.5, 1.0, 1.5, 2.0, 2.5}) {
    const test::Duffing d{.zeta = 0.05, .b = 0.7, .F = 0.4, .w = w};
    const HarmonicOrbit orbit =
        find_harmonic_orbit(problem_of(d), Mat::Zero(1, 3), {.harmonics = 1});
    ASSERT_TRUE(orbit.is_good()) << orbit.failure;
    const double A = std::hypot(orbit.motion.coefficients(0, 1), orbit.motion.coefficients(0, 2));
    const double stiff = d.a - w * w + 0.75 * d.b * A * A, damped = 2.0 * d.zeta * w;
    EXPECT_NEAR(std::hypot(stiff, damped) * A, d.F, rounding) << w;
    EXPECT_NEAR(orbit.motion.coefficients(0, 0), 0.0, rounding);
  }
}

// Duffing's orbits are analytic: the error falls by a factor with each harmonic, down to rounding.
TEST(HarmonicBalance, OfAnalyticMotionsConvergesExponentially) {
  const test::Duffing d{.zeta = 0.1, .F = 1.0, .w = 0.8};
  const PeriodicOrbit exact = find_orbit(d.flow(), Vec(Vec::Zero(2)), {});
  ASSERT_TRUE(exact.is_good()) << exact.failure;
  const HarmonicProblem problem = problem_of(d);
  std::vector<double> errors;
  for (const int H : {3, 7, 11, 15, 19}) {
    const HarmonicOrbit orbit = find_harmonic_orbit(problem, Mat::Zero(1, 1), {.harmonics = H});
    ASSERT_TRUE(orbit.is_good()) << orbit.failure;
    errors.push_back((orbit.state() - exact.states[0]).cwiseAbs().maxCoeff());
  }
  for (std::size_t i = 1; i < errors.size(); ++i) {
    EXPECT_LT(errors[i], 0.05 * errors[i - 1]) << i;  // the same factor, or better
  }
  const HarmonicOrbit orbit = find_harmonic_orbit(problem, Mat::Zero(1, 1), {.harmonics = 40});
  EXPECT_LT((orbit.state() - exact.states[0]).cwiseAbs().maxCoeff(), rounding);
  EXPECT_LT(difference(hill_stability(problem, orbit).multipliers, exact.multipliers), rounding);

  // left to itself it takes what its tolerance asks for, and its estimate holds
  const HarmonicOrbit chosen = find_harmonic_orbit(problem, Mat::Zero(1, 1), {.tolerance = 1e-7});
  ASSERT_TRUE(chosen.is_good());
  EXPECT_LT(chosen.truncation, 1e-7);
  EXPECT_LT((chosen.state() - exact.states[0]).cwiseAbs().maxCoeff(), 1e-7);
}

// Newton's method: what a step leaves goes with the square of what was there.
TEST(HarmonicBalance, ConvergesQuadratically) {
  const test::Duffing d{.zeta = 0.1, .F = 1.0, .w = 2.0};
  const HarmonicProblem problem = problem_of(d);
  const HarmonicOrbit orbit = find_harmonic_orbit(problem, Mat::Zero(1, 1), {.harmonics = 9});
  ASSERT_TRUE(orbit.is_good());
  std::vector<double> number, error;
  for (double distance = 0.02; distance > 1e-4; distance /= 2.0) {
    const Mat start = orbit.ports.coefficients + Mat::Constant(1, 19, distance);
    const HarmonicOrbit once =
        find_harmonic_orbit(problem, start, {.harmonics = 9, .most_steps = 1});
    number.push_back(1.0 / distance);
    error.push_back(once.residuals.at(1));
  }
  EXPECT_NEAR(test::order_of(number, error), 2.0, 0.1);
}

// A rotor without contacts: the unbalance response, in one evaluation.
TEST(HarmonicBalance, OfALinearRotorIsItsUnbalanceResponse) {
  const test::TwoDiskRub rotor{.speed = 300.0, .modes = 0, .contact_nodes = {}};
  const Scene scene = rotor.scene();
  const HarmonicOrbit orbit =
      find_harmonic_orbit(harmonic_problem(scene.contacts), Mat::Zero(52, 1), {});
  ASSERT_TRUE(orbit.is_good()) << orbit.failure;
  EXPECT_EQ(orbit.residuals.size(), 1u);
  EXPECT_EQ(orbit.truncation, 0.0);
  std::vector<Point> points = scene.reduced.dofs.points();
  const UnbalanceResponse exact = unbalance_response(scene.assembler, {300.0}, points);
  const Mat full = scene.displacement_map() * orbit.motion.coefficients;
  const double size = exact.x.cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int x = scene.reduced.dofs.full_index(points[i], X);
    const Complex found(full(x, 1), -full(x, 2));
    EXPECT_NEAR(std::abs(found - exact.x(static_cast<Eigen::Index>(i), 0)), 0.0, 1e-9 * size);
  }
}

// Multipliers of Mathieu's equation by Hill's method, stable, unstable and near the boundaries
// where both are -1 (imaginary parts at the edges of the strip), against shooting; the trace is
// sharper than multipliers where these meet.
TEST(Hill, HasTheMultipliersOfMathieusEquation) {
  for (const auto& [a, q] : {std::pair{1.0, 5.0},
                             {2.0, 5.0},
                             {1.85, 5.0},
                             {-5.7900, 5.0},
                             {7.0, 5.0},
                             {0.3, 0.1},
                             {0.5, 1.0}}) {
    const test::Equation equation{[a = a, q = q](double t, const Vec& y, Vec& f, Mat& J) {
      const double k = a - 2.0 * q * std::cos(2.0 * t);
      f << y(1), -k * y(0);
      J << 0.0, 1.0, -k, 0.0;
    }};
    const PeriodicOrbit rest = find_orbit(test::flow_of(equation, 2, pi), Vec(Vec::Zero(2)), {});
    const HarmonicProblem problem = mathieu(a, q);
    const HarmonicOrbit orbit = find_harmonic_orbit(problem, Mat::Zero(1, 1), {.harmonics = 20});
    ASSERT_TRUE(orbit.is_good()) << orbit.failure;
    const HillStability hill = hill_stability(problem, orbit);
    ASSERT_EQ(hill.multipliers.size(), 2) << a << " " << hill.failure;
    EXPECT_NEAR(std::abs(hill.multipliers.sum() - rest.multipliers.sum()), 0.0, 1e-8) << a;
    EXPECT_NEAR(std::abs(hill.multipliers.prod() - 1.0), 0.0, 1e-8) << a;
  }
}

// A multiplier of exp(-785) is 0 as a number; its exponent is told nevertheless.
TEST(Hill, TellsExponentsOfMultipliersThatAreTooSmallForANumber) {
  const test::Duffing d{.zeta = 100.0, .a = 1e5, .b = 0.0, .F = 1.0, .w = 0.8};
  const HarmonicProblem problem = problem_of(d);
  const HarmonicOrbit orbit = find_harmonic_orbit(problem, Mat::Zero(1, 1), {.harmonics = 5});
  ASSERT_TRUE(orbit.is_good()) << orbit.failure;
  const HillStability hill = hill_stability(problem, orbit);
  ASSERT_EQ(hill.exponents.size(), 2) << hill.failure;
  const double fast = std::remainder(std::sqrt(d.a - d.zeta * d.zeta), d.w);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(hill.multipliers(i), 0.0);
    EXPECT_NEAR(hill.exponents(i).real(), -d.zeta, 1e-9);
    EXPECT_NEAR(std::abs(hill.exponents(i).imag()), std::abs(fast), 1e-9);
  }
}

// The exponents of an isotropic rotor come twice, and each is found twice; modes far faster than
// ten harmonics are there too.
TEST(Hill, FindsExponentsThatIsotropyDoubles) {
  const test::TwoDiskRub rotor{.speed = 300.0, .modes = 8, .contact_nodes = {}};
  const Scene scene = rotor.scene();
  const HarmonicProblem problem = harmonic_problem(scene.contacts);
  const HarmonicOrbit orbit = find_harmonic_orbit(problem, Mat::Zero(8, 1), {.harmonics = 10});
  const HillStability hill = hill_stability(problem, orbit);
  const PeriodicOrbit exact = find_orbit(flow_of(scene.contacts), Vec(Vec::Zero(16)), {});
  ASSERT_TRUE(exact.is_good());
  EXPECT_EQ(hill.multipliers.size() + hill.missing, 16);
  EXPECT_LT(difference(hill.multipliers, exact.multipliers), 1e-8);
  EXPECT_LT(difference(exact.multipliers, hill.multipliers), 1e-4);  // what is left out is fainter
}

// Reference points of the rotor in its stator. Forces have kinks at touches, so that coefficients
// of the motion fall as k^-4 and its error about as H^-4 (at a point in time, erratically); P3
// touches all the time and needs few harmonics.
TEST(HarmonicBalance, OfARubbingRotorConvergesToShooting) {
  const Scene p1 = test::P1.scene();
  const Errors errors =
      errors_of(p1, settled(p1, test::P1.model(), 300), 1, {20, 28, 40, 57, 80, 113, 160});
  EXPECT_GT(test::order_of(errors.harmonics, errors.displacement), 3.0);
  EXPECT_GT(test::order_of(errors.harmonics, errors.multiplier), 3.0);
  EXPECT_TRUE(errors.verdict);
  EXPECT_LT(errors.displacement.back(), 2e-7);
  EXPECT_LT(errors.multiplier.back(), 1e-4);

  const Scene p3 = test::P3.scene();
  const Errors permanent = errors_of(p3, settled(p3, test::P3.model(), 300), 1, {10, 20});
  for (int i = 0; i < 2; ++i) {
    EXPECT_LT(permanent.displacement[std::size_t(i)], rounding);
    EXPECT_LT(permanent.multiplier[std::size_t(i)], rounding);
  }
}

// Floquet exponents of P1, -2.944044 and -3.473444 1/s, each twice.
TEST(Hill, HasTheExponentsOfReferencePointP1) {
  const Scene scene = test::P1.scene();
  const ContactOrbit found = find_harmonic_orbit(
      scene.contacts, settled(scene, test::P1.model(), 300), {.harmonics = 160});
  ASSERT_TRUE(found.orbit.is_good()) << found.orbit.failure;
  EXPECT_EQ(found.contacts.at(0).impacts, 5.0);
  const HillStability hill = hill_stability(harmonic_problem(scene.contacts), found.orbit);
  const double expected[] = {-2.944044, -2.944044, -3.473444, -3.473444};
  ASSERT_EQ(hill.exponents.size(), 8);
  constexpr double by_harmonics = 2e-3;  // what 160 leave
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(hill.exponents(i).real(), expected[i], by_harmonics);
}

// Oil films, analytic but steep near the wall: the error falls faster than any power met above.
TEST(HarmonicBalance, OfAnOilFilmConvergesToShooting) {
  const test::MassOnFilm rotor{.U = 3e-4};
  const Scene scene = rotor.scene();
  const Errors errors = errors_of(scene, settled(scene, rotor.model(), 200), 1, {5, 10, 20, 40});
  EXPECT_TRUE(errors.verdict);
  EXPECT_LT(errors.displacement[2], 1e-3 * errors.displacement[0]);
  EXPECT_LT(errors.displacement[3], rounding);
  EXPECT_LT(errors.multiplier[3], 1e-8);
}

/// Rotors with other forces: who settles where, and the least order of the error by the harmonics.
struct Rub {
  std::string name;
  Model model;
  int period;
  std::vector<int> harmonics;      ///< a revolution
  double order, multiplier_order;  ///< measured, less some half for their unsteadiness
  double error, multiplier_error;  ///< with the most harmonics
};
Model with_blades() {
  Model m =
      test::MassInRing{.Omega = 450.0, .m = 2.0, .k = 5e5, .c = 300.0, .U = 3e-5, .gravity = 25.0}
          .model();
  m.contacts[0].clearance = 1e-4;
  m.contacts[0].friction = {.mu = 0.1, .slip = Slip::forward};
  m.contacts[0].law = test::five_blades();
  return m;
}
/// Friction turns round twice a revolution, without sticking: the unbalance is stronger.
Model with_reversals() {
  Model m =
      test::MassInRing{
          .Omega = 60.0, .k = 1e3, .c = 5.0, .U = 2.5e-4, .kC = 1e5, .mu = 0.02, .gravity = 9.81}
          .model();
  return m;
}
std::vector<Rub> rubs() {
  const auto stator = [](double kC, double cC, double kH, double alpha = 0.0) {
    test::RotorStator p = test::P1;
    p.kC = kC, p.cC = cC, p.kH = kH, p.alpha = alpha;
    return p.model();
  };
  return {{"two long contacts", stator(20e6, 0.0, 0.0), 1, {10, 20, 40, 80}, 2.7, 3.5, 2e-7, 1e-5},
          {"damped contact", stator(20e6, 20e3, 0.0), 1, {10, 20, 40, 80}, 2.7, 3.2, 3e-7, 1e-5},
          {"hertz", stator(0.0, 0.0, 3e8), 1, {10, 20, 40, 80}, 5.0, 5.0, 1e-10, 1e-9},
          {"damped hertz", stator(0.0, 0.0, 3e8, 1.0), 1, {10, 20, 40, 80}, 4.8, 5.0, 1e-10, 1e-9},
          {"blades", with_blades(), 1, {20, 40, 80}, 4.5, 5.5, 5e-7, 1e-6},
          {"ring and face", test::overhung_disk(), 3, {7, 14, 28}, 3.5, 4.0, 5e-5, 2e-3},
          {"reversals of slip", with_reversals(), 1, {10, 20, 40, 80}, 0.8, 0.7, 1e-4, 1e-3}};
}

// Every kind of contact against shooting, whose tangents carry saltation: orbit and multipliers.
// The smoother the force is at a touch the higher is the order: about 3 for a kink, 6 for Hertz
// contact. Where slip turns round friction jumps at an instant that the velocity says, whose series
// is poor there: order 1.
TEST(HarmonicBalance, OfEveryContactConvergesToShooting) {
  for (const Rub& rub : rubs()) {
    SCOPED_TRACE(rub.name);
    const Scene scene = make_scene(rub.model);
    const Errors errors =
        errors_of(scene, settled(scene, rub.model, 600), rub.period, rub.harmonics);
    EXPECT_GT(test::order_of(errors.harmonics, errors.displacement), rub.order);
    EXPECT_LT(errors.displacement.back(), rub.error);
    EXPECT_GT(test::order_of(errors.harmonics, errors.multiplier), rub.multiplier_order);
    EXPECT_LT(errors.multiplier.back(), rub.multiplier_error);
    EXPECT_TRUE(errors.verdict);
  }
}

// All 52 dofs of a shaft, the fastest at 4.5e5 rad/s, that rubs: the unknowns are the contact's
// alone, and the orbit is that of 16 modes to what these leave out.
TEST(HarmonicBalance, OfAnUnreducedRotorCostsWhatItsContactsDo) {
  const auto rotor = [](int modes) {
    test::TwoDiskRub r{.speed = 220.0, .mu = 0.0, .modes = modes, .gravity = 9.81};
    return r.model();
  };
  const Model reduced_model = rotor(16);
  const Scene reduced = make_scene(reduced_model), whole = make_scene(rotor(0));
  const ContactOrbit few = find_harmonic_orbit(
      reduced.contacts, settled(reduced, reduced_model, 300), {.harmonics = 20});
  ASSERT_TRUE(few.orbit.is_good()) << few.orbit.failure;
  EXPECT_EQ(few.contacts.at(0).regime(), Regime::intermittent);
  const HarmonicProblem problem = harmonic_problem(whole.contacts);
  const Mat start =
      DenseLu<Mat>(whole.reduced.Phi).solve(reduced.reduced.Phi * few.orbit.motion.coefficients);
  const HarmonicOrbit all = find_harmonic_orbit(problem, start, {.harmonics = 20});
  ASSERT_TRUE(all.is_good()) << all.failure;
  EXPECT_EQ(all.ports.coefficients.size(), 2 * 41);
  constexpr double left_out = 1e-2;  // of the contact's flexibility, by 16 modes [clearances]
  EXPECT_LT(distance(all.ports, few.orbit.ports), left_out * problem.length_scale);
}

// Where slip turns round and friction could hold, the contact sticks for a while: that is said.
TEST(HarmonicBalance, SaysThatAContactWouldStick) {
  const Model model =
      test::MassInRing{
          .Omega = 60.0, .k = 1e3, .c = 20.0, .U = 1e-3, .kC = 1e5, .mu = 0.1, .gravity = 9.81}
          .model();
  const Scene scene = make_scene(model);
  const Vec y = settled(scene, model, 600);
  const PeriodicOrbit exact = find_orbit(flow_of(scene.contacts), y, {});
  ASSERT_TRUE(exact.is_good());
  EXPECT_GT(exact.contacts.at(0).sticking, 0.0);
  const ContactOrbit found = find_harmonic_orbit(scene.contacts, y, {.harmonics = 40});
  EXPECT_NE(found.orbit.failure.text().find("contact \"ring\" would stick"), std::string::npos)
      << found.orbit.failure;
}

// Contact measures of an orbit are those of shooting and of its flight, blades together; its period
// is the shortest.
TEST(HarmonicBalance, MeasuresWhatContactsDo) {
  for (const Rub& rub : {rubs()[1], rubs()[3]}) {
    SCOPED_TRACE(rub.name);
    const Scene scene = make_scene(rub.model);
    const Vec y = settled(scene, rub.model, 600);
    const PeriodicOrbit exact = find_orbit(flow_of(scene.contacts), y, {.period = rub.period});
    const ContactOrbit found = find_harmonic_orbit(
        scene.contacts, y, {.period = 2 * rub.period, .harmonics = 60 * rub.period});
    ASSERT_TRUE(found.orbit.is_good()) << found.orbit.failure;
    EXPECT_EQ(shortest_period(found.orbit), rub.period);
    ASSERT_EQ(found.contacts.size(), exact.contacts.size());
    MotionState state = test::state_of(y);
    ContactMeter meter(scene.contacts);
    test::run(scene, state, 2 * rub.period, {}, [&](const Step& step) {
      meter.add(step);
      return true;
    });
    const std::vector<ContactMeasure> simulated = meter.measures();
    constexpr double near = 2e-2;  // of forces, the damped one following rates, by 30 harmonics
    for (std::size_t i = 0; i < exact.contacts.size(); ++i) {
      const ContactMeasure &a = found.contacts[i], &b = exact.contacts[i];
      EXPECT_EQ(a.name, b.name);
      EXPECT_EQ(a.impacts, 2.0 * b.impacts);
      EXPECT_NEAR(a.duty, b.duty, near);
      EXPECT_NEAR(a.max_normal, b.max_normal, near * b.max_normal);
      EXPECT_NEAR(a.max_tangential, b.max_tangential, near * b.max_tangential);
      const ContactMeasure& c = simulated[i];
      EXPECT_NEAR(a.mean_slip, c.mean_slip, near * std::abs(c.mean_slip));
      EXPECT_NEAR(a.touch_time, c.touch_time, near * c.touch_time);
    }
  }
}

// What cannot be found is said.
TEST(HarmonicBalance, SaysWhyThereIsNoOrbit) {
  const HarmonicProblem duffing = problem_of({});
  EXPECT_THROW(find_harmonic_orbit(duffing, Mat::Zero(1, 1), {.period = 0}), OptionError);
  EXPECT_THROW(find_harmonic_orbit(duffing, Mat::Zero(1, 1), {.tolerance = 0.0}), OptionError);
  EXPECT_THROW(find_harmonic_orbit(duffing, Mat::Zero(1, 1), {.period = 3, .harmonics = 2}),
               OptionError);
  HarmonicProblem resonant = duffing;  // without a force, without damping, at its own frequency
  resonant.forces.clear();
  resonant.D.setZero();
  try {
    find_harmonic_orbit(resonant, Mat::Zero(1, 1), {});
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("undamped resonance"), std::string::npos);
  }
  HarmonicProblem free = resonant;
  free.K.setZero();
  EXPECT_THROW(find_harmonic_orbit(free, Mat::Zero(1, 1), {}), NumericalError);

  const test::MassOnFilm on_film{.U = 3e-4};
  const Scene film = on_film.scene();
  const HarmonicOrbit outside = find_harmonic_orbit(harmonic_problem(film.contacts),
                                                    Mat::Constant(2, 1, 1.0), {.harmonics = 5});
  EXPECT_NE(outside.failure.text().find("outside its bearing"), std::string::npos);
}

}  // namespace whirl::harmonic_balance_test
