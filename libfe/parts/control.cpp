#include "libfe/parts/control.hpp"

#include <algorithm>
#include <utility>

#include "libbase/error.hpp"

namespace whirl::inline fe {

namespace {

/// Order of a polynomial without leading zeros.
std::ptrdiff_t order_of(const std::vector<double>& p) {
  return std::distance(std::ranges::find_if(p, [](double c) { return c != 0.0; }), p.end()) - 1;
}

/// How fast a function grows with the frequency: its power of s.
std::ptrdiff_t growth_of(const TransferFunction& f) {
  return order_of(f.numerator) - order_of(f.denominator);
}

TransferFunction product(const TransferFunction& f, const TransferFunction& g) {
  return {polynomial_product(f.numerator, g.numerator),
          polynomial_product(f.denominator, g.denominator)};
}

/// A law of first order, 1 at rest.
TransferFunction first_order(double bandwidth) {
  return {{bandwidth}, {1.0, bandwidth}};
}

}  // namespace

TransferFunction transfer_function(const PidController& pid) {
  const auto& [P, I, D, w] = pid;
  TransferFunction f{{D, P}, {1.0}};
  if (w > 0.0) f = {{P + D * w, P * w}, {1.0, w}};
  if (I != 0.0) {
    TransferFunction integral{{I}, {1.0, 0.0}};
    f = {polynomial_sum(polynomial_product(f.numerator, integral.denominator),
                        polynomial_product(integral.numerator, f.denominator)),
         polynomial_product(f.denominator, integral.denominator)};
  }
  return f;
}

TransferFunction transfer_function(const ControlFilter& filter) {
  const double w = filter.frequency, damping = 2.0 * filter.damping_ratio * w;
  const std::vector<double> poles{1.0, damping, w * w};
  if (filter.kind == FilterKind::low_pass) return {{w * w}, poles};
  return {{1.0, filter.depth * damping, w * w}, poles};
}

TransferFunction pade(double delay, int order) {
  // c_k = c_(k-1) (n - k + 1) / (k (2 n - k + 1)) of x^k, x = s T
  std::vector<double> ascending{1.0};
  for (int k = 1; k <= order; ++k) {
    ascending.push_back(ascending.back() * delay * (order - k + 1) / (k * (2.0 * order - k + 1)));
  }
  TransferFunction f;
  for (std::size_t k = ascending.size(); k-- > 0;) {
    f.denominator.push_back(ascending[k]);
    f.numerator.push_back(k % 2 == 1 ? -ascending[k] : ascending[k]);
  }
  return f;
}

std::vector<TransferFunction> transfer_functions(const LoopDynamics& loop) {
  std::vector<TransferFunction> all;
  if (loop.sensor_bandwidth > 0.0) all.push_back(first_order(loop.sensor_bandwidth));
  if (loop.amplifier_bandwidth > 0.0) all.push_back(first_order(loop.amplifier_bandwidth));
  if (loop.delay > 0.0) all.push_back(pade(loop.delay, loop.pade_order));
  return all;
}

StateSpace in_series(const StateSpace& first, const StateSpace& second) {
  const Eigen::Index a = first.states(), b = second.states();
  const bool gives_rates = first.D_rate.size() > 0;
  if (second.D_rate.size() > 0 || first.D_inertia.size() > 0 || second.D_inertia.size() > 0 ||
      (gives_rates && b > 0)) {
    throw NumericalError(
        "a controller that grows with the frequency needs an amplifier or filter "
        "that is given in the same way");
  }
  StateSpace law;
  law.A = Mat::Zero(a + b, a + b);
  law.A.topLeftCorner(a, a) = first.A;
  law.A.bottomLeftCorner(b, a) = second.B * first.C;
  law.A.bottomRightCorner(b, b) = second.A;
  law.B = Mat(a + b, first.inputs());
  law.B << first.B, second.B * first.D;
  law.C = Mat(second.outputs(), a + b);
  law.C << second.D * first.C, second.C;
  law.D = second.D * first.D;
  if (gives_rates) law.D_rate = second.D * first.D_rate;
  return law;
}

LimitedCurrents limited_currents(const StateSpace& control, double bandwidth,
                                 const AmplifierLimits& limits) {
  const Eigen::Index n = control.states(), m = control.outputs(), p = control.inputs();
  const double w = bandwidth;
  const bool has_amplifier = w > 0.0;
  if (has_amplifier && control.D_rate.size() > 0) {
    throw NumericalError(
        "an amplifier with a bandwidth and a limit needs a derivative that ends: give "
        "derivative_bandwidth");
  }
  if (limits.voltage_limit > 0.0 && !(has_amplifier && limits.inductance > 0.0)) {
    throw NumericalError(
        "a limit of voltage needs the inductance of the coil and the bandwidth of the current "
        "loop");
  }
  const Eigen::Index all = has_amplifier ? n + m : n;
  LimitedCurrents made;
  StateSpace& law = made.law;
  law = control;
  if (has_amplifier) {
    law.A = Mat::Zero(all, all);
    law.A.topLeftCorner(n, n) = control.A;
    law.A.bottomLeftCorner(m, n) = w * control.C;
    law.A.bottomRightCorner(m, m) = -w * Mat::Identity(m, m);
    law.B = Mat(all, p);
    law.B << control.B, w * control.D;
    law.C = Mat::Zero(m, all);
    law.C.rightCols(m).setIdentity();
    law.D = Mat::Zero(m, p);
  }
  const double L = limits.inductance, R = limits.resistance;
  const auto add = [&](const char* signal, Eigen::Index axis, double limit, double of_y,
                       double of_i) -> SignalLimit& {
    SignalLimit& one = made.limits.emplace_back();
    one.name = std::string(signal) + " of axis " + std::to_string(axis + 1);
    one.limit = limit;
    one.over_states = one.to_states = Vec::Zero(all);
    one.over_states.head(n) = of_y * control.C.row(axis).transpose();
    if (has_amplifier) one.over_states(n + axis) = of_i;
    one.over_displacements = of_y * control.D.row(axis).transpose();
    one.over_rates = control.D_rate.size() > 0 ? Vec(of_y * control.D_rate.row(axis).transpose())
                                               : Vec(Vec::Zero(p));
    one.to_forces = Vec::Zero(m);
    return one;
  };
  const bool has_voltage = limits.voltage_limit > 0.0;
  for (Eigen::Index axis = 0; axis < m; ++axis) {
    if (limits.current_limit > 0.0) {
      SignalLimit& one = has_voltage ? add("current", axis, limits.current_limit, 0.0, 1.0)
                                     : add("current", axis, limits.current_limit, 1.0, 0.0);
      if (has_amplifier && !has_voltage) {
        one.to_states(n + axis) = w;
      } else {
        one.to_forces(axis) = 1.0;
      }
    }
    if (has_voltage) {
      SignalLimit& one = add("voltage", axis, limits.voltage_limit, L * w, R - L * w);
      one.to_states(n + axis) = 1.0 / L;
      one.force = 1.0 / (L * w);  // what y makes so much of it
    }
  }
  return made;
}

StateSpace chain(const std::vector<TransferFunction>& functions) {
  std::vector<TransferFunction> left = functions;
  const auto grows = [](const TransferFunction& f) { return growth_of(f) > 0; };
  while (left.size() > 1) {
    const auto at = std::ranges::find_if(left, grows);
    if (at == left.end()) break;
    const TransferFunction growing = *at;
    left.erase(at);
    const auto slowest = std::ranges::min_element(left, {}, growth_of);
    *slowest = product(growing, *slowest);
  }
  if (left.empty()) return state_space(TransferFunction{{1.0}, {1.0}});
  StateSpace law = state_space(left.front());
  for (std::size_t k = 1; k < left.size(); ++k) law = in_series(law, state_space(left[k]));
  if (law.D_inertia.size() > 0) {
    throw NumericalError("the controller grows with the square of the frequency");
  }
  return law;
}

}  // namespace whirl::inline fe
