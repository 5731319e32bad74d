// Periodic orbits by shooting: closed forms of linear and Mathieu equations, the order of Newton's
// method on Duffing's, multipliers of many segments, and the rotor in its stator.

#include "libdyn/orbits/shooting.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "libbase/error.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libdyn/taylor/batch.hpp"
#include "tests/support/flows.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::shooting_test {

constexpr double pi = std::numbers::pi;

// x'' + 2 D x' + x = cos w t:  x = A cos(w t - phi), A = 1 / sqrt((1 - w^2)^2 + (2 D w)^2);
// multipliers exp(lambda T), lambda = -D +- i sqrt(1 - D^2). A linear map needs one step.
TEST(Shooting, FindsTheOrbitOfALinearOscillatorInOneStep) {
  const test::Duffing linear{.zeta = 0.1, .b = 0.0, .F = 1.0, .w = 0.8};
  const Flow flow = linear.flow();
  const double c = 1.0 - 0.64, s = 2.0 * 0.1 * 0.8, A2 = c * c + s * s;
  for (const int period : {1, 3}) {
    const PeriodicOrbit orbit = find_orbit(flow, Vec(Vec::Constant(2, 5.0)), {.period = period});
    ASSERT_TRUE(orbit.is_good()) << orbit.failure;
    EXPECT_LT(orbit.residual, 1e-11);
    EXPECT_LE(orbit.residuals.size(), 3u);  // the second step may take away rounding
    EXPECT_LT(orbit.residuals[1], 1e-10);
    EXPECT_NEAR(orbit.states[0](0), c / A2, 1e-11);
    EXPECT_NEAR(orbit.states[0](1), 0.8 * s / A2, 1e-11);
    EXPECT_EQ(shortest_period(orbit, flow.scale), 1);
    EXPECT_TRUE(orbit.is_stable());
    const double T = period * 2.0 * pi / 0.8;
    const Complex lambda(-0.1, std::sqrt(1.0 - 0.01));
    EXPECT_NEAR(std::abs(orbit.multipliers(0) - std::exp(lambda * T)) *
                    std::abs(orbit.multipliers(0) - std::exp(std::conj(lambda) * T)),
                0.0, 1e-11);
    EXPECT_NEAR(orbit.exponents()(0).real(), -0.1, 1e-10);
  }
}

// x'' + (a - 2 q cos 2 t) x = 0 over pi: at the characteristic values both multipliers are 1 or -1,
// their product is 1 always. Values for q = 5: [AbramowitzStegun1964], table 20.1.
TEST(Shooting, MultipliersOfMathieusEquationMeetAtItsBoundaries) {
  const auto multipliers = [](double a) {
    const test::Equation mathieu{[a](double t, const Vec& y, Vec& f, Mat& J) {
      const double k = a - 10.0 * std::cos(2.0 * t);
      f << y(1), -k * y(0);
      J << 0.0, 1.0, -k, 0.0;
    }};
    const PeriodicOrbit rest = find_orbit(test::flow_of(mathieu, 2, pi), Vec(Vec::Zero(2)), {});
    EXPECT_TRUE(rest.is_good());
    return rest.multipliers;
  };
  // by eight digits printed, the trace moves by less than 1e-6
  for (const auto& [a, sum] : {std::pair{-5.80004602, 2.0},
                               {7.44910974, 2.0},
                               {2.09946045, 2.0},
                               {1.85818754, -2.0},
                               {-5.79008060, -2.0}}) {
    const CVec m = multipliers(a);
    EXPECT_NEAR(std::abs(m(0) + m(1) - sum), 0.0, 1e-6) << a;
    EXPECT_NEAR(std::abs(m(0) * m(1) - 1.0), 0.0, 1e-11) << a;
  }
  EXPECT_GT(std::abs(multipliers(1.0)(0)), 1.1);           // between b_1 and a_1: unstable
  EXPECT_NEAR(std::abs(multipliers(2.0)(0)), 1.0, 1e-11);  // between a_1 and b_2: stable
}

// What a step of Newton's method leaves goes with the square of the distance from the orbit:
// order 2.
TEST(Shooting, ConvergesQuadratically) {
  const Flow flow = test::Duffing{.zeta = 0.1, .F = 1.0, .w = 2.0}.flow();
  const PeriodicOrbit orbit = find_orbit(flow, Vec(Vec::Zero(2)), {});
  ASSERT_TRUE(orbit.is_good()) << orbit.failure;
  std::vector<double> number, error;
  for (double distance = 0.02; distance > 1e-4; distance /= 2.0) {
    const Vec start = orbit.states[0] + distance * Vec::Ones(2);
    const PeriodicOrbit once = find_orbit(flow, start, {.most_steps = 1});
    number.push_back(1.0 / distance);
    error.push_back(once.residuals.at(1));
  }
  EXPECT_NEAR(test::order_of(number, error), 2.0, 0.1);
}

// Reference point P1: from a transient of 50 revolutions in at most four steps, and Floquet
// exponents -2.944044 (twice) and -3.473444 (twice) 1/s, each to 1e-6.
TEST(Shooting, FindsTheOrbitOfARubbingRotor) {
  const Scene scene = test::P1.scene();
  Trajectory transient{.system = &scene.contacts,
                       .state = test::start_of(test::P1.model(), scene),
                       .revolutions = 50};
  integrate_single(transient, {});
  const Flow flow = flow_of(scene.contacts);
  const PeriodicOrbit orbit = find_orbit(flow, transient.state.y, {});
  ASSERT_TRUE(orbit.is_good()) << orbit.failure;
  EXPECT_LE(orbit.residuals.size(), 5u) << testing::PrintToString(orbit.residuals);
  EXPECT_LT(orbit.residual, 1e-11);
  EXPECT_EQ(orbit.contacts.at(0).impacts, 5.0);
  EXPECT_TRUE(orbit.is_stable());
  const CVec rates = orbit.exponents();
  const double expected[] = {-2.944044, -2.944044, -3.473444, -3.473444};
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(rates(i).real(), expected[i], 1e-6) << i;

  // three segments of the same orbit: the cubes of its multipliers
  const PeriodicOrbit three = find_orbit(flow, transient.state.y, {.period = 3});
  ASSERT_TRUE(three.is_good()) << three.failure;
  EXPECT_EQ(shortest_period(three, flow.scale), 1);
  for (int i = 0; i < 8; ++i) {
    EXPECT_NEAR(three.exponents()(i).real(), rates(i).real(), 1e-7) << i;
  }
}

// A flow that fails, a singular return map and wrong options are said, not iterated.
TEST(Shooting, SaysWhyThereIsNoOrbit) {
  Flow flow = test::Duffing{}.flow();
  EXPECT_THROW(find_orbit(flow, Vec(Vec::Zero(2)), {.period = 4, .segments = 3}), OptionError);
  EXPECT_THROW(find_orbit(flow, Vec(Vec::Zero(2)), {.period = 0}), OptionError);
  // x'' = cos t, x' is any: the return map is a shear, and no step is defined
  const Flow free = test::Duffing{.zeta = 0.0, .a = 0.0, .b = 0.0, .F = 1.0}.flow();
  const PeriodicOrbit none = find_orbit(free, (Vec(2) << 0.0, 0.4).finished(), {});
  EXPECT_FALSE(none.is_good());
  EXPECT_TRUE(none.failure.text().find("multiplier is one") != std::string::npos) << none.failure;
  flow.go = [](std::span<const Vec>, long, WithTangent) {
    return std::vector<FlowResult>{{.failure = "lost"}};
  };
  EXPECT_EQ(find_orbit(flow, Vec(Vec::Zero(2)), {}).failure, "lost");
}

}  // namespace whirl::shooting_test
