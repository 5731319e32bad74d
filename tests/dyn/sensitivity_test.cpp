// Sensitivity of control loops against closed forms.

#include "libdyn/linear/sensitivity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/analyses/modes.hpp"
#include "libfe/parts/control.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::sensitivity_test {

constexpr double m = 10.0, ks = 1e6, ki = 200.0;
constexpr Complex i{0.0, 1.0};

/// A body that a controller levitates along x.
Structure levitated(const StateSpace& control) {
  Structure s;
  s.bodies = {{.name = "rotor", .m = {m, m}, .spins = true}};
  const InterfaceCoordinate along_x{.at = test::body("rotor")};
  s.bearings = {test::bearing(test::body("rotor"), test::orthotropic(-ks, 1e6, 0.0, 100.0))};
  s.supports = {
      {.name = "magnet", .sees = {along_x}, .acts_on = {along_x}, .law = control, .sensors = 1}};
  return s;
}

StateSpace proportional_derivative(double P, double D) {
  return state_space(TransferFunction{{ki * D, ki * P}, {1.0}});
}

std::vector<double> frequencies(double from, double to) {
  std::vector<double> all;
  for (double w = from; w <= to; w *= 1.03) all.push_back(w);
  return all;
}

// acceptance: the largest S = (m s^2 - ks) / (m s^2 + ki D s + ki P - ks)
TEST(Sensitivity, OfProportionalDerivativeControl) {
  const auto largest = [](double P, double D) {
    const Assembler assembler(levitated(proportional_derivative(P, D)));
    return loop_sensitivity(assembler, 0.0, frequencies(20.0, 5000.0)).loops.at(0);
  };
  const LoopSensitivity first = largest(1e4, 20.0);
  EXPECT_NEAR(first.largest, std::sqrt(2.5), 1e-12);
  EXPECT_NEAR(first.largest_at, 316.22776601683796, 1e-4);
  EXPECT_EQ(first.zone, "A");
  const LoopSensitivity second = largest(1.5e4, 30.0);
  EXPECT_NEAR(second.largest, 1.16774842, 1e-8);
  EXPECT_NEAR(second.largest_at, 591.60797, 1e-4);
  const LoopSensitivity third = largest(1e4, 5.0);
  EXPECT_NEAR(third.largest, std::sqrt(40.0), 1e-11);
  EXPECT_EQ(third.zone, "D");
}

TEST(Sensitivity, AndOpenLoopAreThoseOfTheClosedForm) {
  const double P = 1e4, D = 20.0;
  const Assembler assembler(levitated(proportional_derivative(P, D)));
  const std::vector<double> all{30.0, 400.0, 2000.0};
  const LoopSensitivity found = loop_sensitivity(assembler, 0.0, all).loops.at(0);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Complex s = i * all[k], plant = m * s * s - ks, control = ki * (P + D * s);
    const auto row = static_cast<Eigen::Index>(k);
    EXPECT_LT(std::abs(found.sensitivity(row) - plant / (plant + control)), 1e-12);
    EXPECT_LT(std::abs(found.open_loop(row) - control / plant), 1e-9 * std::abs(control / plant));
  }
}

TEST(Sensitivity, ZonesEndWhereTheStandardSays) {
  EXPECT_EQ(sensitivity_zone(3.0), "A");
  EXPECT_EQ(sensitivity_zone(3.01), "B");
  EXPECT_EQ(sensitivity_zone(4.5), "C");
  EXPECT_EQ(sensitivity_zone(5.01), "D");
  EXPECT_EQ(sensitivity_zone(nan), "D");
}

TEST(Sensitivity, NeedsASensor) {
  Structure s = levitated(proportional_derivative(1e4, 20.0));
  s.supports[0].sensors = 0;
  EXPECT_THROW(loop_sensitivity(Assembler(s), 0.0, {10.0}), ModelError);
}

// acceptance: (m w^2 + ks)^2 = ki^2 (P^2 + D^2 w^2), tau = atan(D w / P) / w
TEST(Control, ADelayBeyondItsBorderIsUnstable) {
  const double border = 1.695165863e-3;
  const auto growth = [](double delay) {
    const StateSpace law =
        chain({transfer_function(PidController{1e4, 0.0, 20.0, 0.0}), pade(delay, 6)});
    StateSpace scaled = law;
    scaled.C *= ki;
    scaled.D *= ki;
    if (scaled.D_rate.size() > 0) scaled.D_rate *= ki;
    const Modes modes = complex_modes(assemble(levitated(scaled), 0.0), 8);
    double most = -1e9;
    for (const Mode& mode : modes.oscillatory) most = std::max(most, mode.lambda.real());
    return most;
  };
  EXPECT_LT(growth(border * (1.0 - 1e-6)), 0.0);
  EXPECT_GT(growth(border * (1.0 + 1e-6)), 0.0);
}

}  // namespace whirl::sensitivity_test
