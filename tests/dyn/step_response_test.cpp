// Step responses of control loops against closed forms.

#include "libdyn/linear/step_response.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/parts/control.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::step_response_test {

constexpr double m = 10.0, ks = 1e6, ki = 200.0, P = 1e4, D = 20.0;

/// A body that a controller levitates along x.
Model levitated(const StateSpace& control) {
  Model model;
  Structure& s = model.structure;
  s.bodies = {{.name = "rotor", .m = {m, m}, .spins = true}};
  const InterfaceCoordinate along_x{.at = test::body("rotor")};
  s.bearings = {test::bearing(test::body("rotor"), test::orthotropic(-ks, 1e6, 0.0, 100.0))};
  s.supports = {
      {.name = "magnet", .sees = {along_x}, .acts_on = {along_x}, .law = control, .sensors = 1}};
  model.reduction.method = ReductionMethod::none;
  return model;
}

/// The step response of (b_1 s + b_0) / (m s^2 + ki D s + ki P - ks) by its partial fractions.
double exact(double b_1, double b_0, double t) {
  const double k = ki * P - ks, c = ki * D;
  const Complex root = std::sqrt(Complex(c * c - 4.0 * m * k));
  const Complex p = (-c + root) / (2.0 * m), q = (-c - root) / (2.0 * m);
  const auto part = [&](Complex pole, Complex other) {
    return (b_1 * pole + b_0) / (m * pole * (pole - other)) * std::exp(pole * t);
  };
  return b_0 / k + (part(p, q) + part(q, p)).real();
}

TEST(StepResponse, OfProportionalDerivativeControl) {
  const StateSpace control = state_space(TransferFunction{{ki * D, ki * P}, {1.0}});
  const StepResponse found = step_response(levitated(control), 0.05, 500);
  ASSERT_EQ(found.times.size(), 501u);
  const LoopStep& step = found.steps.at(0);
  EXPECT_EQ(step.bearing, "magnet");
  double largest = 0.0;
  for (std::size_t k = 0; k < found.times.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    const double by_reference = exact(ki * D, ki * P, found.times[k]);
    largest = std::max(largest, by_reference);
    EXPECT_NEAR(step.reference(row), by_reference, 1e-11);
    EXPECT_NEAR(step.force(row), exact(0.0, 1.0, found.times[k]), 1e-17);
  }
  EXPECT_NEAR(step.reference_end, 2.0, 1e-12);  // against the negative stiffness
  EXPECT_NEAR(step.force_end, 1e-6, 1e-18);
  EXPECT_NEAR(step.overshoot, largest / 2.0 - 1.0, 1e-12);
  EXPECT_GT(step.settling_time, step.rise_time);
  EXPECT_LE(std::abs(exact(ki * D, ki * P, step.settling_time) / 2.0 - 1.0), 0.02);
}

// An integrator brings the rotor to where it is asked to be, and holds it there against a force.
TEST(StepResponse, OfAnIntegratorEndsWhereItIsAskedTo) {
  const TransferFunction pid = transfer_function(PidController{
      .proportional = P, .integral = 2e5, .derivative = D, .derivative_bandwidth = 1e4});
  const StateSpace control = chain({pid, TransferFunction{{ki}, {1.0}}});
  const StepResponse found = step_response(levitated(control), 0.8);
  EXPECT_NEAR(found.steps.at(0).reference_end, 1.0, 1e-9);
  EXPECT_NEAR(found.steps.at(0).force_end, 0.0, 1e-15);
  EXPECT_NEAR(found.steps.at(0).reference.tail(1)(0), 1.0, 0.02);
  EXPECT_LT(found.steps.at(0).settling_time, 0.8);
}

TEST(StepResponse, NeedsSensors) {
  Model model = levitated(state_space(TransferFunction{{1.0}, {1.0}}));
  model.structure.supports[0].sensors = 0;
  EXPECT_THROW(step_response(model, 1.0), ModelError);
}

}  // namespace whirl::step_response_test
