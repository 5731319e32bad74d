#pragma once
// A disk in a magnetic bearing whose current or voltage saturates.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "libdyn/system/support_limits.hpp"
#include "libfe/parts/control.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::test {

/// A disk with unbalance in a magnetic bearing, whose equations are written down below once more.
struct InMagneticBearing {
  double Omega = 330.0;
  double m = 10.0, ki = 200.0, ks = -1.5e6, U = 0.0045;  // a spring keeps what no current can
  double P = 1.5e4, D = 30.0;
  double filter = 4000.0;     // of the derivative [rad/s]; 0: it has no end
  double amplifier = 2500.0;  // [rad/s]; 0: it has none
  AmplifierLimits limits{.current_limit = 1.5};

  StateSpace control() const {
    return chain({transfer_function(
        PidController{.proportional = P, .derivative = D, .derivative_bandwidth = filter})});
  }
  Model model() const {
    Model all;
    all.speed = Omega;
    all.has_speed = true;
    Structure& s = all.structure;
    s.bodies = {{.name = "disk", .m = m, .spins = true}};
    s.unbalances = {{.at = body("disk"), .moment = U}};
    s.bearings = {bearing(body("disk"), isotropic(-ks))};
    LimitedCurrents currents = limited_currents(control().repeated(2), amplifier, limits);
    Support support{.name = "amb", .sensors = 2};
    support.sees = support.acts_on = {{.at = body("disk"), .x = 1.0, .y = 0.0},
                                      {.at = body("disk"), .x = 0.0, .y = 1.0}};
    support.law = currents.law;
    support.law.C *= ki;
    support.law.D *= ki;
    support.law.D_rate *= ki;
    for (SignalLimit& limit : currents.limits) {
      limit.to_forces *= ki;
      limit.force *= ki;
      support.limits.push_back(limit);
    }
    s.supports = {support};
    add_limits(all);
    all.reduction.method = ReductionMethod::none;
    return all;
  }
  Scene scene() const { return make_scene(model()); }

  /// u, u', the filtered displacement of the derivative and the current, of one axis.
  using Axis = std::array<double, 4>;
  static double clamp(double x, double limit) {
    return limit > 0.0 ? std::clamp(x, -limit, limit) : x;
  }
  Axis rates(const Axis& y, double load) const {
    const auto [u, v, q, i] = y;
    const double slope = filter > 0.0 ? filter * (u - q) : v;
    const bool has_voltage = limits.voltage_limit > 0.0;
    const double asked = clamp(P * u + D * slope, has_voltage ? 0.0 : limits.current_limit);
    const double made = clamp(i, has_voltage ? limits.current_limit : 0.0);
    const double current = amplifier > 0.0 ? made : asked;
    double charge = amplifier * (asked - i);
    if (limits.voltage_limit > 0.0) {
      const double L = limits.inductance, R = limits.resistance;
      charge = (clamp(L * charge + R * i, limits.voltage_limit) - R * i) / L;
    }
    return {v, (load - ki * current + ks * u) / m, filter * (u - q), charge};
  }
  /// The disk after some revolutions from rest, by Runge-Kutta steps that are short.
  Vec end_after(double revolutions) const {
    Vec end(4);
    const double h = 0.25e-6 * 2.0 * std::numbers::pi / Omega * 20.0;
    const auto steps = std::lround(revolutions / 20.0 * 4e6);
    for (const int axis : {0, 1}) {
      Axis y{};
      const auto at = [&](const Axis& from, const Axis& k, double part) {
        Axis to;
        for (std::size_t j = 0; j < 4; ++j) to[j] = from[j] + part * k[j];
        return to;
      };
      const auto load = [&](double t) {
        return U * Omega * Omega * (axis == 0 ? std::cos(Omega * t) : std::sin(Omega * t));
      };
      for (long n = 0; n < steps; ++n) {
        const double t = double(n) * h;
        const Axis a = rates(y, load(t)), b = rates(at(y, a, h / 2), load(t + h / 2)),
                   c = rates(at(y, b, h / 2), load(t + h / 2)), d = rates(at(y, c, h), load(t + h));
        for (std::size_t j = 0; j < 4; ++j) y[j] += h / 6 * (a[j] + 2 * b[j] + 2 * c[j] + d[j]);
      }
      end(axis) = y[0];
      end(2 + axis) = y[1];
    }
    return end;
  }
};

/// One whose current is limited, one of them without amplifier and with an ideal derivative, and
/// one whose voltage is, and one with both.
inline std::vector<InMagneticBearing> saturated_magnets() {
  InMagneticBearing of_current, ideal, of_voltage, of_both;
  ideal.filter = ideal.amplifier = 0.0;
  of_voltage.limits = {.voltage_limit = 15.0, .inductance = 0.02, .resistance = 2.0};
  of_both.limits = of_voltage.limits;
  of_both.limits.current_limit = 1.5;
  return {of_current, ideal, of_voltage, of_both};
}

}  // namespace whirl::test
