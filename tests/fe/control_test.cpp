// Controllers of magnetic bearings.

#include "libfe/parts/control.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "libbase/error.hpp"

namespace whirl::control_test {

constexpr Complex i{0.0, 1.0};

Complex at(const TransferFunction& f, Complex s) {
  const auto value = [&](const std::vector<double>& p) {
    Complex sum = 0.0;
    for (const double c : p) sum = sum * s + c;
    return sum;
  };
  return value(f.numerator) / value(f.denominator);
}

void expect_near(Complex found, Complex expected, double tolerance) {
  EXPECT_LT(std::abs(found - expected), tolerance * std::abs(expected)) << found << expected;
}

TEST(Control, PidIsTheSumOfItsActions) {
  const Complex s = -20.0 + 300.0 * i;
  expect_near(at(transfer_function(PidController{1e4, 3e5, 20.0, 2000.0}), s),
              1e4 + 3e5 / s + 20.0 * s / (1.0 + s / 2000.0), 1e-13);
  expect_near(at(transfer_function(PidController{1e4, 0.0, 20.0, 0.0}), s), 1e4 + 20.0 * s, 1e-14);
}

TEST(Control, PadeIsADelay) {
  const double T = 1e-3;
  double before = 1.0;
  for (const int order : {1, 2, 4, 6}) {
    const TransferFunction f = pade(T, order);
    EXPECT_NEAR(std::abs(at(f, 5000.0 * i)), 1.0, 1e-13);  // it lets everything through
    const double error = std::abs(at(f, 1000.0 * i) - std::exp(-1000.0 * T * i));
    EXPECT_LT(error, 0.1 * before) << order;
    before = error;
  }
  EXPECT_LT(before, 1e-12);
  // (1 - x / 2 + x^2 / 12) / (1 + x / 2 + x^2 / 12)
  const TransferFunction two = pade(1.0, 2);
  EXPECT_NEAR(two.denominator[0], 1.0 / 12.0, 1e-16);
  EXPECT_EQ(two.denominator[1], 0.5);
  EXPECT_EQ(two.numerator[1], -0.5);
}

TEST(Control, FiltersAreOneAtRest) {
  const double w = 900.0;
  const TransferFunction low = transfer_function(ControlFilter{.frequency = w});
  expect_near(at(low, 0.0), 1.0, 1e-15);
  expect_near(at(low, i * w), 1.0 / (1.4 * i), 1e-13);
  const ControlFilter notch{.kind = FilterKind::notch, .frequency = w, .depth = 0.05};
  expect_near(at(transfer_function(notch), i * w), 0.05, 1e-13);
}

TEST(Control, ChainIsTheProduct) {
  const std::vector<TransferFunction> functions{
      transfer_function(PidController{1e4, 3e5, 20.0, 0.0}),
      transfer_function(ControlFilter{.frequency = 8000.0}),
      {{2000.0}, {1.0, 2000.0}},
      {{2000.0}, {1.0, 2000.0}},  // twice the same pole
      pade(2e-4, 4)};
  const StateSpace law = chain(functions);
  EXPECT_EQ(law.states(), 9);
  EXPECT_EQ(law.D_rate.size(), 0);
  for (const Complex s : {3.0 + 10.0 * i, -50.0 + 2000.0 * i, 3e4 * i}) {
    Complex expected = 1.0;
    for (const TransferFunction& f : functions) expected *= at(f, s);
    expect_near(law.stiffness_at(s)(0, 0), expected, 1e-11);
  }
  // a derivative without end needs nothing behind it
  const StateSpace plain = chain({transfer_function(PidController{3.0, 0.0, 2.0, 0.0})});
  EXPECT_EQ(plain.states(), 0);
  expect_near(plain.stiffness_at(5.0 * i)(0, 0), 3.0 + 10.0 * i, 1e-15);
}

TEST(Control, SeriesOfSeveralInputs) {
  const StateSpace first{
      Mat::Constant(1, 1, -2.0), Mat::Ones(1, 2), Mat::Ones(2, 1), Mat::Identity(2, 2), {}, {}};
  const StateSpace second = state_space(TransferFunction{{5.0}, {1.0, 7.0}}).repeated(2);
  const StateSpace both = in_series(first, {second.A, second.B, second.C, second.D, {}, {}});
  const Complex s = 1.0 + 4.0 * i;
  const CMat expected = 5.0 / (s + 7.0) * first.stiffness_at(s);
  EXPECT_LT((both.stiffness_at(s) - expected).norm(), 1e-14 * expected.norm());
}

// A limit of voltage needs the inductance of the coil and the bandwidth of the current loop.
TEST(Control, LimitsOfVoltageNeedCoilAndCurrentLoop) {
  const StateSpace control = state_space(TransferFunction{{5.0}, {1.0, 7.0}});
  AmplifierLimits limits;
  limits.voltage_limit = 9.0;
  EXPECT_THROW(limited_currents(control, 100.0, limits), NumericalError);
  limits.inductance = 0.02;
  EXPECT_THROW(limited_currents(control, 0.0, limits), NumericalError);
  EXPECT_EQ(limited_currents(control, 100.0, limits).limits.size(), 1u);
}

}  // namespace whirl::control_test
